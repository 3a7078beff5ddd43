#include "cli/checkpoints.h"

#include <cstdio>

#include "cli/commands.h"
#include "film/file_bytes.h"
#include "film/image_file.h"
#include "scene/file/scene_change.h"

namespace glimt {
namespace fs = std::filesystem;
namespace {

bool same_file(const fs::path& a, const fs::path& b) {
  return fs::weakly_canonical(fs::absolute(a)) == fs::weakly_canonical(fs::absolute(b));
}

/// The checkpoint of --resume.
Checkpoint resumed(const fs::path& file, const Scene& scene, const CompiledScene& compiled, const Goal& goal) {
  Checkpoint checkpoint;
  try {
    checkpoint = read_checkpoint(file);
  } catch (const CheckpointError& error) {
    throw BadInput(error.what());
  }
  const std::string change = first_change(checkpoint.scene, scene);
  if (!change.empty()) throw BadInput(file.string() + " cannot be resumed, it is of another scene: " + change);
  if (checkpoint.film.scale() != make_film(compiled).scale())
    throw BadInput(file.string() + " cannot be resumed: it counts light in other units");
  const SampleRange wanted = goal.samples;
  for (const SampleRange& range : checkpoint.film.ranges())
    if (range.first < wanted.first || range.end() > wanted.end())
      throw BadInput(file.string() + " cannot be resumed: it holds " + in_words(range) + " of each pixel, and " +
                     in_words(wanted) + " are asked for");
  if (checkpoint.scene.render.target_error != scene.render.target_error) checkpoint.next_check = 0;
  checkpoint.scene = scene;
  return checkpoint;
}

}  // namespace

Checkpoint first_film(const RenderOptions& options, const Scene& scene, const CompiledScene& compiled,
                      const Goal& goal) {
  const bool own =
      !options.checkpoint.empty() && !options.resume.empty() && same_file(options.checkpoint, options.resume);
  if (!options.checkpoint.empty() && !own && fs::exists(options.checkpoint))
    throw BadInput(options.checkpoint.string() + " is there already: go on from it with --resume " +
                   options.checkpoint.string() + ", or remove it");
  if (options.resume.empty() || (own && !fs::exists(options.resume))) return {scene, make_film(compiled)};
  return resumed(options.resume, scene, compiled, goal);
}

CheckpointWriter::CheckpointWriter(const RenderOptions& options) : file_(options.checkpoint), every_(options.every) {
  if (!file_.empty()) remove_unfinished(file_);
}

void CheckpointWriter::write_when_due(Checkpoint& checkpoint, const Rendering& rendering) {
  const std::chrono::duration<double> passed = std::chrono::steady_clock::now() - last_;
  if (passed.count() >= every_) write(checkpoint, rendering);
}

bool CheckpointWriter::write(Checkpoint& checkpoint, const Rendering& rendering) {
  if (file_.empty()) return true;
  checkpoint.seconds = rendering.seconds;
  checkpoint.next_check = rendering.next_check;
  bool written = true;
  try {
    write_checkpoint(file_, checkpoint);
  } catch (const ImageFileError& error) {
    std::fprintf(stderr, "%s\n", error.what());
    written = false;
  }
  last_ = std::chrono::steady_clock::now();
  return written;
}

}  // namespace glimt
