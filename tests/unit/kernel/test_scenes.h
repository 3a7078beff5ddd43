#pragma once

#include <cmath>
#include <numbers>

#include "scene/validate/validate.h"

/// Small scenes and meshes for the tests of validate().
namespace glimt {

using glm::dvec3;

inline Scene scene_of(std::vector<Sphere> spheres, std::vector<Polygon> polygons = {}, std::vector<Mesh> meshes = {}) {
  Scene scene;
  scene.materials = {{.name = "white"}, {.name = "glass", .type = "glass"}};
  scene.spheres = std::move(spheres);
  scene.polygons = std::move(polygons);
  scene.meshes = std::move(meshes);
  return scene;
}

using Paths = std::vector<std::string>;

/// The places where validate() finds problems.
inline Paths paths(const Scene& scene) {
  Paths result;
  for (const Problem& problem : validate(scene)) result.push_back(problem.path);
  return result;
}

// Meshes, whose triangles are counter-clockwise seen from outside.

inline Mesh cuboid(const dvec3& low, const dvec3& high) {
  Mesh mesh{.name = "", .material = "glass", .vertices = {}, .triangles = {}};
  for (int i = 0; i < 8; ++i)
    mesh.vertices.edit().push_back({i & 1 ? high.x : low.x, i & 2 ? high.y : low.y, i & 4 ? high.z : low.z});
  for (const auto& f : {std::array{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}}) {
    mesh.triangles.edit().push_back({f[0], f[1], f[2]});
    mesh.triangles.edit().push_back({f[0], f[2], f[3]});
  }
  return mesh;
}

inline Mesh cube(const dvec3& low, double edge) { return cuboid(low, low + edge); }

inline Mesh moved(Mesh mesh, const dvec3& by, double scale = 1) {
  for (dvec3& v : mesh.vertices.edit()) v = v * scale + by;
  return mesh;
}

inline Mesh turned(Mesh mesh, double angle) {
  for (dvec3& v : mesh.vertices.edit())
    v = {v.x * std::cos(angle) - v.y * std::sin(angle), v.x * std::sin(angle) + v.y * std::cos(angle), v.z};
  return mesh;
}

inline Mesh flipped(Mesh mesh) {
  for (auto& t : mesh.triangles.edit()) std::swap(t[0], t[1]);
  return mesh;
}

inline Mesh both(Mesh a, const Mesh& b) {
  const auto offset = static_cast<int>(a.vertices.size());
  a.vertices.edit().insert(a.vertices.end(), b.vertices.begin(), b.vertices.end());
  for (const auto& t : b.triangles) a.triangles.edit().push_back({t[0] + offset, t[1] + offset, t[2] + offset});
  return a;
}

/// A ball of radius 1 in rings and segments: 2 * segments * (rings - 1) triangles.
inline Mesh ball(int rings, int segments) {
  Mesh mesh{.name = "", .material = "glass", .vertices = {{0, 1, 0}}, .triangles = {}};
  for (int r = 1; r < rings; ++r)
    for (int s = 0; s < segments; ++s) {
      const double theta = std::numbers::pi * r / rings, phi = 2 * std::numbers::pi * s / segments;
      mesh.vertices.edit().push_back(
          {std::sin(theta) * std::cos(phi), std::cos(theta), -std::sin(theta) * std::sin(phi)});
    }
  const auto last = static_cast<int>(mesh.vertices.size());
  mesh.vertices.edit().push_back({0, -1, 0});
  const auto at = [&](int r, int s) { return r == 0 ? 0 : r == rings ? last : 1 + (r - 1) * segments + s % segments; };
  for (int r = 0; r < rings; ++r)
    for (int s = 0; s < segments; ++s) {
      if (r > 0) mesh.triangles.edit().push_back({at(r, s), at(r + 1, s), at(r, s + 1)});
      if (r < rings - 1) mesh.triangles.edit().push_back({at(r, s + 1), at(r + 1, s), at(r + 1, s + 1)});
    }
  return mesh;
}

}  // namespace glimt
