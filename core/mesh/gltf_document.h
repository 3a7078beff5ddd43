#pragma once

#define TINYGLTF_NO_STB_IMAGE
#define TINYGLTF_NO_STB_IMAGE_WRITE
#define TINYGLTF_NO_EXTERNAL_IMAGE
#include <tiny_gltf.h>

#include <filesystem>
#include <functional>
#include <glm/mat4x4.hpp>
#include <string>
#include <string_view>

namespace glimt {

/// A glTF 2.0 file, text or binary, with its buffers and without its pictures. Throws MeshFileError.
tinygltf::Model parse_gltf(std::string_view bytes, const std::filesystem::path& file);

/// Calls with each node of the file's scene, its parent first, and the transform from its space to the file's.
/// Throws MeshFileError where the nodes are no tree.
void walk_nodes(const tinygltf::Model& model, const std::filesystem::path& file,
                const std::function<void(const tinygltf::Node&, const glm::dmat4&)>& visit);

/// Unique: "steel", or "material 2" for one without a name. Empty for -1.
std::string gltf_material_name(const tinygltf::Model& model, int material);

}  // namespace glimt
