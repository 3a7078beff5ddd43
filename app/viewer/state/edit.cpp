#include "viewer/state/edit.h"

#include <algorithm>
#include <cctype>
#include <glm/common.hpp>
#include <utility>

#include "math/box.h"
#include "scene/fields.h"
#include "scene/mesh_from_file.h"
#include "scene/validate/validate.h"

namespace glimt {
namespace {

using glm::dvec3;

/// How many objects of the scene have the material.
std::size_t users(const Scene& scene, const std::string& material) {
  const auto all = objects_of(scene);
  const auto in_parts = std::ranges::count_if(scene.meshes, [&](const Mesh& mesh) {
    return std::ranges::find(mesh.parts, material, &MeshPart::material) != mesh.parts.end();
  });
  return static_cast<std::size_t>(
      in_parts + std::ranges::count_if(all, [&](const ObjectId& o) { return material_name_of(scene, o) == material; }));
}

std::string unused_name(const Scene& scene, const std::string& wish) {
  std::string name = wish;
  for (int n = 2; find_material(scene, name) != nullptr; ++n) name = wish + "-" + std::to_string(n);
  return name;
}

std::vector<dvec3>& vertices_of(Scene& scene, const ObjectId& object) {
  return object.kind == ObjectKind::mesh ? scene.meshes[object.index].vertices.edit()
                                         : scene.polygons[object.index].vertices;
}

Box box_of(const std::vector<dvec3>& vertices) {
  Box box;
  for (const dvec3& v : vertices) box.add(v);
  return box;
}

}  // namespace

void set_material(Scene& scene, const ObjectId& object, Material material) {
  std::string& worn = material_name_of(scene, object);
  if (users(scene, worn) > 1) {
    std::string name = display_name(scene, object);
    std::ranges::replace(name, ' ', '-');
    material.name = unused_name(scene, name);
    worn = material.name;
    scene.materials.push_back(std::move(material));
    for (Mesh& mesh : scene.meshes)
      if (mesh.file) name_parts(mesh, scene);
    return;
  }
  const auto own = std::ranges::find(scene.materials, worn, &Material::name);
  material.name = own->name;
  *own = std::move(material);
}

std::string display_name(const Scene& scene, const ObjectId& object) {
  if (const std::string& name = name_of(scene, object); !name.empty()) return name;
  constexpr const char* kinds[]{"sphere", "polygon", "mesh"};
  return std::string(kinds[static_cast<int>(object.kind)]) + " " + std::to_string(object.index);
}

std::string obstacle_to(const Scene& scene, const ObjectId& object, std::string_view type) {
  Material changed = *find_material(scene, material_name_of(scene, object));
  changed.type = type;
  Scene with = scene;
  set_material(with, object, std::move(changed));
  const auto problems = validate(with);
  return problems.empty() ? std::string() : problems.front().message;
}

std::vector<ObjectId> lamps_of(const Scene& scene) {
  std::vector<ObjectId> lamps = objects_of(scene);
  std::erase_if(lamps, [&](const ObjectId& o) { return !is_lamp(*find_material(scene, material_name_of(scene, o))); });
  return lamps;
}

double size_of(const Scene& scene, const ObjectId& object) {
  if (object.kind == ObjectKind::sphere) return 2 * scene.spheres[object.index].radius;
  const Box box = box_of(object.kind == ObjectKind::mesh ? scene.meshes[object.index].vertices.get()
                                                         : scene.polygons[object.index].vertices);
  const dvec3 extent = box.high - box.low;
  return std::max({extent.x, extent.y, extent.z});
}

void scale(Scene& scene, const ObjectId& object, double factor) {
  if (object.kind == ObjectKind::sphere) {
    scene.spheres[object.index].radius *= factor;
    return;
  }
  auto& vertices = vertices_of(scene, object);
  const Box box = box_of(vertices);
  const dvec3 middle = 0.5 * (box.low + box.high);
  for (dvec3& v : vertices) v = middle + (v - middle) * factor;
  if (object.kind == ObjectKind::mesh && scene.meshes[object.index].file) {
    Placement& placement = scene.meshes[object.index].file->placement;
    placement.scale *= factor;
    placement.translate = middle + (placement.translate - middle) * factor;
  }
}

}  // namespace glimt
