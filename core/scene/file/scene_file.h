#pragma once

#include <filesystem>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>

#include "scene/scene.h"

namespace glimt {

/// A mistake in a scene file; what() is one line, "FILE:LINE:COLUMN: what, and what is allowed". Mistakes in an
/// override name it instead of a place: "--set PATH=VALUE: what, and what is allowed".
struct SceneError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// Reads a TOML scene; "-" is standard input. Each override is "PATH=VALUE", VALUE in TOML
/// ("material.clay.roughness=0.6", "camera.eye=[0,0,5]", "sphere.glass.radius=2" by name or "sphere.3.radius=2" by
/// place from 0); bare words count as strings. Throws SceneError.
Scene read_scene(const std::filesystem::path& file, std::span<const std::string> overrides = {});

/// The same from text; `file_name` is for messages, and its folder for mesh files.
Scene parse_scene(std::string_view text, std::string_view file_name, std::span<const std::string> overrides = {});

/// The scene as TOML that parse_scene reads back to an equal Scene, all numbers exact: so for every scene that was
/// read. Mesh files are named relative to `folder`. Without one the text is a record of what was rendered: it has their
/// whole paths, and reading it back refuses a file that holds another mesh by then. Parameters that a material's type
/// does not read are not written, and have their defaults when read back.
std::string write_scene(const Scene& scene, const std::filesystem::path& folder = {});

}  // namespace glimt
