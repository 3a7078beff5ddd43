#include "scene/validate/validate.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <glm/geometric.hpp>
#include <set>

#include "scene/fields.h"
#include "scene/geometry/mend.h"
#include "scene/validate/validate_parts.h"

namespace glimt {
namespace {

constexpr std::int64_t max_pixels = std::int64_t{1} << 26;

template <class T>
bool in_range(const Field<T>& field, double value) {
  return value <= field.max && (field.min_excluded ? value > field.min : value >= field.min);
}

/// What is wrong with the field's value; empty where nothing is.
template <class T>
std::string field_mistake(const Field<T>& field, const T& object) {
  const std::string key(field.key);
  const auto check = [&](const std::string& name, double value) {
    return in_range(field, value) ? std::string{}
                                  : name + " is " + number_text(value) + "; allowed is " +
                                        range_text(field.min, field.max, field.min_excluded);
  };
  if (const auto* member = std::get_if<Value<T, int>>(&field.member)) return check(key, member->get(object));
  if (const auto* member = std::get_if<Value<T, double>>(&field.member)) return check(key, member->get(object));
  if (const auto* member = std::get_if<Value<T, glm::dvec3>>(&field.member)) {
    for (int i = 0; i < 3; ++i)
      if (const double value = member->get(object)[i]; !in_range(field, value))
        return check(element(key, static_cast<std::size_t>(i)), value);
    return {};
  }
  const auto& choice = std::get<Choice<T>>(field.member);
  const int value = choice.get(object);
  if (value >= 0 && value < static_cast<int>(choice.names.size())) return {};
  return key + " is number " + std::to_string(value) + "; allowed is one of " + joined(choice.names);
}

/// True where all is well.
template <class T>
bool check_fields(std::span<const Field<T>> fields, const T& object, const std::string& path, const std::string& who,
                  Problems& problems) {
  const std::size_t before = problems.size();
  for (const Field<T>& field : fields)
    if (const std::string mistake = field_mistake(field, object); !mistake.empty())
      problems.push_back({path + "." + std::string(field.key), who + ": " + mistake});
  return problems.size() == before;
}

std::string no_such_material(const Scene& scene, const std::string& who, const std::string& name) {
  std::vector<std::string_view> materials;
  for (const Material& material : scene.materials) materials.push_back(material.name);
  return who + ": there is no material " + toml_string(name) +
         (materials.empty()
              ? "; the scene has none, and a table [material.NAME] makes one"
              : "; the nearest is " + toml_string(nearest(name, materials)) + " (allowed: " + joined(materials) + ")");
}

/// How a mesh from a file is placed, and the materials of its parts.
void check_mesh_file(const Scene& scene, std::size_t index, Problems& problems) {
  const Mesh& mesh = scene.meshes[index];
  if (!mesh.file) return;
  const std::string path = element("mesh", index), who = called("mesh", mesh.name, index);
  check_fields(placement_fields(), mesh.file->placement, path, who, problems);
  const glm::dvec3& scale = mesh.file->placement.scale;
  if (scale.x == 0 || scale.y == 0 || scale.z == 0)
    problems.push_back({path + ".scale", who + ": scale has a 0; allowed is any other number"});
  for (const auto& [name, material] : mesh.file->materials)
    if (!find_material(scene, material))
      problems.push_back({path + ".materials." + key_text(name), no_such_material(scene, who, material)});
}

void check_camera(const Camera& camera, Problems& problems) {
  if (!check_fields(camera_fields(), camera, "camera", "camera", problems)) return;
  const glm::dvec3 view = camera.look_at - camera.eye;
  if (length(view) <= 1e-12 * (length(camera.eye) + length(camera.look_at)))
    problems.push_back({"camera.look_at", "camera: look_at is where eye is; allowed is any other point"});
  else if (!(length(cross(view, camera.up)) > 1e-6 * length(view) * length(camera.up)))
    problems.push_back(
        {"camera.up", "camera: up is zero or along the direction of view; allowed is any other direction"});
}

void check_image(const ImageSize& image, Problems& problems) {
  if (!check_fields(image_fields(), image, "image", "image", problems)) return;
  if (std::int64_t{image.width} * image.height > max_pixels)
    problems.push_back({image.width >= image.height ? "image.width" : "image.height",
                        "image: " + std::to_string(image.width) + " x " + std::to_string(image.height) +
                            " pixels are too many; allowed are at most " + std::to_string(max_pixels)});
}

void check_materials(const std::vector<Material>& materials, Problems& problems) {
  std::set<std::string_view> names;
  std::vector<std::string_view> types;
  for (const MaterialInfo& info : material_infos()) types.push_back(info.name);
  for (const Material& material : materials) {
    const std::string path = "material." + key_text(material.name);
    const std::string who = "material " + toml_string(material.name);
    if (material.name.empty())
      problems.push_back({path, "a material has no name; allowed is any text but the empty one"});
    if (!names.insert(material.name).second)
      problems.push_back({path, who + ": the name is taken; allowed is one that no other material has"});
    const MaterialInfo* info = find_material_info(material.type);
    if (info)
      check_fields(std::span<const Field<Material>>(info->fields), material, path, who, problems);
    else
      problems.push_back({path + ".type", who + ": there is no type " + toml_string(material.type) +
                                              "; allowed is one of " + joined(types)});
  }
}

/// Names and materials of the objects of one kind.
template <class T>
void check_objects(const Scene& scene, std::string_view kind, const std::vector<T>& objects, Problems& problems) {
  std::set<std::string_view> names;
  for (std::size_t i = 0; i < objects.size(); ++i) {
    const T& object = objects[i];
    const std::string path = element(kind, i), who = called(kind, object.name, i);
    if (!object.name.empty() && !names.insert(object.name).second)
      problems.push_back({path + ".name", who + ": the name is taken; allowed is one that no other " +
                                              std::string(kind) + " has, or none"});
    if (find_material(scene, object.material)) continue;
    problems.push_back({path + ".material", no_such_material(scene, who, object.material)});
  }
}

/// Squares of squares of lengths must fit into a float.
void check_extent(const Scene& scene, Problems& problems) {
  constexpr double least = 1e-9;
  double extent = 0;
  const glm::dvec3 eye = scene.camera.eye;
  const auto include = [&](const glm::dvec3& p) { extent = std::max(extent, length(p - eye)); };
  for (const Sphere& s : scene.spheres) extent = std::max(extent, length(s.center - eye) + s.radius);
  for (const Polygon& p : scene.polygons) std::ranges::for_each(p.vertices, include);
  for (const Mesh& m : scene.meshes) std::ranges::for_each(m.vertices, include);
  if (problems.empty() && extent < least)
    problems.push_back({"", "the scene reaches " + number_text(extent) + " m from the camera; allowed is " +
                                number_text(least) + " m or more: write its lengths in a smaller unit"});
}

}  // namespace

std::vector<Problem> validate(const Scene& scene) {
  Problems problems;
  check_camera(scene.camera, problems);
  check_image(scene.image, problems);
  check_fields(settings_fields(), scene.render, "render", "render", problems);
  check_materials(scene.materials, problems);
  check_objects(scene, "sphere", scene.spheres, problems);
  check_objects(scene, "polygon", scene.polygons, problems);
  check_objects(scene, "mesh", scene.meshes, problems);
  for (std::size_t i = 0; i < scene.spheres.size(); ++i)
    check_fields(sphere_fields(), scene.spheres[i], element("sphere", i), called("sphere", scene.spheres[i].name, i),
                 problems);
  for (std::size_t i = 0; i < scene.polygons.size(); ++i) check_polygon(scene.polygons[i], i, problems);
  for (std::size_t i = 0; i < scene.meshes.size(); ++i) check_mesh_file(scene, i, problems);
  for (std::size_t i = 0; i < scene.meshes.size(); ++i) check_mesh(scene.meshes[i], i, problems);
  if (scene.spheres.empty() && scene.polygons.empty() && scene.meshes.empty())
    problems.push_back({"", "the scene holds nothing; it takes at least one [[sphere]], [[polygon]] or [[mesh]]"});
  check_extent(scene, problems);
  if (problems.empty() && std::ranges::any_of(scene.materials, [](const Material& m) { return transmits(m); })) {
    Scene mended = mend(scene).scene;
    mended.polygons = scene.polygons;
    check_glass(mended, problems);
  }
  return problems;
}

}  // namespace glimt
