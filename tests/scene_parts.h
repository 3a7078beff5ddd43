#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
#include <random>
#include <string>
#include <vector>

#include "material/list.h"
#include "scene/scene.h"

/// The pieces of test scenes.
namespace glimt {

using glm::dvec3;

inline Material lambertian(std::string name, const dvec3& reflectance, const dvec3& emission = dvec3{0}) {
  return Material{.name = std::move(name)}.with(Matt::reflectance, reflectance).with(Matt::emission, emission);
}
inline Material mirror(std::string name, const dvec3& reflectance) {
  return Material{.name = std::move(name), .type = "mirror"}.with(Mirror::reflectance, reflectance);
}
inline Material glass(std::string name, double ior, Fresnel fresnel = Fresnel::exact) {
  return Material{.name = std::move(name), .type = "glass"}.with(Glass::ior, ior).with(Glass::fresnel, fresnel);
}
inline Material light(std::string name, const dvec3& radiance) {
  return Material{.name = std::move(name), .type = "light"}.with(Light::radiance, radiance);
}
inline Material oren_nayar(std::string name, double roughness, const dvec3& reflectance,
                           OrenNayarFormula formula = OrenNayarFormula::published) {
  return Material{.name = std::move(name), .type = "oren-nayar"}
      .with(OrenNayar::roughness, roughness)
      .with(OrenNayar::reflectance, reflectance)
      .with(OrenNayar::formula, formula);
}
inline Material eon(std::string name, double roughness, const dvec3& reflectance) {
  return Material{.name = std::move(name), .type = "eon"}
      .with(Eon::roughness, roughness)
      .with(Eon::reflectance, reflectance);
}

/// A square lamp that shines down, with this edge length, centred on the y axis.
inline Polygon square_lamp(double edge, double y, const std::string& material = "lamp") {
  const double h = edge / 2;
  return {"lamp", material, {{-h, y, -h}, {h, y, -h}, {h, y, h}, {-h, y, h}}};
}

/// The six walls of an axis-parallel box, fronts inwards.
inline std::vector<Polygon> box(const dvec3& low, const dvec3& high, const std::string& material) {
  const auto [a, b, c] = std::array{low.x, low.y, low.z};
  const auto [x, y, z] = std::array{high.x, high.y, high.z};
  return {{"floor", material, {{a, b, z}, {x, b, z}, {x, b, c}, {a, b, c}}},
          {"ceiling", material, {{a, y, c}, {x, y, c}, {x, y, z}, {a, y, z}}},
          {"back", material, {{a, b, c}, {x, b, c}, {x, y, c}, {a, y, c}}},
          {"front", material, {{x, b, z}, {a, b, z}, {a, y, z}, {x, y, z}}},
          {"left", material, {{a, b, z}, {a, b, c}, {a, y, c}, {a, y, z}}},
          {"right", material, {{x, b, c}, {x, b, z}, {x, y, z}, {x, y, c}}}};
}

/// The same as one mesh of twelve triangles.
inline Mesh box_mesh(const dvec3& low, const dvec3& high, const std::string& material, bool fronts_inwards) {
  Mesh mesh{.name = "box", .material = material, .vertices = {}, .triangles = {}};
  for (const Polygon& wall : box(low, high, material)) {
    const int first = static_cast<int>(mesh.vertices.size());
    mesh.vertices.edit().insert(mesh.vertices.end(), wall.vertices.begin(), wall.vertices.end());
    mesh.triangles.edit().push_back({first, first + 1, first + 2});
    mesh.triangles.edit().push_back({first, first + 2, first + 3});
  }
  // Triangles share corners, so the mesh is closed.
  std::vector<dvec3> corners;
  std::vector<int> corner_of;
  for (const dvec3& v : mesh.vertices) {
    auto at = std::find(corners.begin(), corners.end(), v);
    if (at == corners.end()) at = corners.insert(corners.end(), v);
    corner_of.push_back(static_cast<int>(at - corners.begin()));
  }
  for (auto& t : mesh.triangles.edit()) {
    for (int& i : t) i = corner_of[static_cast<std::size_t>(i)];
    if (!fronts_inwards) std::swap(t[0], t[1]);
  }
  mesh.vertices = corners;
  return mesh;
}

/// A regular tetrahedron, fronts outwards. `size` is the distance from its centre to its corners.
inline Mesh tetrahedron(std::string name, std::string material, const dvec3& centre, double size) {
  const double s = size / std::sqrt(3.0);
  return {.name = std::move(name),
          .material = std::move(material),
          .vertices = {centre + s * dvec3{1, 1, 1}, centre + s * dvec3{-1, -1, 1}, centre + s * dvec3{-1, 1, -1},
                       centre + s * dvec3{1, -1, -1}},
          .triangles = {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}}};
}

/// A tetrahedron with one side pushed in: closed and not convex, fronts outwards.
inline Mesh dented(std::string name, std::string material, const dvec3& centre, double size) {
  Mesh mesh = tetrahedron(std::move(name), std::move(material), centre, size);
  mesh.vertices.edit().push_back(centre);  // inside side (1, 2, 3)
  mesh.triangles.edit().pop_back();
  for (const auto& t : {std::array{1, 2, 4}, {2, 3, 4}, {3, 1, 4}}) mesh.triangles.edit().push_back(t);
  return mesh;
}

/// Two tangents that form a right-handed frame with `normal` as z.
inline std::array<dvec3, 2> tangents(const dvec3& normal) {
  const dvec3 u = normalize(cross(normal, std::abs(normal.x) < 0.6 ? dvec3{1, 0, 0} : dvec3{0, 1, 0}));
  return {u, cross(normal, u)};
}

/// A polygon with `sides` corners on an ellipse.
inline Polygon disk(std::string name, std::string material, const dvec3& centre, const dvec3& normal, double size,
                    int sides) {
  const auto [u, v] = tangents(normal);
  Polygon polygon{std::move(name), std::move(material), {}};
  for (int i = 0; i < sides; ++i) {
    const double angle = 2 * std::numbers::pi * (i + 0.3) / sides;
    polygon.vertices.push_back(centre + size * (std::cos(angle) * u + 0.7 * std::sin(angle) * v));
  }
  return polygon;
}

}  // namespace glimt
