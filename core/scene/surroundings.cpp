#include "scene/surroundings.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <numbers>
#include <vector>

#include "scene/fields.h"
#include "scene/geometry/geometry_cache.h"
#include "scene/geometry/mesh_measures.h"
#include "scene/geometry/room.h"
#include "scene/pick.h"

namespace glimt {
namespace {

using glm::dvec3;

constexpr int directions = 32;         ///< that a closed room must hide the open in
constexpr std::size_t most_lamps = 8;  ///< a room is looked for at so many of the nearest
constexpr double step_through = 1e-9;  ///< past a glass surface, in sizes of the scene

/// Distance to the first surface that is not glass, in lengths of the direction; nothing where the ray meets none.
std::optional<double> distance_to_opaque(const Scene& scene, WorldRay ray, double size) {
  double gone = 0;
  while (const auto hit = pick(scene, ray)) {
    const double distance = gone + hit->distance;
    if (!transmits(*find_material(scene, material_name_of(scene, hit->object)))) return distance;
    const double step = hit->distance + step_through * size / length(ray.direction);
    gone += step;
    ray.origin += ray.direction * step;
  }
  return std::nullopt;
}

bool is_enclosed(const Scene& scene, const dvec3& point, double size) {
  // Points of a spiral over the sphere, each for as much of its area.
  constexpr double golden_angle = std::numbers::pi * (3 - 2.2360679774997896);
  for (int i = 0; i < directions; ++i) {
    const double y = 1 - (2 * i + 1.0) / directions, r = std::sqrt(1 - y * y), angle = golden_angle * i;
    if (!distance_to_opaque(scene, {point, {r * std::cos(angle), y, r * std::sin(angle)}}, size)) return false;
  }
  return true;
}

/// Large meshes bound no room, and rays take long to look for them.
Scene without_large_meshes(Scene scene) {
  std::erase_if(scene.meshes, is_large);
  return scene;
}

/// Rays that leave the lamps' fronts.
std::vector<WorldRay> rays_from_lamps(const Scene& scene, const dvec3& middle) {
  std::vector<WorldRay> rays;
  const auto add = [&](const std::vector<dvec3>& vertices) {
    dvec3 sum{0};
    for (const dvec3& v : vertices) sum += v;
    rays.push_back({sum / static_cast<double>(vertices.size()), plane_of(vertices).n});
  };
  for (const Polygon& p : scene.polygons)
    if (is_lamp(*find_material(scene, p.material))) add(p.vertices);
  for (const Mesh& m : scene.meshes)
    if (is_lamp(*find_material(scene, m.material)) && !m.triangles.empty())
      add(triangle_vertices(m, m.triangles.front()));
  for (const Sphere& s : scene.spheres) {
    if (!is_lamp(*find_material(scene, s.material))) continue;
    const dvec3 way = middle - s.center;
    const dvec3 out = length(way) > 0 ? normalize(way) : dvec3{0, -1, 0};
    rays.push_back({s.center + out * s.radius, out});
  }
  return rays;
}

}  // namespace

Box box_of(const Scene& scene) {
  Box box;
  for (const Polygon& p : scene.polygons)
    for (const dvec3& v : p.vertices) box.add(v);
  for (const Mesh& m : scene.meshes) {
    const Box own = box_of(m);
    if (own.low.x <= own.high.x) box.add(own.low), box.add(own.high);
  }
  for (const Sphere& s : scene.spheres) {
    box.add(s.center - s.radius);
    box.add(s.center + s.radius);
  }
  return box;
}

double size_of(const Scene& scene) { return box_of(scene).size(); }

bool is_enclosed(const Scene& scene, const dvec3& point) {
  return is_enclosed(without_large_meshes(scene), point, size_of(scene));
}

std::optional<dvec3> place_in_room(const Scene& whole, const dvec3& eye) {
  const Scene scene = without_large_meshes(whole);
  const Box box = box_of(scene);
  const double size = box.size();
  const dvec3 middle = (box.low + box.high) / 2.0;
  std::vector<WorldRay> lamps = rays_from_lamps(scene, middle);
  std::ranges::stable_sort(lamps, {}, [&](const WorldRay& ray) { return length(ray.origin - eye); });
  lamps.resize(std::min(lamps.size(), most_lamps));
  for (WorldRay& ray : lamps) {
    ray.origin += ray.direction * (step_through * size);
    const auto free = distance_to_opaque(scene, ray, size);
    const dvec3 between = ray.origin + ray.direction * (free.value_or(0) / 2);
    if (free && is_enclosed(scene, between, size)) return between;
  }
  if (!lamps.empty()) return std::nullopt;
  // Surfaces that glow light the room.
  for (const dvec3& place : {eye, scene.camera.look_at, middle})
    if (is_enclosed(scene, place, size)) return place;
  return std::nullopt;
}

}  // namespace glimt
