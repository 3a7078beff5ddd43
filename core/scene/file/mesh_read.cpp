#include "scene/file/mesh_read.h"

#include <algorithm>
#include <array>
#include <limits>

#include "mesh/mesh_file.h"
#include "scene/file/mesh_hash.h"
#include "scene/file/text.h"
#include "scene/mesh_from_file.h"

namespace glimt {
namespace {

namespace fs = std::filesystem;

const std::string mesh_table = "[[mesh]]";
constexpr std::array<std::string_view, 9> all_keys{"vertices",  "triangles", "file",      "scale", "rotate",
                                                   "translate", "smooth",    "materials", "hash"};
constexpr std::array<std::string_view, 5> file_keys{"scale", "rotate", "translate", "materials", "hash"};

void read_vertices(const toml::table& table, PlacedMesh& mesh) {
  for (const toml::node& vertex : as_array(required(table, mesh_table, "vertices"), "vertices", "[x, y, z]"))
    mesh.vertices.push_back(as_vector(vertex, "vertices[" + std::to_string(mesh.vertices.size()) + "]"));
}

void read_triangles(const toml::table& table, PlacedMesh& mesh) {
  using Limits = std::numeric_limits<int>;
  for (const toml::node& node : as_array(required(table, mesh_table, "triangles"), "triangles", "[i, j, k]")) {
    const std::string key = "triangles[" + std::to_string(mesh.triangles.size()) + "]";
    const toml::array& indices = as_array(node, key, "3 vertex indices");
    if (indices.size() != 3)
      fail(node.source(),
           key + ": expected an array of 3 vertex indices, found " + std::to_string(indices.size()) + " elements");
    std::array<int, 3> triangle{};
    for (std::size_t k = 0; k < 3; ++k)
      triangle[k] = as_integer(indices[k], key + "[" + std::to_string(k) + "]", Limits::min(), Limits::max());
    mesh.triangles.push_back(triangle);
  }
}

bool are_in_range(const std::vector<std::array<int, 3>>& triangles, std::size_t vertices) {
  return std::ranges::all_of(triangles, [&](const auto& t) {
    return std::ranges::all_of(t, [&](int i) { return i >= 0 && static_cast<std::size_t>(i) < vertices; });
  });
}

glm::dvec3 read_scale(const toml::node& node) {
  return node.is_number() ? glm::dvec3(as_number(node, "scale")) : as_vector(node, "scale");
}

Placement read_placement(const toml::table& table) {
  Placement placement;
  if (const toml::node* node = table.get("scale")) placement.scale = read_scale(*node);
  if (const toml::node* node = table.get("rotate")) placement.rotate = as_vector(*node, "rotate");
  if (const toml::node* node = table.get("translate")) placement.translate = as_vector(*node, "translate");
  return placement;
}

std::shared_ptr<const MeshData> load(const toml::node& node, const fs::path& path) {
  try {
    return load_mesh(path);
  } catch (const MeshFileError& error) {
    fail(node.source(), "file: " + std::string(error.what()));
  }
}

void check_hash(const toml::table& table, const MeshFile& file) {
  const toml::node* hash = table.get("hash");
  if (hash && as_string(*hash, "hash") != hash_text(*file.data))
    fail(table.get("file")->source(), "file: " + file.path.string() + " holds another mesh than when this was written");
}

void read_materials(const toml::table& table, MeshFile& file) {
  const toml::node* node = table.get("materials");
  if (!node) return;
  std::vector<std::string_view> names;
  for (const MeshGroup& group : file.data->groups) names.push_back(group.material);
  for (const Entry& entry : entries_in_order(as_table(*node, "materials"))) {
    const std::string name(entry.key->str());
    if (std::ranges::find(names, name) == names.end())
      fail(entry.key->source(), "materials: the file has no material " + toml_string(name) + "; the nearest is " +
                                    toml_string(nearest(name, names)) + " (allowed: " + joined(names) + ")");
    file.materials[name] = as_string(*entry.value, "materials." + key_text(name));
  }
}

void read_file(const toml::table& table, const fs::path& folder, const Scene& scene, Mesh& mesh) {
  const toml::node& node = *table.get("file");
  for (const char* key : {"vertices", "triangles"})
    if (const toml::node* other = table.get(key))
      fail(other->source(), std::string(key) + ": the mesh has a file; allowed is either");
  const fs::path name = as_string(node, "file");
  MeshFile file{.path = fs::absolute(folder / name).lexically_normal(), .placement = read_placement(table)};
  // A picture may have come here with its mesh from elsewhere.
  std::error_code error;
  if (name.is_absolute() && !fs::exists(file.path, error) && fs::exists(folder / name.filename(), error))
    file.path = fs::absolute(folder / name.filename()).lexically_normal();
  file.data = load(node, file.path);
  check_hash(table, file);
  read_materials(table, file);
  mesh.file = std::move(file);
  place_from_file(mesh, scene);
}

void read_lists(const toml::table& table, Mesh& mesh) {
  for (const std::string_view key : file_keys)
    if (const toml::node* node = table.get(key))
      fail(node->source(), std::string(key) + ": the mesh has no file, which it is about");
  PlacedMesh read;
  read_vertices(table, read);
  read_triangles(table, read);
  if (mesh.smooth && are_in_range(read.triangles, read.vertices.size()))
    mesh.normals = smooth_normals(read.vertices, read.triangles);
  mesh.vertices = std::move(read.vertices);
  mesh.triangles = std::move(read.triangles);
}

}  // namespace

std::span<const std::string_view> mesh_keys() { return all_keys; }

void read_mesh(const toml::table& table, const fs::path& folder, const Scene& scene, Mesh& mesh) {
  if (const toml::node* smooth = table.get("smooth")) mesh.smooth = as_boolean(*smooth, "smooth");
  if (table.contains("file"))
    read_file(table, folder, scene, mesh);
  else
    read_lists(table, mesh);
}

}  // namespace glimt
