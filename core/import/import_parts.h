#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "import/import.h"
#include "math/box.h"
#include "scene/material.h"

/// What imports are made of. All throw SceneError or MeshFileError.
namespace glimt {

ImportedScene import_mitsuba(const std::filesystem::path& file);
ImportedScene import_gltf(const std::filesystem::path& file);
ImportedScene import_mesh(const std::filesystem::path& file);

/// Sets the parameter of that key, which the material's type reads.
void set_parameter(Material& material, std::string_view key, const ParameterValue& value);
void set_choice(Material& material, std::string_view key, std::string_view name);

Material make_lambertian(std::string name, const glm::dvec3& reflectance);
/// Alpha is the width of the distribution of slopes: roughness squared.
Material make_glass(std::string name, double ior, double alpha);
Material make_conductor(std::string name, const glm::dvec3& eta, const glm::dvec3& k, double alpha);
Material make_light(std::string name, const glm::dvec3& radiance);

/// `wish`, or "wish 2" and so on where one of the scene's materials or objects of that kind has the name.
std::string unused_material_name(const Scene& scene, const std::string& wish);
template <class T>
std::string unused_name(const std::vector<T>& objects, const std::string& wish) {
  std::string name = wish;
  const auto taken = [&] {
    for (const T& object : objects)
      if (object.name == name) return true;
    return false;
  };
  for (int n = 2; taken(); ++n) name = wish + " " + std::to_string(n);
  return name;
}

/// Looks at all that there is from the front, a little from above.
Camera framing(const Box& box);

/// A closed room with a lamp at its ceiling, which stands on the lowest point of the scene and holds the camera.
void add_lit_room(Scene& scene);

/// A whole file as one object.
Mesh mesh_of_file(const Scene& scene, const std::filesystem::path& file, const std::string& name,
                  const std::string& material, const Placement& placement, bool smooth);

}  // namespace glimt
