#pragma once

#include <atomic>
#include <functional>
#include <limits>

#include "render/render.h"

namespace glimt {

/// Rendering stops at whichever comes first.
struct Goal {
  SampleRange samples;                                       ///< of each pixel
  double seconds = std::numeric_limits<double>::infinity();  ///< of rendering
  double relmse_scaled = 0;  ///< at most this, with what unseen light may add; looked at from 8 samples on
};

struct Progress {
  double fraction = 0;  ///< of the way to the goal, as far as known
  int samples = 0;      ///< per pixel
  double seconds = 0;   ///< of rendering so far
  double seconds_left = 0;
  double paths_per_second = 0;
  double relmse_scaled = 0;  ///< when last looked at; infinite before
  bool at_least = false;     ///< the error may be larger: light may be missing
};

/// How far a film has come; what it takes to go on as if there had been no break.
struct Rendering {
  double seconds = 0;    ///< wall-clock, in render_pass alone; whole nanoseconds, as checkpoints hold them
  int next_check = 0;    ///< samples at which to look next whether the error is reached
  bool reached = false;  ///< the goal; false where it was stopped
};

/// Calls of render_to after each pass; each may be empty.
struct AfterPass {
  std::function<void(const Progress&)> report;
  std::function<void(const Rendering&)> save;  ///< not after the last
};

/// Adds to the film what it lacks of the goal's samples, in passes of about 0.1 s, until the goal is reached, or after
/// the pass in which `stop` became true. With an error as goal the number of samples does not depend on time, nor on
/// breaks after which it goes on from `begun`.
Rendering render_to(const Goal& goal, const CompiledScene& scene, Film& film, const Execution& execution,
                    const std::atomic<bool>& stop, const AfterPass& after, const Rendering& begun = {});

}  // namespace glimt
