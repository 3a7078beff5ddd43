#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <numbers>

#include "compile/lowering.h"
#include "scene/geometry/geometry_cache.h"
#include "scene/geometry/mesh_measures.h"

namespace glimt {

using glm::dvec3;

namespace {

/// Of solids that do not overlap, one holds the other where it holds most points of its surface; a point alone could be
/// one at which they touch.
template <class Inside>
bool holds_most(const std::vector<dvec3>& points, Inside inside) {
  return 2 * static_cast<std::size_t>(std::count_if(points.begin(), points.end(), inside)) > points.size();
}

std::vector<dvec3> surface_points(const Sphere& s) {
  std::vector<dvec3> points;
  for (int axis = 0; axis < 3; ++axis)
    for (double sign : {-1.0, 1.0}) {
      points.push_back(s.center);
      points.back()[axis] += sign * s.radius;
    }
  return points;
}

double refractive_index(const Material& m) { return material_info(m.type).refractive_index(m); }

double surrounding_ior(const Scene& scene, const std::vector<dvec3>& points, const void* self) {
  double ior = 1, smallest = std::numeric_limits<double>::infinity();
  auto consider = [&](const std::string& material, double volume, auto inside) {
    const Material& m = scene.materials[static_cast<std::size_t>(material_index(scene, material))];
    if (!transmits(m) || volume >= smallest || !holds_most(points, inside)) return;
    smallest = volume;
    ior = refractive_index(m);
  };
  for (const Sphere& s : scene.spheres)
    if (&s != self)
      consider(s.material, 4.0 / 3 * std::numbers::pi * s.radius * s.radius * s.radius,
               [&](const dvec3& p) { return length(p - s.center) < s.radius; });
  for (const Mesh& m : scene.meshes)
    if (&m != self)
      consider(m.material, std::abs(signed_volume(m)),
               [&](const dvec3& p) { return std::abs(winding_number(m, p)) > 0.5; });
  return ior;
}

}  // namespace

double relative_ior(const Scene& scene, const Sphere& sphere) {
  return refractive_index(*find_material(scene, sphere.material)) /
         surrounding_ior(scene, surface_points(sphere), &sphere);
}

double relative_ior(const Scene& scene, const Mesh& mesh) {
  // The mesh may be a copy; its like in the scene has its name, which may be none, and its vertices.
  const auto self = std::find_if(scene.meshes.begin(), scene.meshes.end(),
                                 [&](const Mesh& m) { return m.name == mesh.name && m.vertices == mesh.vertices; });
  // Of a large mesh some vertices tell.
  constexpr std::size_t enough = 64;
  const std::vector<dvec3>& vertices = mesh.vertices;
  std::vector<dvec3> points;
  const std::size_t step = is_large(mesh) ? vertices.size() / enough + 1 : 1;
  for (std::size_t i = 0; i < vertices.size(); i += step) points.push_back(vertices[i]);
  return refractive_index(*find_material(scene, mesh.material)) / surrounding_ior(scene, points, &*self);
}

}  // namespace glimt
