#include "scene/pick.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <utility>

#include "scene/fields.h"
#include "scene/geometry/geometry_cache.h"
#include "scene/geometry/mesh_measures.h"

namespace glimt {
namespace {

using glm::dvec3;

constexpr double none = std::numeric_limits<double>::infinity();

/// Calls f with the object that the id names.
template <class S, class F>
decltype(auto) visit_object(S& scene, const ObjectId& object, F f) {
  switch (object.kind) {
    case ObjectKind::sphere:
      return f(scene.spheres[object.index]);
    case ObjectKind::mesh:
      return f(scene.meshes[object.index]);
    default:
      return f(scene.polygons[object.index]);
  }
}

/// Which sides of a surface rays meet.
enum class Sides { both, front };

double hit(const Sphere& sphere, const WorldRay& ray, Sides sides) {
  const dvec3 to_eye = ray.origin - sphere.center;
  const double a = dot(ray.direction, ray.direction), b = dot(to_eye, ray.direction);
  // The discriminant from the centre's distance to the ray: no cancellation far away.
  const dvec3 off = to_eye - ray.direction * (b / a);
  const double discriminant = a * (sphere.radius * sphere.radius - dot(off, off));
  if (discriminant < 0) return none;
  const double root = std::sqrt(discriminant);
  if (-b - root > 0) return (-b - root) / a;
  return sides == Sides::both && -b + root > 0 ? (-b + root) / a : none;
}

struct TriangleHit {
  double distance = none;
  bool front = false;
};

/// Möller and Trumbore, "Fast, minimum storage ray/triangle intersection", 1997.
TriangleHit hit(const dvec3& v0, const dvec3& v1, const dvec3& v2, const WorldRay& ray) {
  const dvec3 e1 = v1 - v0, e2 = v2 - v0, p = cross(ray.direction, e2);
  const double determinant = dot(e1, p);
  if (determinant == 0) return {};
  const dvec3 s = (ray.origin - v0) / determinant;
  const double u = dot(s, p);
  if (!(u >= 0 && u <= 1)) return {};
  const dvec3 q = cross(s, e1);
  const double v = dot(ray.direction, q), t = dot(e2, q);
  return v >= 0 && u + v <= 1 && t > 0 ? TriangleHit{t, determinant > 0} : TriangleHit{};
}

double hit(const dvec3& v0, const dvec3& v1, const dvec3& v2, const WorldRay& ray, Sides sides) {
  const TriangleHit found = hit(v0, v1, v2, ray);
  return sides == Sides::both || found.front ? found.distance : none;
}

/// Of the fan of triangles from the first vertex those cover the polygon, convex or not, that are met more often from
/// one side than from the other.
double hit(const Polygon& polygon, const WorldRay& ray, Sides sides) {
  double nearest = none;
  int fronts = 0;
  const auto& v = polygon.vertices;
  for (std::size_t i = 1; i + 1 < v.size(); ++i) {
    const TriangleHit found = hit(v[0], v[i], v[i + 1], ray);
    if (found.distance == none) continue;
    nearest = std::min(nearest, found.distance);
    fronts += found.front ? 1 : -1;
  }
  return fronts > 0 || (fronts < 0 && sides == Sides::both) ? nearest : none;
}

/// Whether the ray comes through the box.
bool meets(const Box& box, const WorldRay& ray) {
  const dvec3 a = (box.low - ray.origin) / ray.direction, b = (box.high - ray.origin) / ray.direction;
  double enters = 0, leaves = none;
  for (int axis = 0; axis < 3; ++axis) {
    // A ray along a side is left to the triangles.
    if (std::isnan(a[axis]) || std::isnan(b[axis])) continue;
    enters = std::max(enters, std::min(a[axis], b[axis]) * (1 - 1e-12));
    leaves = std::min(leaves, std::max(a[axis], b[axis]) * (1 + 1e-12));
  }
  return enters <= leaves;
}

/// Boxes around so many triangles of a large mesh at a time, in the mesh's order, which mostly has neighbours together.
constexpr std::size_t block_size = 64;

std::shared_ptr<const std::vector<Box>> block_boxes(const Mesh& mesh) {
  static GeometryCache<std::vector<Box>> cache;
  return cache.get(mesh, [&] {
    std::vector<Box> boxes(mesh.triangles.size() / block_size + 1);
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i)
      for (const dvec3& v : triangle_corners(mesh, mesh.triangles[i])) boxes[i / block_size].add(v);
    return boxes;
  });
}

double hit(const Mesh& mesh, const WorldRay& ray, Sides sides) {
  double nearest = none;
  const auto consider = [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const auto v = triangle_corners(mesh, mesh.triangles[i]);
      nearest = std::min(nearest, hit(v[0], v[1], v[2], ray, sides));
    }
  };
  const std::size_t count = mesh.triangles.size();
  if (!is_large(mesh)) {
    consider(0, count);
  } else if (meets(box_of(mesh), ray)) {
    const auto boxes = block_boxes(mesh);
    for (std::size_t k = 0; k < boxes->size(); ++k)
      if (meets((*boxes)[k], ray)) consider(k * block_size, std::min((k + 1) * block_size, count));
  }
  return nearest;
}

template <class SidesOf>
std::optional<Pick> first_hit(const Scene& scene, const WorldRay& ray, const std::optional<ObjectId>& left_out,
                              SidesOf sides_of) {
  Pick first{{}, none};
  for (const ObjectId& object : objects_of(scene)) {
    if (object == left_out) continue;
    const double distance = visit_object(scene, object, [&](const auto& o) { return hit(o, ray, sides_of(object)); });
    if (distance < first.distance) first = {object, distance};
  }
  return first.distance < none ? std::optional(first) : std::nullopt;
}

}  // namespace

std::vector<ObjectId> objects_of(const Scene& scene) {
  std::vector<ObjectId> all;
  for (std::size_t i = 0; i < scene.spheres.size(); ++i) all.push_back({ObjectKind::sphere, i});
  for (std::size_t i = 0; i < scene.meshes.size(); ++i) all.push_back({ObjectKind::mesh, i});
  for (std::size_t i = 0; i < scene.polygons.size(); ++i) all.push_back({ObjectKind::polygon, i});
  return all;
}

bool contains(const Scene& scene, const ObjectId& object) {
  switch (object.kind) {
    case ObjectKind::sphere:
      return object.index < scene.spheres.size();
    case ObjectKind::mesh:
      return object.index < scene.meshes.size();
    default:
      return object.index < scene.polygons.size();
  }
}

const std::string& name_of(const Scene& scene, const ObjectId& object) {
  return visit_object(scene, object, [](const auto& o) -> const std::string& { return o.name; });
}

const std::string& material_name_of(const Scene& scene, const ObjectId& object) {
  return visit_object(scene, object, [](const auto& o) -> const std::string& { return o.material; });
}

std::string& material_name_of(Scene& scene, const ObjectId& object) {
  return visit_object(scene, object, [](auto& o) -> std::string& { return o.material; });
}

std::optional<Pick> pick(const Scene& scene, const WorldRay& ray, const std::optional<ObjectId>& left_out) {
  return first_hit(scene, ray, left_out, [](const ObjectId&) { return Sides::both; });
}

std::optional<Pick> pick_seen(const Scene& scene, const WorldRay& ray, const std::optional<ObjectId>& left_out) {
  if (scene.camera.cutaway == Cutaway::off) return pick(scene, ray, left_out);
  return first_hit(scene, ray, left_out, [&](const ObjectId& object) {
    const Material* material = find_material(scene, material_name_of(scene, object));
    return material != nullptr && transmits(*material) ? Sides::both : Sides::front;
  });
}

}  // namespace glimt
