#include "scene/geometry/mesh_measures.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <glm/geometric.hpp>
#include <numbers>
#include <unordered_map>

namespace glimt {

using glm::dvec3;

std::vector<dvec3> triangle_vertices(const Mesh& mesh, const std::array<int, 3>& t) {
  auto vertex = [&](int i) { return mesh.vertices[static_cast<std::size_t>(i)]; };
  return {vertex(t[0]), vertex(t[1]), vertex(t[2])};
}

bool is_closed(const Mesh& mesh) {
  std::unordered_map<std::uint64_t, int> balance;
  for (const auto& t : mesh.triangles)
    for (std::size_t k = 0; k < 3; ++k) {
      const auto [low, high] = std::minmax(t[k], t[(k + 1) % 3]);
      const std::uint64_t edge = static_cast<std::uint64_t>(low) << 32 | static_cast<std::uint32_t>(high);
      balance[edge] += t[k] == low ? 1 : -1;
    }
  return !mesh.triangles.empty() && std::ranges::all_of(balance, [](const auto& edge) { return edge.second == 0; });
}

double signed_volume(const Mesh& mesh) {
  double six_volumes = 0;
  for (const auto& t : mesh.triangles) {
    const std::vector<dvec3> v = triangle_vertices(mesh, t);
    six_volumes += dot(v[0] - mesh.vertices[0], cross(v[1] - mesh.vertices[0], v[2] - mesh.vertices[0]));
  }
  return six_volumes / 6;
}

double winding_number(const Mesh& mesh, const dvec3& point) {
  double sum = 0;
  for (const auto& t : mesh.triangles) {
    std::vector<dvec3> v = triangle_vertices(mesh, t);
    for (dvec3& p : v) p -= point;
    const double a = length(v[0]), b = length(v[1]), c = length(v[2]);
    sum += 2 * std::atan2(dot(v[0], cross(v[1], v[2])),
                          a * b * c + dot(v[0], v[1]) * c + dot(v[1], v[2]) * a + dot(v[2], v[0]) * b);
  }
  return sum / (4 * std::numbers::pi);
}

}  // namespace glimt
