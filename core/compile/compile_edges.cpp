#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "compile/lowering.h"

namespace glimt {
namespace {

using glm::dvec3;

constexpr std::size_t most_pieces = 256;  ///< of so many, most edges lie inside the outline

dvec3 vec(const std::array<float, 3>& v) { return {v[0], v[1], v[2]}; }

/// Corners of a lamp, or points around the outline of a spherical one as the eye sees it; empty where it does not shine
/// on the eye.
std::vector<dvec3> outline(const LampPiece& lamp, const dvec3& eye) {
  const LampBody body = body_of(lamp.shape);
  const dvec3& first = body.outline[0];
  if (!body.round()) return dot(body.normal, eye - first) > 0 ? body.outline : std::vector<dvec3>{};
  const dvec3 way = first - eye;
  const double distance = length(way), radius = body.radius;
  if (distance <= radius) return {};
  const double sine = radius / distance, cosine = std::sqrt(1 - sine * sine);
  const dvec3 axis = way / distance;
  const dvec3 u = normalize(cross(axis, std::abs(axis.x) < 0.5 ? dvec3{1, 0, 0} : dvec3{0, 1, 0})), v = cross(axis, u);
  std::vector<dvec3> points;
  constexpr int sides = 64;
  for (int i = 0; i < sides; ++i) {
    const double angle = 2 * std::numbers::pi * i / sides;
    points.push_back(first - axis * (radius * sine) + (u * std::cos(angle) + v * std::sin(angle)) * (radius * cosine));
  }
  return points;
}

/// Pixels that a line comes near, given by its ends in camera space: to the right, down, both in pixels at distance 1,
/// and forward.
void mark_line(dvec3 a, dvec3 b, int width, int height, std::vector<int>& pixels) {
  const double nearest = 1e-6 * std::max(length(a), length(b));
  if (std::max(a.z, b.z) <= nearest) return;
  if (a.z < b.z) std::swap(a, b);
  if (b.z < nearest) b = a + (b - a) * ((a.z - nearest) / (a.z - b.z));
  const double ax = a.x / a.z + 0.5 * width, ay = a.y / a.z + 0.5 * height;
  const double dx = b.x / b.z + 0.5 * width - ax, dy = b.y / b.z + 0.5 * height - ay;
  // The part of the line in the image (Liang and Barsky, "A new concept and method for line clipping", 1984).
  double from = 0, to = 1;
  const auto clip = [&](double start, double step, double end) {
    const double t0 = (-1 - start) / step, t1 = (end + 1 - start) / step;
    if (step == 0) {
      if (start < -1 || start > end + 1) to = -1;
      return;
    }
    from = std::max(from, std::min(t0, t1));
    to = std::min(to, std::max(t0, t1));
  };
  clip(ax, dx, width);
  clip(ay, dy, height);
  if (from > to) return;
  const int steps = static_cast<int>(std::ceil(2 * (to - from) * std::hypot(dx, dy))) + 1;
  for (int i = 0; i <= steps; ++i) {
    const double t = from + (to - from) * i / steps;
    for (const double x : {-0.5, 0.5})
      for (const double y : {-0.5, 0.5}) {
        const int column = static_cast<int>(std::floor(ax + dx * t + x)),
                  row = static_cast<int>(std::floor(ay + dy * t + y));
        if (column >= 0 && row >= 0 && column < width && row < height) pixels.push_back(row * width + column);
      }
  }
}

}  // namespace

void mark_lamp_edges(Lowering& l) {
  const Settings& settings = l.scene.render;
  // What one asks for with these is another picture.
  if (settings.sampler == Sampler::centres || settings.caustics == Caustics::only) return;
  if (l.lamps.size() > most_pieces) return;
  const PinholeCamera& camera = l.out.camera;
  const dvec3 eye = vec(camera.eye);
  const auto seen = [&](const dvec3& p) {
    const dvec3 way = p - eye;
    return dvec3{dot(way, vec(camera.right)) / camera.pixel_area, dot(way, vec(camera.down)) / camera.pixel_area,
                 dot(way, vec(camera.forward))};
  };
  std::vector<int>& pixels = l.out.lamp_edges;
  for (const LampPiece& lamp : l.lamps) {
    const std::vector<dvec3> points = outline(lamp, eye);
    for (std::size_t i = 0; i < points.size(); ++i)
      mark_line(seen(points[i]), seen(points[(i + 1) % points.size()]), l.out.width, l.out.height, pixels);
  }
  std::ranges::sort(pixels);
  pixels.erase(std::unique(pixels.begin(), pixels.end()), pixels.end());
}

}  // namespace glimt
