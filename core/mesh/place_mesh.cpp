#include "mesh/place_mesh.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <numbers>
#include <numeric>
#include <tuple>

namespace glimt {
namespace {

using glm::dvec3;

/// Exact at multiples of a right angle.
std::array<double, 2> cos_sin(double degrees) {
  const double turn = std::remainder(degrees, 360.0), quarter = std::round(turn / 90);
  const double rest = (turn - 90 * quarter) * std::numbers::pi / 180, c = std::cos(rest), s = std::sin(rest);
  switch ((static_cast<int>(quarter) + 4) % 4) {
    case 0:
      return {c, s};
    case 1:
      return {-s, c};
    case 2:
      return {-c, -s};
    default:
      return {s, -c};
  }
}

glm::dmat3 rotation(const dvec3& degrees) {
  const auto [cx, sx] = cos_sin(degrees.x);
  const auto [cy, sy] = cos_sin(degrees.y);
  const auto [cz, sz] = cos_sin(degrees.z);
  const glm::dmat3 x{{1, 0, 0}, {0, cx, sx}, {0, -sx, cx}}, y{{cy, 0, -sy}, {0, 1, 0}, {sy, 0, cy}},
      z{{cz, sz, 0}, {-sz, cz, 0}, {0, 0, 1}};
  return z * y * x;
}

const dvec3& at(const std::vector<dvec3>& all, int i) { return all[static_cast<std::size_t>(i)]; }

/// For each vertex the number of its place: the same for vertices with the same coordinates.
std::vector<int> places_of(const std::vector<dvec3>& vertices) {
  std::vector<int> order(vertices.size()), place(vertices.size());
  std::iota(order.begin(), order.end(), 0);
  const auto key = [&](int i) {
    const dvec3 v = at(vertices, i) + 0.0;  // -0 is 0
    using Bits = std::uint64_t;
    return std::tuple(std::bit_cast<Bits>(v.x), std::bit_cast<Bits>(v.y), std::bit_cast<Bits>(v.z));
  };
  std::ranges::sort(order, [&](int a, int b) { return key(a) < key(b); });
  int last = -1;
  for (std::size_t i = 0; i < order.size(); ++i) {
    if (i == 0 || key(order[i]) != key(order[i - 1])) ++last;
    place[static_cast<std::size_t>(order[i])] = last;
  }
  return place;
}

bool lacks_normals(const MeshData& data) {
  return std::ranges::find(data.normals, dvec3{0}) != data.normals.end() ||
         std::ranges::any_of(data.normal_corners, [](const auto& t) {
           return std::min({t[0], t[1], t[2]}) < 0;
         });
}

/// Gives each corner the file's normal, and the computed one of its vertex where the file has none. A vertex whose
/// corners have different ones becomes several.
void split_by_normals(const MeshData& data, const std::vector<dvec3>& file_normals, const std::vector<dvec3>& computed,
                      PlacedMesh& mesh) {
  const std::vector<std::array<int, 3>>& corners = data.normal_corners.empty() ? data.triangles : data.normal_corners;
  const std::size_t count = mesh.vertices.size();
  std::vector<int> normal_of(count, -2),
      next(count, -1);  // next: another vertex at the same place, with another normal
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    for (std::size_t k = 0; k < 3; ++k) {
      int normal = corners[t][k], vertex = mesh.triangles[t][k];
      if (normal >= 0 && at(file_normals, normal) == dvec3{0}) normal = -1;
      const auto differs = [&](int v) {
        const int other = normal_of[static_cast<std::size_t>(v)];
        return other != normal && (other < 0 || normal < 0 || at(file_normals, other) != at(file_normals, normal));
      };
      if (normal_of[static_cast<std::size_t>(vertex)] == -2) normal_of[static_cast<std::size_t>(vertex)] = normal;
      while (differs(vertex)) {
        if (next[static_cast<std::size_t>(vertex)] < 0) {
          next[static_cast<std::size_t>(vertex)] = static_cast<int>(mesh.vertices.size());
          mesh.vertices.push_back(dvec3(at(mesh.vertices, vertex)));
          normal_of.push_back(normal);
          next.push_back(-1);
        }
        vertex = next[static_cast<std::size_t>(vertex)];
      }
      mesh.triangles[t][k] = vertex;
    }
  mesh.normals.resize(mesh.vertices.size());
  for (std::size_t v = 0; v < mesh.normals.size(); ++v)
    if (normal_of[v] >= 0) mesh.normals[v] = at(file_normals, normal_of[v]);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    for (std::size_t k = 0; k < 3; ++k)
      if (const auto v = static_cast<std::size_t>(mesh.triangles[t][k]); normal_of[v] < 0)
        mesh.normals[v] = at(computed, data.triangles[t][k]);
  for (std::size_t v = 0; v < count; ++v)  // in no triangle
    if (mesh.normals[v] == dvec3{0}) mesh.normals[v] = dvec3{0, 1, 0};
}

}  // namespace

PlacedMesh place(const MeshData& data, const Placement& placement, bool smooth) {
  PlacedMesh mesh{data.vertices, data.triangles, {}};
  const bool moved = placement != Placement{};
  const glm::dmat3 turn = rotation(placement.rotate);
  if (moved)
    for (dvec3& v : mesh.vertices) v = turn * (v * placement.scale) + placement.translate;
  std::vector<dvec3> normals = smooth ? data.normals : std::vector<dvec3>{};
  if (moved)
    for (dvec3& n : normals) {
      const double size = length(n);
      if (size > 0) n = normalize(turn * (n / placement.scale));
    }
  const bool mirrored = placement.scale.x * placement.scale.y * placement.scale.z < 0;
  std::vector<dvec3> computed;
  if (smooth && (normals.empty() || lacks_normals(data))) computed = smooth_normals(mesh.vertices, mesh.triangles);
  if (mirrored)
    for (dvec3& n : computed) n = -n;
  if (normals.empty())
    mesh.normals = std::move(computed);
  else
    split_by_normals(data, normals, computed, mesh);
  // Last, so that corners have kept their order.
  if (mirrored)
    for (auto& t : mesh.triangles) std::swap(t[1], t[2]);
  return mesh;
}

std::vector<dvec3> smooth_normals(const std::vector<dvec3>& vertices,
                                  const std::vector<std::array<int, 3>>& triangles) {
  const std::vector<int> place = places_of(vertices);
  std::vector<dvec3> sums(vertices.size(), dvec3{0});
  for (const auto& t : triangles) {
    const std::array corners{at(vertices, t[0]), at(vertices, t[1]), at(vertices, t[2])};
    const dvec3 across = cross(corners[1] - corners[0], corners[2] - corners[0]);
    const double size = length(across);
    if (!(size > 0)) continue;
    for (std::size_t k = 0; k < 3; ++k) {
      const dvec3 a = corners[(k + 1) % 3] - corners[k], b = corners[(k + 2) % 3] - corners[k];
      const double angle = std::atan2(size, dot(a, b));
      sums[static_cast<std::size_t>(place[static_cast<std::size_t>(t[k])])] += across * (angle / size);
    }
  }
  std::vector<dvec3> normals(vertices.size());
  for (std::size_t v = 0; v < vertices.size(); ++v) {
    const dvec3& sum = sums[static_cast<std::size_t>(place[v])];
    const double size = length(sum);
    normals[v] = size > 1e-12 ? sum / size : dvec3{0, 1, 0};
  }
  return normals;
}

}  // namespace glimt
