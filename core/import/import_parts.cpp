#include "import/import_parts.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "mesh/mesh_file.h"
#include "scene/fields.h"
#include "scene/mesh_from_file.h"
#include "scene/surroundings.h"

namespace glimt {
namespace {

using glm::dvec3;

const Field<Material>& field_of(const Material& material, std::string_view key) {
  const auto& fields = material_info(material.type).fields;
  return *std::ranges::find(fields, key, &Field<Material>::key);
}

double clamped(double value, const Field<Material>& field) {
  return std::isnan(value) ? field.min : std::clamp(value, field.min, field.max);
}

}  // namespace

void set_parameter(Material& material, std::string_view key, const ParameterValue& value) {
  const Field<Material>& field = field_of(material, key);
  if (const auto* number = std::get_if<Value<Material, double>>(&field.member))
    number->set(material, clamped(std::get<double>(value), field));
  else if (const auto* vector = std::get_if<Value<Material, dvec3>>(&field.member)) {
    const dvec3& v = std::get<dvec3>(value);
    vector->set(material, {clamped(v.x, field), clamped(v.y, field), clamped(v.z, field)});
  }
}

void set_choice(Material& material, std::string_view key, std::string_view name) {
  const auto& choice = std::get<Choice<Material>>(field_of(material, key).member);
  choice.set(material, static_cast<int>(std::ranges::find(choice.names, name) - choice.names.begin()));
}

Material make_lambertian(std::string name, const dvec3& reflectance) {
  Material material{.name = std::move(name), .type = "lambertian"};
  set_parameter(material, "reflectance", reflectance);
  return material;
}

Material make_glass(std::string name, double ior, double alpha) {
  Material material{.name = std::move(name), .type = "glass"};
  set_parameter(material, "ior", ior);
  set_parameter(material, "roughness", std::sqrt(std::max(alpha, 0.0)));
  return material;
}

Material make_conductor(std::string name, const dvec3& eta, const dvec3& k, double alpha) {
  Material material{.name = std::move(name), .type = "conductor"};
  set_parameter(material, "eta", eta);
  set_parameter(material, "k", k);
  set_parameter(material, "roughness", std::sqrt(std::max(alpha, 0.0)));
  return material;
}

Material make_light(std::string name, const dvec3& radiance) {
  Material material{.name = std::move(name), .type = "light"};
  set_parameter(material, "radiance", radiance);
  return material;
}

std::string unused_material_name(const Scene& scene, const std::string& wish) {
  return unused_name(scene.materials, wish.empty() ? "material" : wish);
}

Camera framing(const Box& box) {
  constexpr double fov = 40, margin = 1.05;
  const dvec3 middle = 0.5 * (box.low + box.high);
  const double radius = std::max(0.5 * box.size(), 1e-6);
  const double distance = margin * radius / std::sin(0.5 * fov * std::numbers::pi / 180);
  const double rise = 15 * std::numbers::pi / 180;
  return {.eye = middle + distance * dvec3(0, std::sin(rise), std::cos(rise)), .look_at = middle, .fov_y = fov};
}

void add_lit_room(Scene& scene) {
  Box box = box_of(scene);
  const dvec3 middle = 0.5 * (box.low + box.high);
  const double radius = std::max(0.5 * box.size(), 1e-6), floor = box.low.y;
  for (int i : {0, 2}) box.low[i] = middle[i] - 2.5 * radius, box.high[i] = middle[i] + 2.5 * radius;
  box.high.y = floor + 5 * radius;
  box.add(scene.camera.eye - 0.4 * radius);
  box.add(scene.camera.eye + 0.4 * radius);
  box.low.y = std::min(floor, scene.camera.eye.y - 0.4 * radius);

  const std::string white = unused_material_name(scene, "walls"), lamp = unused_material_name(scene, "lamp");
  scene.materials.push_back(make_lambertian(white, dvec3{0.75}));
  scene.materials.push_back(make_light(lamp, dvec3{8}));
  const auto corner = [&](int x, int y, int z) {
    return dvec3{x ? box.high.x : box.low.x, y ? box.high.y : box.low.y, z ? box.high.z : box.low.z};
  };
  const auto wall = [&](const char* name, std::vector<dvec3> outline) {
    scene.polygons.push_back({unused_name(scene.polygons, name), white, std::move(outline)});
  };
  wall("floor", {corner(0, 0, 1), corner(1, 0, 1), corner(1, 0, 0), corner(0, 0, 0)});
  wall("ceiling", {corner(0, 1, 0), corner(1, 1, 0), corner(1, 1, 1), corner(0, 1, 1)});
  wall("back wall", {corner(0, 0, 0), corner(1, 0, 0), corner(1, 1, 0), corner(0, 1, 0)});
  wall("front wall", {corner(1, 0, 1), corner(0, 0, 1), corner(0, 1, 1), corner(1, 1, 1)});
  wall("left wall", {corner(0, 0, 1), corner(0, 0, 0), corner(0, 1, 0), corner(0, 1, 1)});
  wall("right wall", {corner(1, 0, 0), corner(1, 0, 1), corner(1, 1, 1), corner(1, 1, 0)});
  const double y = box.high.y - 0.005 * (box.high.y - box.low.y), side = radius;
  scene.polygons.push_back({unused_name(scene.polygons, "lamp"),
                            lamp,
                            {dvec3{middle.x - side, y, middle.z - side + 0.5 * radius},
                             dvec3{middle.x + side, y, middle.z - side + 0.5 * radius},
                             dvec3{middle.x + side, y, middle.z + side + 0.5 * radius},
                             dvec3{middle.x - side, y, middle.z + side + 0.5 * radius}}});
}

Mesh mesh_of_file(const Scene& scene, const std::filesystem::path& file, const std::string& name,
                  const std::string& material, const Placement& placement, bool smooth) {
  Mesh mesh{.name = unused_name(scene.meshes, name), .material = material};
  mesh.smooth = smooth;
  mesh.file = MeshFile{.path = std::filesystem::absolute(file).lexically_normal(), .placement = placement};
  mesh.file->data = load_mesh(mesh.file->path);
  place_from_file(mesh, scene);
  return mesh;
}

}  // namespace glimt
