#pragma once

#include <CLI/CLI.hpp>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "render/render.h"

namespace glimt {

struct RenderOptions {
  std::filesystem::path scene, out, stats;
  std::vector<std::string> overrides;  ///< for read_scene; those of later options win
  std::optional<double> seconds;
  Execution execution;
  bool quiet = false;
};

/// Declares the options of `glimt render`; one for every setting of a scene (fields.h).
void add_render_options(CLI::App& command, RenderOptions& options);

}  // namespace glimt
