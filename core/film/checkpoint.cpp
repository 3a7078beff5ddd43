#include "film/checkpoint.h"

#include <zlib.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cerrno>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <cstring>
#include <memory>
#include <system_error>
#include <vector>

#include "film/file_bytes.h"
#include "scene/fields.h"
#include "scene/file/scene_file.h"

namespace glimt {
namespace fs = std::filesystem;
namespace {

static_assert(std::endian::native == std::endian::little, "sums are written as they are in memory");

constexpr std::string_view checkpoint_signature = "\x89GLIMT\r\n";
constexpr std::uint32_t checkpoint_format = 1;

/// The file's beginning, after its signature. It is written as it is in memory, so it has no padding.
struct CheckpointStart {
  std::uint32_t format = checkpoint_format;
  std::uint32_t checksum = 0;  ///< CRC-32 of all that follows
  std::uint32_t version_length = 0, scene_length = 0, range_count = 0;
  std::int32_t width = 0, height = 0, next_check = 0;
  double scale = 0;
  std::uint64_t invalid = 0, saturated = 0;
  std::int64_t nanoseconds = 0;
  std::uint32_t emitters = 0, unused = 0;
};
static_assert(sizeof(CheckpointStart) == 72);
constexpr std::size_t checked_from = offsetof(CheckpointStart, version_length);

template <class T>
std::string_view bytes_of(std::span<T> values) {
  return {reinterpret_cast<const char*>(values.data()), values.size_bytes()};
}

std::string_view checked_bytes(const CheckpointStart& start) {
  return bytes_of(std::span(&start, 1)).substr(checked_from);
}

std::uint32_t add_to_checksum(std::uint32_t sum, std::string_view bytes) {
  return static_cast<std::uint32_t>(crc32_z(sum, reinterpret_cast<const Bytef*>(bytes.data()), bytes.size()));
}

/// The size of a file with this beginning, whose image is within the limits.
std::uint64_t size_of_file(const CheckpointStart& start) {
  const std::uint64_t pixels = static_cast<std::uint64_t>(start.width) * static_cast<std::uint64_t>(start.height);
  return checkpoint_signature.size() + sizeof start + start.version_length + start.scene_length +
         sizeof(SampleRange) * std::uint64_t{start.range_count} + sizeof(Emitter) * std::uint64_t{start.emitters} +
         sizeof(std::uint64_t) * chance_counters(start.emitters) + Film::pixel_bytes * pixels;
}

bool in_image_limits(int width, int height) {
  const auto fields = image_fields();
  return width >= fields[0].min && width <= fields[0].max && height >= fields[1].min && height <= fields[1].max;
}

bool in_order(const SampleRanges& ranges) {
  int end = -1;
  for (const SampleRange& range : ranges) {
    if (range.first <= end || range.first > max_spp || range.count < 1 || range.count > max_spp - range.first)
      return false;
    end = range.end();
  }
  return true;
}

/// Reads a checkpoint piece by piece and keeps the checksum of what it has read.
class CheckpointReader {
 public:
  explicit CheckpointReader(const fs::path& file) : file_(file) {
    std::error_code error;
    if (fs::is_directory(file, error)) fail("is a folder; the name of a file is needed");
    if (fs::exists(file, error) && !fs::is_regular_file(file, error)) fail("is not a regular file");
    stream_.reset(std::fopen(file.c_str(), "rb"));
    if (!stream_) fail("cannot be read: " + std::generic_category().message(errno));
    size_ = fs::file_size(file);
  }

  Checkpoint read() {
    CheckpointStart start = read_start();
    checksum_ = add_to_checksum(0, checked_bytes(start));
    std::string version(start.version_length, '\0'), scene(start.scene_length, '\0');
    SampleRanges ranges(start.range_count);
    take(std::span(version));
    take(std::span(scene));
    take(std::span(ranges));
    std::vector<Emitter> emitters(start.emitters);
    std::vector<std::uint64_t> by_chance(chance_counters(start.emitters));
    take(std::span(emitters));
    take(std::span(by_chance));
    Checkpoint result;
    result.film = Film(start.width, start.height, 0x1p38 / start.scale, std::move(emitters));
    result.film.add_by_chance(by_chance);
    for (const int h : {0, 1}) take(result.film.sums(h));
    if (checksum_ != start.checksum) fail(damaged);
    if (version != GLIMT_VERSION)
      fail("was written by glimt " + version + ", and samples of glimt " GLIMT_VERSION " may differ");
    check_film(result.film, start, ranges);
    result.film.set_contents(ranges, start.invalid, start.saturated);
    result.seconds = static_cast<double>(start.nanoseconds) / 1e9;
    result.next_check = start.next_check;
    result.scene = parse(scene);
    if (result.scene.image != ImageSize{start.width, start.height}) fail(damaged);
    return result;
  }

 private:
  static constexpr const char* damaged = "is damaged: its checksum or its numbers are wrong";

  [[noreturn]] void fail(const std::string& what) const { throw CheckpointError(file_.string() + ": " + what); }

  template <class T>
  void take(std::span<T> values) {
    const auto bytes = values.size_bytes();
    if (std::fread(values.data(), 1, bytes, stream_.get()) != bytes)
      fail(std::ferror(stream_.get()) ? "cannot be read: " + std::generic_category().message(errno) : "is cut short");
    checksum_ = add_to_checksum(checksum_, bytes_of(values));
  }

  CheckpointStart read_start() {
    std::array<char, checkpoint_signature.size()> signature{};
    if (size_ < signature.size() + sizeof(CheckpointStart)) fail("is no checkpoint: it is too short");
    take(std::span<char>(signature));
    if (std::string_view(signature.data(), signature.size()) != checkpoint_signature) fail("is no checkpoint of glimt");
    CheckpointStart start;
    take(std::span<CheckpointStart>(&start, 1));
    if (start.format != checkpoint_format)
      fail("is a checkpoint of format " + std::to_string(start.format) + "; this glimt reads format " +
           std::to_string(checkpoint_format));
    if (!in_image_limits(start.width, start.height)) fail(damaged);
    const std::uint64_t wanted = size_of_file(start);
    if (size_ != wanted)
      fail("is cut short or damaged: it has " + std::to_string(size_) + " bytes, and by its beginning " +
           std::to_string(wanted));
    return start;
  }

  void check_film(const Film& film, const CheckpointStart& start, const SampleRanges& ranges) const {
    std::uint64_t all_sums = 0;
    for (const int h : {0, 1})
      for (const std::uint64_t sum : film.sums(h)) all_sums |= sum;
    if (film.scale() != start.scale || all_sums >> 63 != 0 || !in_order(ranges) || start.nanoseconds < 0) fail(damaged);
  }

  Scene parse(const std::string& text) const {
    try {
      return parse_scene(text, "its scene");
    } catch (const SceneError& error) {
      fail(error.what());
    }
  }

  fs::path file_;
  std::unique_ptr<std::FILE, int (*)(std::FILE*)> stream_{nullptr, &std::fclose};
  std::uint64_t size_ = 0;
  std::uint32_t checksum_ = 0;
};

}  // namespace

void write_checkpoint(const fs::path& file, const Checkpoint& checkpoint) {
  const std::string scene = write_scene(checkpoint.scene), version = GLIMT_VERSION;
  const Film& film = checkpoint.film;
  CheckpointStart start;
  start.version_length = static_cast<std::uint32_t>(version.size());
  start.scene_length = static_cast<std::uint32_t>(scene.size());
  start.range_count = static_cast<std::uint32_t>(film.ranges().size());
  start.width = film.width();
  start.height = film.height();
  start.next_check = checkpoint.next_check;
  start.scale = film.scale();
  start.invalid = film.invalid();
  start.saturated = film.saturated();
  start.nanoseconds = std::llround(checkpoint.seconds * 1e9);
  start.emitters = static_cast<std::uint32_t>(film.emitters().size());

  std::array<std::string_view, 9> pieces{checkpoint_signature,
                                         bytes_of(std::span(&start, 1)),
                                         version,
                                         scene,
                                         bytes_of(std::span(film.ranges())),
                                         bytes_of(std::span(film.emitters())),
                                         bytes_of(film.by_chance()),
                                         bytes_of(film.sums(0)),
                                         bytes_of(film.sums(1))};
  start.checksum = add_to_checksum(0, checked_bytes(start));
  for (const std::string_view piece : std::span(pieces).subspan(2))
    start.checksum = add_to_checksum(start.checksum, piece);
  replace_file(file, pieces);
}

Checkpoint read_checkpoint(const fs::path& file) { return CheckpointReader(file).read(); }

}  // namespace glimt
