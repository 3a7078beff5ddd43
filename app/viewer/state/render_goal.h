#pragma once

#include <array>
#include <string_view>

#include "scene/scene.h"

namespace glimt {

/// Where the window's rendering ends.
enum class StopAt { never, samples, error };
inline constexpr std::array<std::string_view, 3> stop_at_names{"never", "samples", "error"};

/// How far the window renders. It is the window's own: the target in the scene's settings is for the command line, and
/// stays as it is in the file.
struct RenderGoal {
  StopAt stop_at = StopAt::never;
  int samples = 64;      ///< per pixel
  double error = 0.001;  ///< relmse_estimate

  bool operator==(const RenderGoal&) const = default;
};

/// The goal for a scene that has just been opened: numbers to stop at are those of its file, until a person asks for
/// them.
RenderGoal goal_for(const Scene& scene, RenderGoal goal);

/// The scene of a file as the window renders it.
Scene as_shown(Scene scene, const RenderGoal& goal);
/// What a file is to hold of a scene that was edited as shown; `before` is what it held before.
Scene as_filed(Scene shown, const Scene& before);

/// The rendering ends by itself.
bool has_target(const Settings& settings);

}  // namespace glimt
