#include <algorithm>
#include <array>
#include <cerrno>
#include <fstream>
#include <iostream>
#include <iterator>
#include <memory>
#include <system_error>

#include "scene/fields.h"
#include "scene/file/mesh_read.h"
#include "scene/file/overrides.h"
#include "scene/file/scene_file.h"
#include "scene/file/text.h"
#include "scene/file/toml_nodes.h"
#include "scene/validate/validate.h"

namespace glimt {
namespace {

using Keys = std::vector<std::string_view>;

template <class T>
Keys keys_of(std::span<const Field<T>> fields, Keys keys = {}) {
  for (const Field<T>& field : fields) keys.push_back(field.key);
  return keys;
}

template <class T>
void read_member(const toml::node& node, const Field<T>& field, T& object) {
  const std::string key(field.key);
  if (const auto* integer = std::get_if<Value<T, int>>(&field.member))
    integer->set(object, as_integer(node, key, static_cast<int>(field.min), static_cast<int>(field.max)));
  else if (const auto* number = std::get_if<Value<T, double>>(&field.member))
    number->set(object, as_number(node, key));
  else if (const auto* vector = std::get_if<Value<T, glm::dvec3>>(&field.member))
    vector->set(object, as_vector(node, key));
  else if (const auto* choice = std::get_if<Choice<T>>(&field.member))
    choice->set(object, as_choice(node, key, choice->names));
}

template <class T>
void read_fields(const toml::table& table, const std::string& where, std::span<const Field<T>> fields, T& object) {
  for (const Field<T>& field : fields) {
    if (field.required) required(table, where, field.key);
    if (const toml::node* node = table.get(field.key)) read_member(*node, field, object);
  }
}

/// A table that holds the fields and nothing else.
template <class T>
void read_section(const toml::node& node, const std::string& key, std::span<const Field<T>> fields, T& object) {
  const std::string where = "[" + key + "]";
  const toml::table& table = as_table(node, key);
  check_known(table, where, keys_of(fields));
  read_fields(table, where, fields, object);
}

/// The names of the material types that read the key.
Keys readers_of(std::string_view key) {
  Keys types;
  for (const MaterialInfo& info : material_infos())
    if (std::ranges::find(info.fields, key, &Field<Material>::key) != info.fields.end()) types.push_back(info.name);
  return types;
}

Material read_material(const std::string& name, const toml::node& node) {
  const std::string where = "[material." + key_text(name) + "]";
  const toml::table& table = as_table(node, where);
  Keys types;
  for (const MaterialInfo& info : material_infos()) types.push_back(info.name);
  const toml::node& type = required(table, where, "type");
  const MaterialInfo& info = material_infos()[static_cast<std::size_t>(as_choice(type, "type", types))];
  const std::span<const Field<Material>> fields(info.fields);

  Keys known = keys_of(fields, {"type"});
  for (const Entry& entry : entries_in_order(table)) {
    const std::string_view key = entry.key->str();
    const Keys readers = readers_of(key);
    if (readers.empty() || std::ranges::find(known, key) != known.end()) continue;
    // A type given by an override may leave parameters behind that only the file's type reads.
    const bool left_behind = is_override(type.source()) && !is_override(entry.value->source());
    if (!left_behind)
      fail(entry.key->source(), toml_string(key) + " is read by " + joined(readers) + ", not by " +
                                    std::string(info.name) + " (allowed: " + joined(known) + ")");
    known.push_back(key);
  }
  check_known(table, where, known);

  Material material{.name = name, .type = std::string(info.name)};
  for (const Field<Material>& field : fields)
    if (field.required && !table.contains(field.key))
      fail(is_override(type.source()) ? type.source() : table.source(), where + " has no " + toml_string(field.key) +
                                                                            ", which a material of type " +
                                                                            std::string(info.name) + " must have");
  read_fields(table, where, fields, material);
  return material;
}

/// Each table of an array of tables: its name and material, and what `read` reads of it.
template <class T, class Read>
void read_objects(const toml::table& root, const std::string& kind, const Keys& keys, std::vector<T>& objects,
                  Read read) {
  const toml::node* node = root.get(kind);
  if (!node) return;
  const std::string where = "[[" + kind + "]]";
  Keys known{"name", "material"};
  known.insert(known.end(), keys.begin(), keys.end());
  for (const toml::node& element : as_array(*node, kind, "tables (" + where + ")")) {
    const toml::table& table = as_table(element, kind);
    check_known(table, where, known);
    T object;
    if (const toml::node* name = table.get("name")) object.name = as_string(*name, "name");
    object.material = as_string(required(table, where, "material"), "material");
    read(table, where, object);
    objects.push_back(std::move(object));
  }
}

void read_polygon(const toml::table& table, const std::string& where, Polygon& polygon) {
  for (const toml::node& vertex : as_array(required(table, where, "vertices"), "vertices", "[x, y, z]"))
    polygon.vertices.push_back(as_vector(vertex, "vertices[" + std::to_string(polygon.vertices.size()) + "]"));
}

/// Mesh files are named relative to `folder`.
Scene read_tree(const toml::table& root, const std::filesystem::path& folder) {
  Scene scene;
  const Keys known{"name", "camera", "image", "render", "material", "sphere", "polygon", "mesh"};
  check_known(root, "the scene", known);
  if (const toml::node* name = root.get("name")) scene.name = as_string(*name, "name");
  read_section(required(root, "the scene", "camera"), "camera", camera_fields(), scene.camera);
  read_section(required(root, "the scene", "image"), "image", image_fields(), scene.image);
  if (const toml::node* render = root.get("render")) read_section(*render, "render", settings_fields(), scene.render);
  if (const toml::node* materials = root.get("material"))
    for (const Entry& entry : entries_in_order(as_table(*materials, "material")))
      scene.materials.push_back(read_material(std::string(entry.key->str()), *entry.value));
  read_objects(root, "sphere", keys_of(sphere_fields()), scene.spheres,
               [](const toml::table& table, const std::string& where, Sphere& sphere) {
                 read_fields(table, where, sphere_fields(), sphere);
               });
  read_objects(root, "polygon", {"vertices"}, scene.polygons, read_polygon);
  const auto keys = mesh_keys();
  read_objects(
      root, "mesh", Keys(keys.begin(), keys.end()), scene.meshes,
      [&](const toml::table& table, const std::string&, Mesh& mesh) { read_mesh(table, folder, scene, mesh); });
  return scene;
}

[[noreturn]] void cannot_read(const std::filesystem::path& file, std::error_code reason) {
  throw SceneError(file.string() + ": cannot be read: " + reason.message());
}

/// Whole; refused where it is no text, or has no end.
std::string text_of(std::istream& stream, const std::string& name) {
  constexpr std::size_t most = std::size_t{1} << 30;
  std::string text;
  std::array<char, 1 << 16> buffer;
  while (stream.read(buffer.data(), buffer.size()), stream.gcount() > 0) {
    text.append(buffer.data(), static_cast<std::size_t>(stream.gcount()));
    if (text.find('\0', text.size() - static_cast<std::size_t>(stream.gcount())) != std::string::npos)
      throw SceneError(name + ": holds a zero byte, so it is no text; allowed is TOML (https://toml.io)");
    if (text.size() > most) throw SceneError(name + ": has no end within 1 GiB; allowed are shorter scenes");
  }
  return text;
}

/// Kept, because it can be read only once.
const std::string& standard_input() {
  static const std::string text = text_of(std::cin, "standard input");
  return text;
}

/// Says that the scene breaks a rule. At a place of the file where an override of something else is the reason, names
/// that override.
[[noreturn]] void fail_rule(const Problem& problem, const toml::table& root, std::string_view text,
                            std::string_view file_name, std::span<const std::string> overrides) {
  toml::source_region place = locate(root, problem.path);
  if (!is_override(place) && !overrides.empty()) try {
      parse_scene(text, file_name, overrides.first(overrides.size() - 1));
      place.path = std::make_shared<const std::string>(std::string(override_prefix) + overrides.back());
    } catch (const SceneError& error) {
      if (std::string_view(error.what()).ends_with(": " + problem.message)) throw;
    }
  fail(place, problem.message);
}

}  // namespace

Scene parse_scene(std::string_view text, std::string_view file_name, std::span<const std::string> overrides) {
  toml::table root;
  try {
    root = toml::parse(text, file_name);
  } catch (const toml::parse_error& error) {
    fail(error.source(), std::string(error.description()) + "; allowed is TOML (https://toml.io)");
  }
  for (const std::string& text_of_override : overrides) apply_override(root, text_of_override);
  Scene scene = read_tree(root, std::filesystem::path(file_name).parent_path());
  const std::vector<Problem> problems = validate(scene);
  if (!problems.empty()) fail_rule(problems.front(), root, text, file_name, overrides);
  return scene;
}

Scene read_scene(const std::filesystem::path& file, std::span<const std::string> overrides) {
  std::error_code error;
  if (file == "-") return parse_scene(standard_input(), "standard input", overrides);
  if (std::filesystem::is_directory(file, error)) cannot_read(file, std::make_error_code(std::errc::is_a_directory));
  errno = 0;
  std::ifstream stream(file, std::ios::binary);
  const std::string text = text_of(stream, file.string());
  if (!stream.is_open() || stream.bad()) cannot_read(file, {errno ? errno : EIO, std::generic_category()});
  return parse_scene(text, file.string(), overrides);
}

}  // namespace glimt
