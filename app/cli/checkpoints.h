#pragma once

#include <chrono>

#include "cli/render_loop.h"
#include "cli/render_options.h"
#include "film/checkpoint.h"

/// How `glimt render` uses checkpoints.
namespace glimt {

/// The film that rendering begins with: that of --resume, or an empty one. Throws BadInput where the samples of
/// --resume belong to another scene or are not among the goal's, and where --checkpoint would replace a file that is
/// not resumed.
Checkpoint first_film(const RenderOptions& options, const Scene& scene, const CompiledScene& compiled,
                      const Goal& goal);

/// Writes the file of --checkpoint, if that is given.
class CheckpointWriter {
 public:
  explicit CheckpointWriter(const RenderOptions& options);

  /// Writes if the last time was --every seconds ago. Where that fails, prints why and goes on.
  void write_when_due(Checkpoint& checkpoint, const Rendering& rendering);
  /// Where the file cannot be written, prints why and returns false.
  bool write(Checkpoint& checkpoint, const Rendering& rendering);

 private:
  std::filesystem::path file_;
  double every_;  ///< seconds
  std::chrono::steady_clock::time_point last_ = std::chrono::steady_clock::now();
};

}  // namespace glimt
