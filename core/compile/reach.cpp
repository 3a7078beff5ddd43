#include "compile/reach.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <span>

#include "scene/fields.h"
#include "scene/file/text.h"
#include "scene/geometry/geometry_cache.h"
#include "scene/geometry/mesh_measures.h"
#include "scene/surroundings.h"

namespace glimt {

using glm::dvec3;

int material_index(const Scene& scene, const std::string& name) {
  const auto it =
      std::find_if(scene.materials.begin(), scene.materials.end(), [&](const Material& m) { return m.name == name; });
  return static_cast<int>(it - scene.materials.begin());
}

namespace {

/// Faces that could bound a room: of polygons and of small opaque meshes.
std::vector<Face> faces_of(const Scene& scene) {
  std::vector<Face> faces;
  for (const Polygon& p : scene.polygons) faces.push_back({p.vertices, material_index(scene, p.material)});
  for (const Mesh& m : scene.meshes) {
    const int material = material_index(scene, m.material);
    if (m.triangles.size() <= max_room_mesh_triangles &&
        !transmits(scene.materials[static_cast<std::size_t>(material)]))
      for (const auto& t : m.triangles) faces.push_back({triangle_vertices(m, t), material});
  }
  return faces;
}

/// Whether there is a closed room that the eye, which is in none, does not see into.
bool is_outside(const Scene& scene, const std::vector<Face>& faces, double tolerance) {
  const dvec3& eye = scene.camera.eye;
  const auto place = place_in_room(scene, eye);
  if (!place) return false;
  if (!find_room(faces, *place, tolerance).empty()) return true;
  return std::ranges::any_of(scene.spheres, [&](const Sphere& s) {
    return s.radius > length(*place - s.center) && s.radius < length(eye - s.center) &&
           !transmits(*find_material(scene, s.material));
  });
}

enum class Place { inside, piercing, on_face, outside };

/// Where vertices with a ball of that radius about each lie.
Place place(const Reach& reach, std::span<const dvec3> vertices, double radius) {
  Place result = Place::inside;
  for (const RoomFace& face : reach.room) {
    double nearest = std::numeric_limits<double>::infinity(), farthest = -nearest;
    for (const dvec3& v : vertices) {
      const double distance = dot(face.inside.n, v) - face.inside.d;
      nearest = std::min(nearest, distance - radius);
      farthest = std::max(farthest, distance + radius);
    }
    if (nearest >= -reach.tolerance) return farthest <= reach.tolerance ? Place::on_face : Place::outside;
    if (farthest > reach.tolerance) result = Place::piercing;
  }
  return result;
}

std::vector<dvec3> corners_of(const Box& box) {
  std::vector<dvec3> corners;
  corners.reserve(8);
  for (int i = 0; i < 8; ++i)
    corners.push_back({(i & 1) != 0 ? box.high.x : box.low.x, (i & 2) != 0 ? box.high.y : box.low.y,
                       (i & 4) != 0 ? box.high.z : box.low.z});
  return corners;
}

bool bounds_room(const Reach& reach, const Polygon& polygon, int material) {
  const dvec3 n = plane_of(polygon.vertices).n;
  return std::any_of(reach.room.begin(), reach.room.end(), [&](const RoomFace& face) {
    const bool in_plane = std::all_of(polygon.vertices.begin(), polygon.vertices.end(), [&](const dvec3& v) {
      return std::abs(dot(face.inside.n, v) - face.inside.d) <= reach.tolerance;
    });
    return in_plane && face.material == material && face.front == (dot(n, face.inside.n) < 0);
  });
}

}  // namespace

double local_size(const Box& scene, double from_centre) { return std::min(scene.size(), 16 * from_centre); }

Reach find_reach(const Scene& scene) {
  Reach reach;
  // Single precision keeps positions to about 2^-24 of the scene's size; four bits more are what a hit point may be
  // off.
  reach.tolerance = size_of(scene) * 0x1p-20;
  const std::vector<Face> faces = faces_of(scene);
  const bool cutaway = scene.camera.cutaway == Cutaway::on;
  reach.inside = cutaway ? place_in_room(scene, scene.camera.eye) : std::optional(scene.camera.eye);
  // Looking for a room takes long among many planes; a view of the open rules one out.
  if (reach.inside && is_enclosed(scene, *reach.inside)) reach.room = find_room(faces, *reach.inside, reach.tolerance);
  reach.camera_outside = !cutaway && reach.room.empty() && is_outside(scene, faces, reach.tolerance);
  gather_objects(scene, reach);
  return reach;
}

void gather_objects(const Scene& scene, Reach& reach) {
  reach.spheres.clear();
  reach.polygons.clear();
  reach.meshes.clear();
  reach.lamp_pierces_room = false;
  reach.left_out.clear();
  reach.warnings.clear();
  if (reach.camera_outside)
    reach.warnings.emplace_back(
        "the camera is outside the room, whose walls hide what is in it: move it into the room, or see through them "
        "with camera.cutaway = \"on\"");

  auto is_light = [&](const std::string& material) {
    return is_lamp(scene.materials[static_cast<std::size_t>(material_index(scene, material))]);
  };
  auto leave_out = [&](const auto& object, bool in_wall) {
    reach.left_out.push_back(toml_string(object.name) +
                             (in_wall ? ", in the plane of a wall" : ", outside the closed room"));
    if (is_light(object.material))
      reach.warnings.push_back("the lamp " + toml_string(object.name) +
                               (in_wall ? " lies in the plane of a wall, which hides it: move it into the room"
                                        : " is outside the closed room and lights nothing"));
  };
  auto keep = [&](const auto& object, const std::vector<dvec3>& vertices, double radius, auto& kept, auto&& kept_form) {
    const Place where = place(reach, vertices, radius);
    if (where == Place::inside || where == Place::piercing) {
      kept.push_back(kept_form);
      if (where == Place::piercing && is_light(object.material)) reach.lamp_pierces_room = true;
      return;
    }
    leave_out(object, where == Place::on_face);
  };
  for (const Polygon& p : scene.polygons)
    if (!bounds_room(reach, p, material_index(scene, p.material))) keep(p, p.vertices, 0, reach.polygons, &p);
  for (const Mesh& m : scene.meshes) {
    if (is_large(m) && place(reach, corners_of(box_of(m)), 0) == Place::inside) {
      reach.meshes.push_back(m);
      continue;
    }
    if (is_closed(m) && !(reach.inside && std::abs(winding_number(m, *reach.inside)) > 0.5)) {
      keep(m, m.vertices, 0, reach.meshes, m);
      continue;
    }
    // Some of its triangles may be the room's own.
    bool bounds = false, in_wall = false, pierces = false;
    std::vector<std::array<int, 3>> kept;
    for (const auto& t : m.triangles) {
      const auto corners = triangle_corners(m, t);
      const Place where = place(reach, corners, 0);
      in_wall |= where == Place::on_face;
      pierces |= where == Place::piercing;
      if (where == Place::inside || where == Place::piercing)
        kept.push_back(t);
      else
        bounds |= bounds_room(reach, {{}, {}, {corners.begin(), corners.end()}}, material_index(scene, m.material));
    }
    Mesh rest = m;
    if (kept.size() < m.triangles.size()) rest.triangles = std::move(kept);
    if (pierces && is_light(m.material)) reach.lamp_pierces_room = true;
    if (!rest.triangles.empty()) {
      reach.meshes.push_back(std::move(rest));
    } else if (!bounds) {
      leave_out(m, in_wall);
    }
  }
  for (const Sphere& s : scene.spheres) keep(s, {s.center}, s.radius, reach.spheres, &s);
}

}  // namespace glimt
