#pragma once

#include <atomic>
#include <functional>
#include <limits>

#include "render/render.h"

namespace glimt {

/// Rendering stops at whichever comes first.
struct Goal {
  SampleRange samples;                                       ///< that each pixel gets
  double seconds = std::numeric_limits<double>::infinity();  ///< rendering time
  double relmse_scaled = 0;  ///< error to reach, unseen light included; checked from 8 samples on; 0: none
};

struct Progress {
  double fraction = 0;  ///< share of the way to the goal, as far as known
  int samples = 0;      ///< per pixel
  double seconds = 0;   ///< rendering time so far
  double seconds_left = 0;
  double paths_per_second = 0;
  double relmse_scaled = 0;  ///< as last estimated; infinite before
  bool at_least = false;     ///< the error may be larger: light may be missing
};

/// How far rendering has come: all it takes to go on as if there had been no break.
struct Rendering {
  double seconds = 0;    ///< wall-clock time in render_pass, a whole number of nanoseconds as in checkpoints
  int next_check = 0;    ///< samples at which to check the error next
  bool reached = false;  ///< the goal is reached; false where rendering was stopped
};

/// What render_to calls after each pass; each may be empty.
struct AfterPass {
  std::function<void(const Progress&)> report;
  std::function<void(const Rendering&)> save;  ///< not called after the last pass
};

/// Adds the next `count` samples of every pixel to the film. Returns how many seconds of it any number of samples
/// takes.
using RenderSamples = std::function<double(Film& film, int count)>;

/// Adds to the film what it lacks of the goal's samples, in passes of about 0.1 s, or 20 times as long
/// as what any pass takes, until the goal is reached, or after
/// the pass in which `stop` became true. With an error as goal the number of samples does not depend on time, nor on
/// breaks after which it goes on from `begun`.
Rendering render_to(const Goal& goal, const CompiledScene& scene, Film& film, const RenderSamples& render,
                    const std::atomic<bool>& stop, const AfterPass& after, const Rendering& begun = {});

}  // namespace glimt
