#include "scene/geometry/mesh_measures.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <glm/geometric.hpp>
#include <glm/vector_relational.hpp>
#include <mutex>
#include <numbers>

#include "scene/geometry/geometry_cache.h"

namespace glimt {

using glm::dvec3;

namespace {

/// Steele, Lea, Flood, "Fast splittable pseudorandom number generators", 2014: the last step.
std::uint64_t mixed(std::uint64_t x) {
  x = (x ^ x >> 30) * 0xbf58476d1ce4e5b9;
  x = (x ^ x >> 27) * 0x94d049bb133111eb;
  return x ^ x >> 31;
}

/// Every edge has a random number that counts up one way and down the other. A mesh that is not closed has the sum 0
/// once in 2^64 times.
bool find_closed(const Mesh& mesh) {
  std::uint64_t balance = 0;
  for (const auto& t : mesh.triangles)
    for (std::size_t k = 0; k < 3; ++k) {
      const int from = t[k], to = t[(k + 1) % 3];
      const auto [low, high] = std::minmax(from, to);
      const std::uint64_t edge = static_cast<std::uint64_t>(low) << 32 | static_cast<std::uint32_t>(high);
      balance += mixed(edge + 0x9e3779b97f4a7c15) * (from == low ? 1 : ~std::uint64_t{0});
    }
  return !mesh.triangles.empty() && balance == 0;
}

double find_volume(const Mesh& mesh) {
  double six_volumes = 0;
  for (const auto& t : mesh.triangles) {
    const auto v = triangle_corners(mesh, t);
    six_volumes += dot(v[0] - mesh.vertices[0], cross(v[1] - mesh.vertices[0], v[2] - mesh.vertices[0]));
  }
  return six_volumes / 6;
}

Box find_box(const Mesh& mesh) {
  Box box;
  for (const dvec3& v : mesh.vertices) box.add(v);
  return box;
}

double find_winding_number(const Mesh& mesh, const dvec3& point) {
  double sum = 0;
  for (const auto& t : mesh.triangles) {
    auto v = triangle_corners(mesh, t);
    for (dvec3& p : v) p -= point;
    const double a = length(v[0]), b = length(v[1]), c = length(v[2]);
    sum += 2 * std::atan2(dot(v[0], cross(v[1], v[2])),
                          a * b * c + dot(v[0], v[1]) * c + dot(v[1], v[2]) * a + dot(v[2], v[0]) * b);
  }
  return sum / (4 * std::numbers::pi);
}

/// Of a large mesh.
struct Measures {
  Box box;
  bool closed;
  double volume;
};

/// The last points that were asked for, of which there are few: the eye, and points of glass.
struct WindingNumbers {
  mutable std::vector<std::pair<dvec3, double>> known;
};

std::shared_ptr<const Measures> measures_of(const Mesh& mesh) {
  static GeometryCache<Measures> cache;
  return cache.get(mesh, [&] { return Measures{find_box(mesh), find_closed(mesh), find_volume(mesh)}; });
}

}  // namespace

std::vector<dvec3> triangle_vertices(const Mesh& mesh, const std::array<int, 3>& t) {
  const auto v = triangle_corners(mesh, t);
  return {v.begin(), v.end()};
}

std::array<dvec3, 3> triangle_corners(const Mesh& mesh, const std::array<int, 3>& t) {
  const std::vector<dvec3>& vertices = mesh.vertices;
  const auto vertex = [&](int i) { return vertices[static_cast<std::size_t>(i)]; };
  return {vertex(t[0]), vertex(t[1]), vertex(t[2])};
}

Box box_of(const Mesh& mesh) { return is_large(mesh) ? measures_of(mesh)->box : find_box(mesh); }

bool is_closed(const Mesh& mesh) { return is_large(mesh) ? measures_of(mesh)->closed : find_closed(mesh); }

double signed_volume(const Mesh& mesh) { return is_large(mesh) ? measures_of(mesh)->volume : find_volume(mesh); }

double winding_number(const Mesh& mesh, const dvec3& point) {
  if (!is_large(mesh)) return find_winding_number(mesh, point);
  constexpr std::size_t most_known = 256;
  const Box box = box_of(mesh);
  if (any(lessThan(point, box.low)) || any(lessThan(box.high, point))) return 0;
  static GeometryCache<WindingNumbers> cache;
  static std::mutex mutex;
  const std::lock_guard lock(mutex);
  const auto numbers = cache.get(mesh, [] { return WindingNumbers{}; });
  auto& known = numbers->known;
  const auto place = std::ranges::find(known, point, &std::pair<dvec3, double>::first);
  if (place != known.end()) return place->second;
  if (known.size() == most_known) known.erase(known.begin());
  known.emplace_back(point, find_winding_number(mesh, point));
  return known.back().second;
}

}  // namespace glimt
