#pragma once

#include <CLI/CLI.hpp>
#include <filesystem>
#include <functional>
#include <span>
#include <stdexcept>
#include <string>

#include "scene/scene.h"

namespace glimt {

/// Runs the given command once all options are parsed; returns the exit status.
using Run = std::function<int()>;

/// Input that cannot be used: exit status 2.
struct BadInput : std::runtime_error {
  using std::runtime_error::runtime_error;
};

// Each function declares its command, and sets `run` if that command is given.
void add_window_command(CLI::App& app, Run& run);
void add_render_command(CLI::App& app, Run& run);
void add_merge_command(CLI::App& app, Run& run);
void add_compare_command(CLI::App& app, Run& run);
void add_chart_command(CLI::App& app, Run& run);
void add_report_command(CLI::App& app, Run& run);
void add_check_command(CLI::App& app, Run& run);
void add_info_command(CLI::App& app, Run& run);

/// Reads a scene file, or imports what is none and tells what has no counterpart.
Scene read_input(const std::filesystem::path& file, std::span<const std::string> overrides = {});

/// Renders as `glimt render SCENE -o OUT` does.
int render_scene(const std::filesystem::path& scene, const std::filesystem::path& out);

}  // namespace glimt
