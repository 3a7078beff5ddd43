#include "scene/geometry/solid_overlap.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>
#include <numeric>
#include <span>

#include "math/box.h"
#include "scene/geometry/geometry_cache.h"
#include "scene/geometry/mesh_measures.h"

namespace glimt {
namespace {

using glm::dvec3;
using Triangle = std::array<dvec3, 3>;

Box box_of(std::span<const Triangle> triangles) {
  Box box;
  for (const Triangle& t : triangles)
    for (const dvec3& p : t) box.add(p);
  return box;
}

std::vector<Triangle> triangles_of(const Mesh& mesh) {
  std::vector<Triangle> triangles;
  for (const auto& t : mesh.triangles) {
    const auto vertex = [&](std::size_t k) { return mesh.vertices[static_cast<std::size_t>(t[k])]; };
    triangles.push_back({vertex(0), vertex(1), vertex(2)});
  }
  return triangles;
}

dvec3 unit_normal(const Triangle& t) { return normalize(cross(t[1] - t[0], t[2] - t[0])); }

/// Distance of p to the inside of edge k, in the plane of the triangle; negative outside.
double inside_edge(const Triangle& t, const dvec3& normal, std::size_t k, const dvec3& p) {
  const dvec3 edge = t[(k + 1) % 3] - t[k];
  return dot(normalize(cross(normal, edge)), p - t[k]);
}

double distance_to(const Triangle& t, const dvec3& p) {
  const dvec3 normal = unit_normal(t);
  bool above = true;
  double nearest = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < 3; ++k) {
    above = above && inside_edge(t, normal, k, p) >= 0;
    const dvec3 edge = t[(k + 1) % 3] - t[k];
    const double along = std::clamp(dot(p - t[k], edge) / dot(edge, edge), 0.0, 1.0);
    nearest = std::min(nearest, length(p - t[k] - along * edge));
  }
  return above ? std::abs(dot(normal, p - t[0])) : nearest;
}

enum class Side { inside, outside, surface };

Side side_of(const Mesh& closed, const std::vector<Triangle>& triangles, const dvec3& p, double tolerance) {
  for (const Triangle& t : triangles)
    if (meet(box_of({&t, 1}), {p, p}, tolerance) && distance_to(t, p) <= tolerance) return Side::surface;
  return std::abs(winding_number(closed, p)) > 0.5 ? Side::inside : Side::outside;
}

/// True where an edge of `a` passes through the triangle `b`, clear of its border.
bool pierces(const Triangle& a, const Triangle& b, double tolerance) {
  const dvec3 normal = unit_normal(b);
  for (std::size_t k = 0; k < 3; ++k) {
    const dvec3 p = a[k], q = a[(k + 1) % 3];
    const double from = dot(normal, p - b[0]), to = dot(normal, q - b[0]);
    if (std::min(from, to) >= -tolerance || std::max(from, to) <= tolerance) continue;
    const dvec3 hit = p + (q - p) * (from / (from - to));
    if (inside_edge(b, normal, 0, hit) > tolerance && inside_edge(b, normal, 1, hit) > tolerance &&
        inside_edge(b, normal, 2, hit) > tolerance)
      return true;
  }
  return false;
}

/// True where all of `a` is on one side of the plane of `b`.
bool clear_of_plane(const Triangle& a, const Triangle& b, double tolerance) {
  const dvec3 normal = unit_normal(b);
  const auto height = [&](const dvec3& p) { return dot(normal, p - b[0]); };
  return std::ranges::all_of(a, [&](const dvec3& p) { return height(p) > tolerance; }) ||
         std::ranges::all_of(a, [&](const dvec3& p) { return height(p) < -tolerance; });
}

/// Calls visit(i, j) for every triangle i of `a` and j of `b` whose boxes meet, until it returns false: a sweep along
/// x.
template <class Visit>
void for_near_pairs(const std::vector<Triangle>& a, const std::vector<Triangle>& b, double tolerance, Visit visit) {
  struct Entry {
    Box box;
    std::size_t index;
    bool of_a;
  };
  std::vector<Entry> entries;
  for (std::size_t i = 0; i < a.size(); ++i) entries.push_back({box_of({&a[i], 1}), i, true});
  for (std::size_t i = 0; i < b.size(); ++i) entries.push_back({box_of({&b[i], 1}), i, false});
  std::ranges::sort(entries, {}, [](const Entry& e) { return e.box.low.x; });
  std::array<std::vector<const Entry*>, 2> open;
  for (const Entry& entry : entries) {
    auto& others = open[entry.of_a ? 1 : 0];
    std::erase_if(others, [&](const Entry* e) { return e->box.high.x + tolerance < entry.box.low.x; });
    for (const Entry* other : others)
      if (meet(entry.box, other->box, tolerance) &&
          !visit(entry.of_a ? entry.index : other->index, entry.of_a ? other->index : entry.index))
        return;
    open[entry.of_a ? 0 : 1].push_back(&entry);
  }
}

/// One vertex of every connected part of the mesh.
std::vector<dvec3> part_vertices(const Mesh& mesh) {
  std::vector<std::size_t> parent(mesh.vertices.size());
  std::iota(parent.begin(), parent.end(), std::size_t{0});
  const auto root = [&](std::size_t i) {
    while (parent[i] != i) i = parent[i] = parent[parent[i]];
    return i;
  };
  std::vector<bool> used(parent.size());
  for (const auto& t : mesh.triangles)
    for (const int k : t) {
      used[static_cast<std::size_t>(k)] = true;
      parent[root(static_cast<std::size_t>(k))] = root(static_cast<std::size_t>(t[0]));
    }
  std::vector<dvec3> vertices;
  for (std::size_t i = 0; i < parent.size(); ++i)
    if (used[i] && root(i) == i) vertices.push_back(mesh.vertices[i]);
  return vertices;
}

/// Points that tell where the surface of a mesh lies: one of each part, and some on every triangle in touch with the
/// other mesh, which the other mesh may cut along its own edges without piercing it.
std::vector<dvec3> probes(const Mesh& mesh, const std::vector<Triangle>& triangles, const std::vector<bool>& touching) {
  std::vector<dvec3> points = part_vertices(mesh);
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    if (!touching[i]) continue;
    const dvec3 middle = (triangles[i][0] + triangles[i][1] + triangles[i][2]) / 3.0;
    points.push_back(middle);
    for (const dvec3& corner : triangles[i]) points.push_back(mix(corner, middle, 0.3));
  }
  return points;
}

struct SidesFound {
  bool inside = false, outside = false;
};

SidesFound sides(const std::vector<dvec3>& points, const Mesh& closed, const std::vector<Triangle>& triangles,
                 double tolerance) {
  SidesFound found;
  for (const dvec3& p : points) {
    if (found.inside && found.outside) break;
    const Side side = side_of(closed, triangles, p, tolerance);
    found.inside |= side == Side::inside;
    found.outside |= side == Side::outside;
  }
  return found;
}

}  // namespace

bool overlap(const Sphere& a, const Sphere& b) {
  const double distance = length(a.center - b.center), tolerance = touch_tolerance * 2 * std::min(a.radius, b.radius);
  const double difference = std::abs(a.radius - b.radius);
  const bool coincide = distance <= tolerance && difference <= tolerance;
  const bool apart = distance >= a.radius + b.radius - tolerance, nested = distance <= difference + tolerance;
  return coincide || !(apart || nested);
}

bool overlap(const Sphere& sphere, const Mesh& mesh) {
  if (is_large(mesh) && !meet(box_of(mesh), {sphere.center - sphere.radius, sphere.center + sphere.radius}, 0))
    return false;
  const std::vector<Triangle> triangles = triangles_of(mesh);
  const double tolerance = touch_tolerance * std::min(2 * sphere.radius, box_of(triangles).size());
  double nearest = std::numeric_limits<double>::infinity(), farthest = 0;
  for (const Triangle& t : triangles) {
    nearest = std::min(nearest, distance_to(t, sphere.center));
    for (const dvec3& p : t) farthest = std::max(farthest, length(p - sphere.center));
  }
  const bool surface_stays_out = nearest >= sphere.radius - tolerance,
             mesh_is_inside = farthest <= sphere.radius + tolerance;
  return !(surface_stays_out || mesh_is_inside);
}

bool overlap(const Mesh& a, const Mesh& b) {
  if ((is_large(a) || is_large(b)) && !meet(box_of(a), box_of(b), 0)) return false;
  const std::vector<Triangle> of_a = triangles_of(a), of_b = triangles_of(b);
  const Box box_a = box_of(of_a), box_b = box_of(of_b);
  const double tolerance = touch_tolerance * std::min(box_a.size(), box_b.size());
  if (!meet(box_a, box_b, tolerance)) return false;

  bool pierced = false;
  std::vector<bool> touching_a(of_a.size()), touching_b(of_b.size());
  for_near_pairs(of_a, of_b, tolerance, [&](std::size_t i, std::size_t j) {
    if (clear_of_plane(of_a[i], of_b[j], tolerance) || clear_of_plane(of_b[j], of_a[i], tolerance)) return true;
    touching_a[i] = touching_b[j] = true;
    pierced = pierces(of_a[i], of_b[j], tolerance) || pierces(of_b[j], of_a[i], tolerance);
    return !pierced;
  });
  if (pierced) return true;

  // Neither surface crosses the other clearly, so each part of one is inside, outside or on the surface of the other.
  const SidesFound a_in_b = sides(probes(a, of_a, touching_a), b, of_b, tolerance);
  const SidesFound b_in_a = sides(probes(b, of_b, touching_b), a, of_a, tolerance);
  const bool crossing =
      (a_in_b.inside && a_in_b.outside) || (b_in_a.inside && b_in_a.outside) || (a_in_b.inside && b_in_a.inside);
  const bool coincide = !a_in_b.inside && !a_in_b.outside && !b_in_a.inside && !b_in_a.outside;
  return crossing || coincide;
}

}  // namespace glimt
