#include <cmath>
#include <cstdint>
#include <cstdio>
#include <memory>
#include <utility>

#include "cli/commands.h"
#include "cli/render_options.h"
#include "film/checkpoint.h"
#include "film/file_bytes.h"
#include "film/image_file.h"
#include "film/metadata.h"
#include "film/statistics.h"
#include "scene/file/scene_change.h"

namespace glimt {
namespace fs = std::filesystem;
namespace {

struct MergeOptions {
  std::vector<fs::path> parts;
  fs::path out;
};

bool is_checkpoint_name(const fs::path& file) { return file.extension() == ".ckpt"; }

Checkpoint read_part(const fs::path& file) {
  try {
    return read_checkpoint(file);
  } catch (const CheckpointError& error) {
    throw BadInput(error.what());
  }
}

/// Merges all parts. At most two films are in memory at a time.
Checkpoint merged(const std::vector<fs::path>& parts) {
  std::vector<std::pair<fs::path, SampleRanges>> known;
  Checkpoint whole;
  std::int64_t nanoseconds = 0;  // integers, so that the sum does not depend on order
  for (const fs::path& file : parts) {
    Checkpoint part = read_part(file);
    const SampleRanges ranges = part.film.ranges();
    nanoseconds += std::llround(part.seconds * 1e9);
    if (known.empty()) {
      whole = std::move(part);
    } else {
      const fs::path& first = known.front().first;
      const std::string change = first_change(part.scene, whole.scene);
      if (!change.empty()) throw BadInput(file.string() + " is not of the scene of " + first.string() + ": " + change);
      for (const auto& [other, its_ranges] : known)
        if (const auto both = overlap_of(ranges, its_ranges))
          throw BadInput(file.string() + " and " + other.string() + " both hold " + in_words(*both) + " of each pixel");
      if (part.film.scale() != whole.film.scale())
        throw BadInput(file.string() + " counts light in other units than " + first.string());
      whole.film.add(part.film);
    }
    known.emplace_back(file, ranges);
  }
  whole.scene.render = without_target(whole.scene.render);
  whole.seconds = static_cast<double>(nanoseconds) / 1e9;
  whole.next_check = 0;
  return whole;
}

void print_merged(const MergeOptions& options, const Film& film) {
  std::FILE* const stream = options.out == "-" ? stderr : stdout;
  const std::string name = options.out == "-" ? "standard output" : options.out.string();
  std::fprintf(stream, "%s: %d spp of %zu checkpoint%s, %s\n", name.c_str(), film.samples(), options.parts.size(),
               options.parts.size() == 1 ? "" : "s", trust_text(estimate_error(film)).c_str());
  const int end = film.ranges().back().end();
  for (SampleRange gap = first_gap(film.ranges(), 0); gap.first < end; gap = first_gap(film.ranges(), gap.end()))
    std::fprintf(stream, "missing: %s\n", in_words(gap).c_str());
}

/// Throws BadInput where no file with this ending can be written. Called before the parts are read.
void check_ending(const fs::path& out) {
  try {
    if (!is_checkpoint_name(out)) check_writable(out);
  } catch (const ImageFileError& error) {
    throw BadInput(std::string(error.what()) + "; a checkpoint ends in .ckpt");
  }
}

int run_merge(const MergeOptions& options) {
  check_ending(options.out);
  const Checkpoint whole = merged(options.parts);
  if (whole.film.samples() == 0) throw BadInput("no sample is in any of them");
  if (is_checkpoint_name(options.out))
    write_checkpoint(options.out, whole);
  else
    write_image(options.out, whole.film, {}, render_metadata(whole.scene, whole.film, whole.seconds));
  print_merged(options, whole.film);
  return 0;
}

}  // namespace

void add_merge_command(CLI::App& app, Run& run) {
  CLI::App* command = app.add_subcommand("merge", "Make one of checkpoints with different samples of one picture");
  const auto options = std::make_shared<MergeOptions>();
  command->add_option("PART", options->parts, "Checkpoints that glimt render --checkpoint wrote")
      ->required()
      ->type_name("FILE");
  add_file_option(*command, "-o,--output", options->out,
                  "Picture (.png, .exr, .pfm) or checkpoint (.ckpt) to write; -: a PNG on standard output")
      ->required();
  command->callback([&run, options] { run = [options] { return run_merge(*options); }; });
}

}  // namespace glimt
