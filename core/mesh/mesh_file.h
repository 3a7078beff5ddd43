#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <string_view>

#include "mesh/mesh_builder.h"
#include "mesh/mesh_data.h"

/// Reads OBJ, PLY and glTF 2.0 files. What is read takes memory in proportion to the file's size, whatever the file
/// claims. All throw MeshFileError.
namespace glimt {

/// By its ending: .obj, .ply, .gltf or .glb.
bool is_mesh_file(const std::filesystem::path& file);

/// A file that is in use already, and has not changed since, is not read again.
std::shared_ptr<const MeshData> load_mesh(const std::filesystem::path& file);

/// The files beside it that a .gltf needs.
std::vector<std::filesystem::path> files_beside(const std::filesystem::path& file);

/// The whole file; refused where it is a folder or larger than 4 GiB.
std::string read_mesh_bytes(const std::filesystem::path& file);

// From what the file holds. `file` is for messages, and for the files beside it that a .gltf names.
MeshData read_obj(std::string bytes, const std::filesystem::path& file);
MeshData read_ply(std::string_view bytes, const std::filesystem::path& file);
MeshData read_gltf(std::string_view bytes, const std::filesystem::path& file);

}  // namespace glimt
