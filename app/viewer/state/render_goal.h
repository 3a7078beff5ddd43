#pragma once

#include <array>
#include <optional>
#include <string_view>

#include "scene/scene.h"

namespace glimt {

/// What ends the window's rendering.
enum class StopAt { never, samples, error };
inline constexpr std::array<std::string_view, 3> stop_at_names{"never", "samples", "error"};

/// Range of errors that can be asked for.
inline constexpr double least_error = 1e-7, most_error = 1;

/// How far the window renders. The target in the scene's settings is for the command line; it stays as the file has it.
struct RenderGoal {
  StopAt stop_at = StopAt::never;
  int samples = 64;      ///< per pixel
  double error = 0.001;  ///< relmse_scaled

  bool operator==(const RenderGoal&) const = default;
};

/// The goal for a scene that has just been opened. Numbers that are not in use become those of its file, ready for when
/// a person asks to stop at them.
RenderGoal goal_for(const Scene& scene, RenderGoal goal);

/// The scene of a file as the window renders it. `size` is the picture's size where the window decides it.
Scene as_shown(Scene scene, const RenderGoal& goal, const std::optional<ImageSize>& size);
/// The scene as a file holds it, from the scene as shown and edited. `before` is what the file held. Where the window
/// gave the picture its size, the size of `before` stays.
Scene as_filed(Scene shown, const Scene& before, bool window_gave_size);

/// Whether rendering ends by itself.
bool has_target(const Settings& settings);

}  // namespace glimt
