#pragma once

#include <filesystem>
#include <stdexcept>
#include <string>

#include "film/film.h"
#include "scene/scene.h"

namespace glimt {

/// A checkpoint cannot be used. what() is one line that names the file and the reason.
struct CheckpointError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// A film and all that rendering needs to go on with it.
struct Checkpoint {
  Scene scene;
  Film film;
  double seconds = 0;  ///< rendering time; whole nanoseconds in files
  int next_check = 0;  ///< samples at which to check next whether the scene's target error is reached
};

/// Replaces the file in one step, as replace_file does. Throws ImageFileError where it cannot be written.
///
/// The file, little-endian: an 8-byte signature; uint32 format; uint32 CRC-32 of all that follows; uint32 lengths of
/// version and scene text and number of ranges; int32 width, height and next_check; double scale of the sums; uint64
/// invalid and saturated; int64 nanoseconds; uint32 number of emitters and 0; version; scene text; int32 first and
/// count of each range of samples; double radiance and uint64 ways of each emitter; the emitters' uint64 counters
/// (chance_counters()); uint64 sums of half 0, then of half 1, three per pixel. The sums are not compressed: zlib would
/// save half the space and take ten times as long as the disk.
void write_checkpoint(const std::filesystem::path& file, const Checkpoint& checkpoint);

/// Reads a file that this version of glimt wrote. Throws CheckpointError for other files and for damaged or incomplete
/// ones. It never takes more memory than the file's length justifies.
Checkpoint read_checkpoint(const std::filesystem::path& file);

}  // namespace glimt
