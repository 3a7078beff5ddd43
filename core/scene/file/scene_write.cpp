#include "scene/fields.h"
#include "scene/file/mesh_hash.h"
#include "scene/file/scene_file.h"
#include "scene/file/text.h"

namespace glimt {
namespace {

std::string vector_text(const glm::dvec3& v) {
  return std::string("[") + number_text(v.x) + ", " + number_text(v.y) + ", " + number_text(v.z) + "]";
}

template <class T>
std::string value_text(const Field<T>& field, const T& object) {
  if (const auto* member = std::get_if<Value<T, int>>(&field.member)) return std::to_string(member->get(object));
  if (const auto* member = std::get_if<Value<T, double>>(&field.member)) return number_text(member->get(object));
  if (const auto* member = std::get_if<Value<T, glm::dvec3>>(&field.member)) return vector_text(member->get(object));
  const auto& choice = std::get<Choice<T>>(field.member);
  return toml_string(choice.names[static_cast<std::size_t>(choice.get(object))]);
}

std::string line(std::string_view key, const std::string& value) { return std::string(key) + " = " + value + "\n"; }

/// The required fields, and the others where they differ from `defaults`.
template <class T>
std::string field_lines(std::span<const Field<T>> fields, const T& object, const T& defaults = {}) {
  std::string text;
  for (const Field<T>& field : fields) {
    const std::string value = value_text(field, object);
    if (field.required || value != value_text(field, defaults)) text += line(field.key, value);
  }
  return text;
}

/// "[a, b, c]" of whatever `element_text` makes of the elements.
template <class T, class Text>
std::string array_text(const std::vector<T>& elements, Text element_text) {
  std::string text;
  for (const T& element : elements) text += (text.empty() ? "" : ", ") + element_text(element);
  return std::string("[") + text + "]";
}

std::string triangle_text(const std::array<int, 3>& t) {
  return std::string("[") + std::to_string(t[0]) + ", " + std::to_string(t[1]) + ", " + std::to_string(t[2]) + "]";
}

std::string name_line(const std::string& name) { return name.empty() ? "" : line("name", toml_string(name)); }

std::string file_lines(const MeshFile& file, const std::filesystem::path& folder) {
  const Placement& placement = file.placement;
  const bool is_record = folder.empty();
  const std::filesystem::path path =
      is_record ? file.path : file.path.lexically_proximate(std::filesystem::absolute(folder).lexically_normal());
  std::string text = line("file", toml_string(path.generic_string()));
  if (is_record) text += line("hash", toml_string(hash_text(*file.data)));
  const glm::dvec3& scale = placement.scale;
  if (scale.x == scale.y && scale.x == scale.z) {
    if (scale.x != 1) text += line("scale", number_text(scale.x));
  } else {
    text += line("scale", vector_text(scale));
  }
  if (placement.rotate != glm::dvec3{0}) text += line("rotate", vector_text(placement.rotate));
  if (placement.translate != glm::dvec3{0}) text += line("translate", vector_text(placement.translate));
  std::string names;
  for (const auto& [name, material] : file.materials)
    names += (names.empty() ? "" : ", ") + key_text(name) + " = " + toml_string(material);
  if (!names.empty()) text += line("materials", "{" + names + "}");
  return text;
}

}  // namespace

std::string write_scene(const Scene& scene, const std::filesystem::path& folder) {
  std::string text = name_line(scene.name);
  const auto section = [&](const std::string& header) { text += (text.empty() ? "" : "\n") + header + "\n"; };

  section("[camera]");
  text += field_lines(camera_fields(), scene.camera);
  section("[image]");
  text += field_lines(image_fields(), scene.image);
  Settings begun;  // what a reader of the file has after its method
  set_method(begun, scene.render.method);
  begun.method = {};
  if (const std::string settings = field_lines(settings_fields(), scene.render, begun); !settings.empty()) {
    section("[render]");
    text += settings;
  }
  for (const Material& material : scene.materials) {
    const MaterialInfo& info = material_info(material.type);
    section("[material." + key_text(material.name) + "]");
    text += line("type", toml_string(info.name)) + field_lines(std::span<const Field<Material>>(info.fields), material);
  }
  for (const Sphere& sphere : scene.spheres) {
    section("[[sphere]]");
    text +=
        name_line(sphere.name) + field_lines(sphere_fields(), sphere) + line("material", toml_string(sphere.material));
  }
  for (const Polygon& polygon : scene.polygons) {
    section("[[polygon]]");
    text += name_line(polygon.name) + line("material", toml_string(polygon.material)) +
            line("vertices", array_text(polygon.vertices, vector_text));
  }
  for (const Mesh& mesh : scene.meshes) {
    section("[[mesh]]");
    text += name_line(mesh.name) + line("material", toml_string(mesh.material));
    if (mesh.file)
      text += file_lines(*mesh.file, folder);
    else
      text += line("vertices", array_text(mesh.vertices.get(), vector_text)) +
              line("triangles", array_text(mesh.triangles.get(), triangle_text));
    if (mesh.smooth) text += line("smooth", "true");
  }
  return text;
}

}  // namespace glimt
