#define TINYGLTF_IMPLEMENTATION
#include "mesh/gltf_document.h"

#include <algorithm>
#include <exception>
#include <glm/ext/matrix_transform.hpp>
#include <glm/gtc/quaternion.hpp>
#include <limits>
#include <new>
#include <ranges>
#include <vector>

#include "mesh/mesh_file.h"

namespace glimt {
namespace fs = std::filesystem;
namespace {

/// Lists within lists, beyond which a reader that calls itself runs out of stack.
constexpr int most_nested = 200;

[[noreturn]] void fail(const fs::path& file, std::string what) {
  std::ranges::replace_if(
      what, [](unsigned char c) { return c < 0x20; }, ' ');
  what.erase(what.find_last_not_of(' ') + 1);
  throw MeshFileError(file.filename().string() + ": " + what);
}

bool is_nested_too_deep(std::string_view json) {
  int depth = 0;
  bool quoted = false;
  for (std::size_t i = 0; i < json.size(); ++i) {
    if (quoted && json[i] == '\\')
      ++i;
    else if (json[i] == '"')
      quoted = !quoted;
    else if (!quoted && (json[i] == '[' || json[i] == '{') && ++depth > most_nested)
      return true;
    else if (!quoted && (json[i] == ']' || json[i] == '}'))
      --depth;
  }
  return false;
}

bool read_beside(std::vector<unsigned char>* bytes, std::string* error, const std::string& path, void*) {
  try {
    const std::string text = read_mesh_bytes(path);
    bytes->assign(text.begin(), text.end());
    return true;
  } catch (const MeshFileError& failure) {
    *error += failure.what();
    return false;
  }
}

glm::dmat4 transform_of(const tinygltf::Node& node) {
  glm::dmat4 result{1};
  if (node.matrix.size() == 16) {
    for (int i = 0; i < 16; ++i) result[i / 4][i % 4] = node.matrix[static_cast<std::size_t>(i)];
    return result;
  }
  const auto vector = [](const std::vector<double>& v) { return glm::dvec3{v[0], v[1], v[2]}; };
  if (node.translation.size() == 3) result = translate(result, vector(node.translation));
  if (node.rotation.size() == 4)
    result *= mat4_cast(glm::dquat(node.rotation[3], node.rotation[0], node.rotation[1], node.rotation[2]));
  if (node.scale.size() == 3) result = scale(result, vector(node.scale));
  return result;
}

}  // namespace

tinygltf::Model parse_gltf(std::string_view bytes, const fs::path& file) {
  tinygltf::TinyGLTF reader;
  reader.SetFsCallbacks(
      {[](const std::string& path, void*) { return fs::exists(path); },
       [](const std::string& path, void*) { return path; }, read_beside,
       [](std::string*, const std::string&, const std::vector<unsigned char>&, void*) { return false; }, nullptr});
  reader.SetImageLoader([](tinygltf::Image*, const int, std::string*, std::string*, int, int, const unsigned char*, int,
                           void*) { return true; },
                        nullptr);
  const bool binary = bytes.starts_with("glTF");
  if (is_nested_too_deep(bytes)) fail(file, "its JSON is nested too deep");
  if (bytes.size() > std::numeric_limits<unsigned>::max()) fail(file, "it is too large");
  const auto size = static_cast<unsigned>(bytes.size());
  const std::string folder = file.has_parent_path() ? file.parent_path().string() : ".";
  tinygltf::Model model;
  std::string error, warning;
  bool read = false;
  try {
    read = binary ? reader.LoadBinaryFromMemory(&model, &error, &warning,
                                                reinterpret_cast<const unsigned char*>(bytes.data()), size, folder)
                  : reader.LoadASCIIFromString(&model, &error, &warning, bytes.data(), size, folder);
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception& failure) {
    error = failure.what();
  }
  if (!read) fail(file, "is no sound glTF: " + (error.empty() ? "it cannot be read" : error));
  for (const std::string& extension : model.extensionsRequired)
    if (extension == "KHR_draco_mesh_compression" || extension == "EXT_meshopt_compression")
      fail(file, "is compressed by " + extension + ", which is not read; allowed are files without");
  return model;
}

void walk_nodes(const tinygltf::Model& model, const fs::path& file,
                const std::function<void(const tinygltf::Node&, const glm::dmat4&)>& visit) {
  struct Visit {
    int node;
    glm::dmat4 parent;
  };
  std::vector<Visit> stack;
  const auto push = [&](const std::vector<int>& nodes, const glm::dmat4& parent) {
    for (const int node : std::views::reverse(nodes)) stack.push_back({node, parent});
  };
  if (!model.scenes.empty()) {
    const std::size_t scene = model.defaultScene < 0 ? 0 : static_cast<std::size_t>(model.defaultScene);
    if (scene >= model.scenes.size()) fail(file, "names scene " + std::to_string(scene) + ", which is not there");
    push(model.scenes[scene].nodes, glm::dmat4{1});
  } else {
    std::vector<bool> is_child(model.nodes.size(), false);
    for (const tinygltf::Node& node : model.nodes)
      for (const int child : node.children)
        if (child >= 0 && static_cast<std::size_t>(child) < is_child.size())
          is_child[static_cast<std::size_t>(child)] = true;
    for (std::size_t i = is_child.size(); i-- > 0;)
      if (!is_child[i]) stack.push_back({static_cast<int>(i), glm::dmat4{1}});
  }
  std::vector<bool> seen(model.nodes.size(), false);
  while (!stack.empty()) {
    const Visit next = stack.back();
    stack.pop_back();
    if (next.node < 0 || static_cast<std::size_t>(next.node) >= seen.size())
      fail(file, "names node " + std::to_string(next.node) + ", which is not there");
    const auto index = static_cast<std::size_t>(next.node);
    if (seen[index]) fail(file, "has node " + std::to_string(next.node) + " at two places of its tree");
    seen[index] = true;
    const tinygltf::Node& node = model.nodes[index];
    const glm::dmat4 transform = next.parent * transform_of(node);
    visit(node, transform);
    push(node.children, transform);
  }
}

std::string gltf_material_name(const tinygltf::Model& model, int material) {
  if (material < 0 || static_cast<std::size_t>(material) >= model.materials.size()) return {};
  const auto index = static_cast<std::size_t>(material);
  const std::string& name = model.materials[index].name;
  const auto same = [&](const tinygltf::Material& other) { return other.name == name; };
  const auto here = model.materials.begin() + static_cast<std::ptrdiff_t>(index);
  if (name.empty() || std::any_of(model.materials.begin(), here, same)) return "material " + std::to_string(material);
  return name;
}

}  // namespace glimt
