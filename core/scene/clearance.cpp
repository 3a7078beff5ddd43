#include "scene/clearance.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <vector>

#include "scene/geometry/convex_pieces.h"

namespace glimt {
namespace {

using glm::dvec3;

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr int most_steps = 10000, most_pushes = 64;
constexpr double on_surface = 1e-9, touching = 1.01, least_progress = 1e-3;  ///< in margins

/// Ericson, "Real-Time Collision Detection", 2005, section 5.1.5.
dvec3 nearest_point(const std::array<dvec3, 3>& triangle, const dvec3& p) {
  const auto& [a, b, c] = triangle;
  const dvec3 ab = b - a, ac = c - a;
  const double d1 = dot(ab, p - a), d2 = dot(ac, p - a);
  if (d1 <= 0 && d2 <= 0) return a;
  const double d3 = dot(ab, p - b), d4 = dot(ac, p - b);
  if (d3 >= 0 && d4 <= d3) return b;
  const double vc = d1 * d4 - d3 * d2;
  if (vc <= 0 && d1 >= 0 && d3 <= 0) return a + ab * (d1 / (d1 - d3));
  const double d5 = dot(ab, p - c), d6 = dot(ac, p - c);
  if (d6 >= 0 && d5 <= d6) return c;
  const double vb = d5 * d2 - d1 * d6;
  if (vb <= 0 && d2 >= 0 && d6 <= 0) return a + ac * (d2 / (d2 - d6));
  const double va = d3 * d6 - d5 * d4;
  if (va <= 0 && d4 >= d3 && d5 >= d6) return b + (c - b) * ((d4 - d3) / ((d4 - d3) + (d5 - d6)));
  return a + (ab * vb + ac * vc) / (va + vb + vc);
}

dvec3 nearest_point(const Sphere& sphere, const dvec3& p) {
  const dvec3 way = p - sphere.center;
  const double distance = length(way);
  return sphere.center + (distance > 0 ? way / distance : dvec3{0, 1, 0}) * sphere.radius;
}

struct Nearest {
  double distance;
  dvec3 point;
};

/// The surfaces that come nearer than `reach` to a place.
class Obstacles {
 public:
  Obstacles(const Scene& scene, const dvec3& place, double reach) {
    const auto add = [&](const std::array<dvec3, 3>& triangle) {
      const dvec3& a = triangle[0];
      const double size = std::max(length(triangle[1] - a), length(triangle[2] - a));
      if (length(place - a) - size < reach && length(place - nearest_point(triangle, place)) < reach)
        triangles_.push_back(triangle);
    };
    for (const Polygon& p : scene.polygons)
      for (const auto& v : convex_pieces(p.vertices).pieces)
        for (std::size_t i = 1; i + 1 < v.size(); ++i) add({v[0], v[i], v[i + 1]});
    for (const Mesh& m : scene.meshes)
      for (const auto& t : m.triangles) {
        const auto vertex = [&](std::size_t k) { return m.vertices[static_cast<std::size_t>(t[k])]; };
        add({vertex(0), vertex(1), vertex(2)});
      }
    for (const Sphere& s : scene.spheres)
      if (length(place - nearest_point(s, place)) < reach) spheres_.push_back(&s);
  }

  /// Of these surfaces.
  Nearest nearest(const dvec3& p) const {
    Nearest found{infinity, p};
    const auto consider = [&](const dvec3& q) {
      if (const double distance = length(p - q); distance < found.distance) found = {distance, q};
    };
    for (const auto& triangle : triangles_) consider(nearest_point(triangle, p));
    for (const Sphere* sphere : spheres_) consider(nearest_point(*sphere, p));
    return found;
  }

  /// Moves the point away from the surfaces until it is `margin` from all; false where it does not come to that. No
  /// move is longer than the way to the nearest surface, so it crosses none.
  bool push_off(dvec3& p, double margin) const {
    for (int i = 0; i < most_pushes; ++i) {
      const auto [distance, point] = nearest(p);
      if (distance >= margin) return true;
      // A little more than what is missing, so that rounding does not leave it short.
      p += (p - point) * std::min((margin - distance) / distance * (1 + 1e-6) + 1e-12, 0.9);
    }
    return nearest(p).distance >= margin;
  }

 private:
  std::vector<std::array<dvec3, 3>> triangles_;
  std::vector<const Sphere*> spheres_;
};

}  // namespace

double clearance(const Scene& scene, const dvec3& point) {
  return Obstacles(scene, point, infinity).nearest(point).distance;
}

dvec3 slide(const Scene& scene, const dvec3& from, const dvec3& to, double margin) {
  const double way = length(to - from);
  if (!(way > 0)) return from;
  // The point comes ever nearer to `to`, so this is all that it can touch.
  const Obstacles obstacles(scene, from, 2 * way + 3 * margin);
  dvec3 p = from;
  const double begun = obstacles.nearest(p).distance;
  if (begun < on_surface * margin) return to;
  if (!obstacles.push_off(p, margin)) {
    p = from;
    margin = 0.999 * std::min(begun, margin);
  }
  for (int i = 0; i < most_steps; ++i) {
    const auto [distance, point] = obstacles.nearest(p);
    const dvec3 rest = to - p;
    dvec3 goal = to;
    if (distance < touching * margin) {
      const dvec3 normal = (p - point) / distance;
      goal -= normal * std::min(dot(rest, normal), 0.0);
    }
    const double left = length(goal - p);
    if (!(left > 0)) break;
    // The ball up to the nearest surface is free; half a margin into that of the margin is put right afterwards.
    const double step = distance - margin / 2;
    dvec3 next = step >= left ? goal : p + (goal - p) * (step / left);
    if (!obstacles.push_off(next, margin)) break;
    const bool nearer = length(to - next) < length(rest);
    if (!nearer || length(next - p) < least_progress * margin) {
      if (nearer && next == to) p = next;
      break;
    }
    p = next;
  }
  return p;
}

}  // namespace glimt
