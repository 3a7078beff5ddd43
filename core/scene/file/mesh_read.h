#pragma once

#include <filesystem>
#include <string>

#include "scene/file/toml_nodes.h"
#include "scene/scene.h"

namespace glimt {

/// Reads a [[mesh]] but for its name and material. Files are named relative to `folder`. The scene has its materials.
void read_mesh(const toml::table& table, const std::filesystem::path& folder, const Scene& scene, Mesh& mesh);

/// All keys that it reads.
std::span<const std::string_view> mesh_keys();

}  // namespace glimt
