#pragma once

#include <atomic>
#include <cstdint>
#include <vector>

#include "compile/compiled_scene.h"
#include "film/film.h"
#include "kernel/entry/kernels.h"

namespace glimt {

/// How the work is divided. This does not change one bit of the image.
struct Execution {
  int threads = 0;              ///< 0: as many as the machine has
  Lanes lanes = Lanes::native;  ///< paths side by side in one thread
};

/// An empty film with the scene's size and fixed-point scale.
Film make_film(const CompiledScene& scene);

/// How far a cancelled pass has come: for each tile of the film and each block of light paths, how many of the pass's
/// samples are done. Empty between passes.
using PassProgress = std::vector<int>;

/// Adds the first `count` of the film's missing() samples to every pixel, on all threads. Returns false if `cancel`
/// (may be null) became true on the way. The film then holds part of the pass; the only use for it is to go on with the
/// same scene, count and `progress`. Rethrows what a thread throws.
bool render_pass(const CompiledScene& scene, Film& film, int count, const Execution& execution,
                 const std::atomic<bool>* cancel = nullptr, PassProgress* progress = nullptr);

/// Number of threads that Execution::threads = 0 stands for.
int hardware_threads();

}  // namespace glimt
