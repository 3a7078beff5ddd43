#pragma once

#include <CLI/CLI.hpp>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "render/render.h"

namespace glimt {

/// What is rendered, and on which threads.
struct SceneOptions {
  std::filesystem::path scene;
  std::vector<std::string> overrides;  ///< for read_scene; later ones win
  Execution execution;
};

struct RenderOptions : SceneOptions {
  std::filesystem::path out, stats;
  std::optional<double> seconds;
  std::optional<SampleRange> part;  ///< the only samples to take
  std::filesystem::path checkpoint, resume;
  double every = 60;  ///< seconds between checkpoints
  bool quiet = false;
  bool no_dither = false;  ///< of PNG files
};

/// Declares SCENE, --set, --size and --threads.
void add_scene_options(CLI::App& command, SceneOptions& options);

/// Declares an option that names a file to write. A file that cannot be written is refused at once.
CLI::Option* add_file_option(CLI::App& command, const std::string& name, std::filesystem::path& file,
                             const std::string& doc);

/// A check for CLI11: returns a message where the text is not a finite number above 0.
std::string check_positive(const std::string& text);

/// Declares the options of `glimt render`, among them one for every setting of a scene (fields.h).
void add_render_options(CLI::App& command, RenderOptions& options);

}  // namespace glimt
