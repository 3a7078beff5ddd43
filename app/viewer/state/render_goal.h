#pragma once

#include <array>
#include <optional>
#include <string_view>

#include "scene/scene.h"

namespace glimt {

/// Where the window's rendering ends.
enum class StopAt { never, samples, error };
inline constexpr std::array<std::string_view, 3> stop_at_names{"never", "samples", "error"};

/// Errors that can be asked for.
inline constexpr double least_error = 1e-7, most_error = 1;

/// How far the window renders. It is the window's own: the target in the scene's settings is for the command line, and
/// stays as it is in the file.
struct RenderGoal {
  StopAt stop_at = StopAt::never;
  int samples = 64;      ///< per pixel
  double error = 0.001;  ///< relmse_scaled

  bool operator==(const RenderGoal&) const = default;
};

/// The goal for a scene that has just been opened: numbers to stop at are those of its file, until a person asks for
/// them.
RenderGoal goal_for(const Scene& scene, RenderGoal goal);

/// The scene of a file as the window renders it; `size` is the picture's where the window gives it one.
Scene as_shown(Scene scene, const RenderGoal& goal, const std::optional<ImageSize>& size);
/// What a file is to hold of a scene that was edited as shown; `before` is what it held before. The picture's size is
/// the file's where the window has not given it.
Scene as_filed(Scene shown, const Scene& before, bool window_gave_size);

/// The rendering ends by itself.
bool has_target(const Settings& settings);

}  // namespace glimt
