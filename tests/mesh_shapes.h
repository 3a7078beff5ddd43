#pragma once

#include <cmath>
#include <map>
#include <numbers>

#include "scene_parts.h"

/// Closed meshes of any number of triangles.
namespace glimt {

/// A ball whose radius varies by `bumps`: 2 * segments * (rings - 1) triangles, fronts outwards. Closed; not convex
/// where there are bumps.
inline Mesh bumpy_ball(std::string name, std::string material, const dvec3& centre, double radius, int rings,
                       double bumps = 0) {
  const int segments = 2 * rings;
  std::vector<dvec3> vertices;
  std::vector<std::array<int, 3>> triangles;
  const auto add = [&](double theta, double phi) {
    const double r = radius * (1 + bumps * std::sin(3 * theta) * std::sin(4 * phi) * std::sin(theta));
    vertices.push_back(centre +
                       r * dvec3{std::sin(theta) * std::cos(phi), std::cos(theta), -std::sin(theta) * std::sin(phi)});
  };
  add(0, 0);
  for (int r = 1; r < rings; ++r)
    for (int s = 0; s < segments; ++s) add(std::numbers::pi * r / rings, 2 * std::numbers::pi * s / segments);
  add(std::numbers::pi, 0);
  const auto last = static_cast<int>(vertices.size()) - 1;
  const auto at = [&](int r, int s) { return r == 0 ? 0 : r == rings ? last : 1 + (r - 1) * segments + s % segments; };
  for (int r = 0; r < rings; ++r)
    for (int s = 0; s < segments; ++s) {
      if (r > 0) triangles.push_back({at(r, s), at(r + 1, s), at(r, s + 1)});
      if (r < rings - 1) triangles.push_back({at(r, s + 1), at(r + 1, s), at(r + 1, s + 1)});
    }
  return {.name = std::move(name),
          .material = std::move(material),
          .vertices = std::move(vertices),
          .triangles = std::move(triangles)};
}

/// The same surface with each triangle cut in four, `times` times.
inline Mesh subdivided(Mesh mesh, int times) {
  for (int k = 0; k < times; ++k) {
    std::vector<dvec3> vertices = mesh.vertices;
    std::vector<std::array<int, 3>> triangles;
    std::map<std::pair<int, int>, int> middles;
    const auto middle = [&](int a, int b) {
      const auto [place, fresh] = middles.try_emplace(std::minmax(a, b), static_cast<int>(vertices.size()));
      if (fresh)
        vertices.push_back((vertices[static_cast<std::size_t>(a)] + vertices[static_cast<std::size_t>(b)]) / 2.0);
      return place->second;
    };
    for (const auto& [a, b, c] : mesh.triangles) {
      const int ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
      for (const auto& t : {std::array{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}}) triangles.push_back(t);
    }
    mesh.vertices = std::move(vertices);
    mesh.triangles = std::move(triangles);
  }
  return mesh;
}

}  // namespace glimt
