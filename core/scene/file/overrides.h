#pragma once

#include <toml++/toml.h>
#include <string>
#include <string_view>

namespace glimt {

/// Puts "PATH=VALUE" (see read_scene) into the tree, whose new nodes say by their source's path that they come from it.
/// Tables that are missing on the way are made. Throws SceneError.
void apply_override(toml::table& root, const std::string& text);

/// The place of what a path of validate.h names, or of its nearest parent that is there.
toml::source_region locate(const toml::table& root, const std::string& path);

}  // namespace glimt
