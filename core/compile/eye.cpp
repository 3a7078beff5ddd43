#include "compile/eye.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>
#include <string_view>

#include "compile/reach.h"
#include "scene/file/text.h"
#include "scene/geometry/geometry_cache.h"
#include "scene/geometry/mesh_measures.h"
#include "scene/surroundings.h"

namespace glimt {
namespace {

using glm::dvec3;

// In sizes of what is around the eye.
constexpr double eye_on_surface = 0x1p-22, eye_off_surface = 0x1p-18;
/// Surfaces that one eye may lie on.
constexpr int most_surfaces = 16;

struct NearestSurface {
  double distance = std::numeric_limits<double>::infinity();
  double height = 0;  ///< of the eye over the surface's plane, to its front
  dvec3 front{0};     ///< unit
  std::string_view name;
};

/// Nothing farther than `limit` matters.
NearestSurface nearest_surface(const Scene& scene, const dvec3& eye, double limit) {
  NearestSurface nearest;
  nearest.distance = limit;
  const auto consider = [&](double distance, double height, const dvec3& front, const std::string& name) {
    if (distance < nearest.distance) nearest = {distance, height, front, name};
  };
  const auto consider_face = [&](const std::vector<dvec3>& v, const std::string& name) {
    const HalfSpace plane = plane_of(v);
    const double height = dot(plane.n, eye) - plane.d;
    if (std::abs(height) < nearest.distance) consider(distance_to_polygon(eye, v), height, plane.n, name);
  };
  for (const Polygon& p : scene.polygons) consider_face(p.vertices, p.name);
  for (const Mesh& m : scene.meshes) {
    const Box box = box_of(m);
    const dvec3 off = max(max(box.low - eye, eye - box.high), dvec3{0});
    if (is_large(m) && length(off) > nearest.distance) continue;
    for (const auto& t : m.triangles) {
      const auto v = triangle_corners(m, t);
      const dvec3 n = cross(v[1] - v[0], v[2] - v[0]);
      const double height = dot(n, eye - v[0]);
      if (height * height > nearest.distance * nearest.distance * dot(n, n) * (1 + 1e-9)) continue;
      consider_face({v.begin(), v.end()}, m.name);
    }
  }
  for (const Sphere& s : scene.spheres) {
    const dvec3 way = eye - s.center;
    const double height = length(way) - s.radius;
    if (length(way) > 0) consider(std::abs(height), height, normalize(way), s.name);
  }
  return nearest;
}

}  // namespace

void move_eye_off_surfaces(Scene& scene, std::vector<std::string>& told) {
  Camera& camera = scene.camera;
  const Box box = box_of(scene);
  const double size = local_size(box, length(camera.eye - (box.low + box.high) / 2.0));
  const dvec3 begun = camera.eye, view = normalize(camera.look_at - camera.eye);
  std::string first;
  for (int i = 0; i < most_surfaces; ++i) {
    const NearestSurface nearest = nearest_surface(scene, camera.eye, 2 * eye_on_surface * size);
    if (!(nearest.distance <= eye_on_surface * size)) break;
    if (i == 0) first = nearest.name;
    const double side = dot(nearest.front, view) < -1e-12 ? -1 : 1;
    camera.eye += nearest.front * (side * eye_off_surface * size - nearest.height);
  }
  if (camera.eye == begun) return;
  camera.look_at += camera.eye - begun;
  told.push_back("the camera is on the surface " + toml_string(first) + ": it is moved off it by " +
                 number_text(length(camera.eye - begun)) + " m, to the side it looks to");
}

}  // namespace glimt
