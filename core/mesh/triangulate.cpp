#include "mesh/triangulate.h"

#include <glm/geometric.hpp>
#include <numeric>

namespace glimt {
namespace {

using glm::dvec3;

/// Twice the polygon's area, along its normal (Newell).
dvec3 area_vector(std::span<const dvec3> outline) {
  dvec3 sum{0};
  for (std::size_t i = 1; i + 1 < outline.size(); ++i)
    sum += cross(outline[i] - outline[0], outline[i + 1] - outline[0]);
  return sum;
}

/// Twice the area of the triangle, positive where it turns as the polygon does.
double turn(const dvec3& a, const dvec3& b, const dvec3& c, const dvec3& normal) {
  return dot(cross(b - a, c - a), normal);
}

bool is_convex(std::span<const dvec3> outline, const dvec3& normal) {
  const std::size_t n = outline.size();
  for (std::size_t i = 0; i < n; ++i)
    if (turn(outline[i], outline[(i + 1) % n], outline[(i + 2) % n], normal) < 0) return false;
  // A star that winds twice turns one way everywhere too; its fan folds back.
  for (std::size_t i = 1; i + 1 < n; ++i)
    if (turn(outline[0], outline[i], outline[i + 1], normal) < 0) return false;
  return true;
}

}  // namespace

std::vector<std::array<std::size_t, 3>> triangulate(std::span<const dvec3> outline) {
  const dvec3 normal = area_vector(outline);
  std::vector<std::array<std::size_t, 3>> triangles;
  triangles.reserve(outline.size() - 2);
  if (is_convex(outline, normal)) {
    for (std::size_t i = 1; i + 1 < outline.size(); ++i) triangles.push_back({0, i, i + 1});
    return triangles;
  }
  if (outline.size() > most_corners) return {};

  // Ears are cut off: corners that turn the polygon's way and have no other corner within their triangle.
  std::vector<std::size_t> left(outline.size());
  std::iota(left.begin(), left.end(), std::size_t{0});
  const auto is_ear = [&](std::size_t a, std::size_t b, std::size_t c) {
    const dvec3 &p = outline[a], &q = outline[b], &r = outline[c];
    if (!(turn(p, q, r, normal) > 0)) return false;
    for (const std::size_t other : left) {
      if (other == a || other == b || other == c) continue;
      const dvec3& x = outline[other];
      if (x == p || x == q || x == r) continue;
      if (turn(p, q, x, normal) >= 0 && turn(q, r, x, normal) >= 0 && turn(r, p, x, normal) >= 0) return false;
    }
    return true;
  };
  std::size_t at = 0, tried = 0;
  while (left.size() > 3) {
    const std::size_t n = left.size(), a = left[(at + n - 1) % n], b = left[at % n], c = left[(at + 1) % n];
    // Where no corner is an ear the outline crosses itself, and any is as good.
    if (is_ear(a, b, c) || tried >= n) {
      triangles.push_back({a, b, c});
      left.erase(left.begin() + static_cast<std::ptrdiff_t>(at % n));
      at = at % n == 0 ? 0 : at % n - 1;
      tried = 0;
    } else {
      at = (at + 1) % n;
      ++tried;
    }
  }
  triangles.push_back({left[0], left[1], left[2]});
  return triangles;
}

}  // namespace glimt
