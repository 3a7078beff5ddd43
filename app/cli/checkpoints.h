#pragma once

#include <chrono>

#include "cli/render_loop.h"
#include "cli/render_options.h"
#include "film/checkpoint.h"

/// What `glimt render` does with checkpoints.
namespace glimt {

/// What rendering begins with: the film of --resume, or an empty one. Throws BadInput where the samples of --resume are
/// not of this scene or not among the goal's, and where --checkpoint would replace a file that is not resumed.
Checkpoint first_film(const RenderOptions& options, const Scene& scene, const CompiledScene& compiled,
                      const Goal& goal);

/// Writes --checkpoint where it is given.
class CheckpointWriter {
 public:
  explicit CheckpointWriter(const RenderOptions& options);

  /// Writes where the last time was --every seconds ago. Says what failed and goes on.
  void write_when_due(Checkpoint& checkpoint, const Rendering& rendering);
  /// Returns false, and says why, where it cannot be written.
  bool write(Checkpoint& checkpoint, const Rendering& rendering);

 private:
  std::filesystem::path file_;
  double every_;  ///< seconds
  std::chrono::steady_clock::time_point last_ = std::chrono::steady_clock::now();
};

}  // namespace glimt
