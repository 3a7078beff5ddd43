#pragma once

#include <atomic>
#include <cstdint>
#include <vector>

#include "compile/compiled_scene.h"
#include "film/film.h"
#include "kernel/entry/kernels.h"

namespace glimt {

/// How the work is spread; none of it changes a bit of the image.
struct Execution {
  int threads = 0;              ///< 0: all the machine has
  Lanes lanes = Lanes::native;  ///< paths side by side in one thread
};

/// An empty film of the size and with the fixed-point scale that the scene asks for.
Film make_film(const CompiledScene& scene);

/// How far a cancelled pass has come: samples of it that each tile of the film has. Empty between passes.
using PassProgress = std::vector<int>;

/// Adds the first `count` of the film's missing() samples to every pixel, on all threads. Returns false where `cancel`
/// (may be null) became true on the way; the film then holds a part of the pass, and is good for nothing but going on
/// with the same pass (the same scene, count and `progress`) or clearing. Rethrows what a thread throws.
bool render_pass(const CompiledScene& scene, Film& film, int count, const Execution& execution,
                 const std::atomic<bool>* cancel = nullptr, PassProgress* progress = nullptr);

/// Number of threads that Execution::threads = 0 stands for.
int hardware_threads();

}  // namespace glimt
