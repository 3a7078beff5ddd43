#include "film/checkpoint.h"

#include <gtest/gtest.h>
#include <unistd.h>
#include <zlib.h>

#include <algorithm>
#include <cstring>
#include <fstream>
#include <random>

#include "app/own_folder.h"
#include "film/image_file.h"
#include "film/statistics.h"
#include "scene/file/scene_change.h"
#include "scene/file/scene_file.h"

using namespace glimt;

namespace {

Scene small_scene() {
  return parse_scene(R"(
name = "Dot"
[camera]
eye = [0, 0, 4]
look_at = [0, 0, 0]
up = [0, 1, 0]
fov_y = 40
[image]
width = 2
height = 1
[render]
seed = 7
[material.clay]
type = "lambertian"
reflectance = [0.5, 0.5, 0.5]
[[sphere]]
name = "ball"
material = "clay"
center = [0, 0, 0]
radius = 1
)",
                     "small");
}

/// Samples of random radiance from `first` on, the same whichever others there are.
Film film_of(SampleRange range, int width = 2, int height = 1) {
  Film film(width, height, 3, {Emitter{3, 4}});
  film.go_on_from(range.first);
  for (int n = range.first; n < range.end(); ++n) {
    std::mt19937 random(static_cast<unsigned>(n));
    std::lognormal_distribution<float> value(0, 3);
    for (int pixel = 0; pixel < width * height; ++pixel)
      film.add(pixel, n % 2, value(random), value(random), value(random));
    film.add_by_chance(std::array<std::uint64_t, chance_counters(1)>{0, 0, random(), 0, 1});
  }
  film.finish_pass(range.count);
  return film;
}

void expect_same(const Film& a, const Film& b) {
  EXPECT_EQ(a.width(), b.width());
  EXPECT_EQ(a.height(), b.height());
  EXPECT_EQ(a.ranges(), b.ranges());
  EXPECT_EQ(a.scale(), b.scale());
  EXPECT_EQ(a.invalid(), b.invalid());
  EXPECT_EQ(a.saturated(), b.saturated());
  for (const int h : {0, 1}) EXPECT_TRUE(std::ranges::equal(a.sums(h), b.sums(h))) << "half " << h;
  EXPECT_TRUE(std::ranges::equal(a.by_chance(), b.by_chance()));
  ASSERT_EQ(a.emitters().size(), b.emitters().size());
  for (std::size_t i = 0; i < a.emitters().size(); ++i) {
    EXPECT_EQ(a.emitters()[i].radiance, b.emitters()[i].radiance);
    EXPECT_EQ(a.emitters()[i].ways, b.emitters()[i].ways);
  }
}

// A part's samples are numbered as the whole's: sample 2k + h is in half h, wherever the part begins.
TEST(FilmParts, AddUpToTheWholeInAnyOrder) {
  std::vector<SampleRange> parts{{0, 3}, {3, 1}, {4, 7}, {11, 2}};
  const Film whole = film_of({0, 13});
  const auto by_first = [](const SampleRange& a, const SampleRange& b) { return a.first < b.first; };
  do {
    Film film = film_of(parts.front());
    for (std::size_t i = 1; i < parts.size(); ++i) film.add(film_of(parts[i]));
    expect_same(film, whole);
    EXPECT_EQ(film.mean().rgb, whole.mean().rgb);
    EXPECT_EQ(film.standard_error().rgb, whole.standard_error().rgb);
  } while (std::ranges::next_permutation(parts, by_first).found);
}

TEST(FilmParts, CountTheirCountersAndStopAtTheLargestSum) {
  Film a(1, 1, 1), b(1, 1, 1);
  a.add(0, 0, 1e30f, -1, 1);
  a.finish_pass(1);
  b.go_on_from(2);
  b.add(0, 0, 1e30f, 1, -1);
  b.finish_pass(1);
  a.add(b);
  EXPECT_EQ(a.invalid(), 2U);
  EXPECT_EQ(a.saturated(), 3U) << "one of each, and their sum";
  EXPECT_EQ(a.sums(0)[0], (std::uint64_t{1} << 63) - 1);
  EXPECT_EQ(a.ranges(), (SampleRanges{{0, 1}, {2, 1}}));
}

TEST(FilmParts, OfDifferentUnitsOrTheSameSamplesAreRefused) {
  Film film = film_of({0, 4});
  EXPECT_THROW(film.add(film_of({3, 2})), std::invalid_argument);
  EXPECT_THROW(film.add(film_of({4, 2}, 1, 2)), std::invalid_argument);
  EXPECT_THROW(film.add(Film(2, 1, 300)), std::invalid_argument);
  expect_same(film, film_of({0, 4}));
}

// Two samples of one half say nothing of the error.
TEST(FilmParts, WithoutOneHalfTheErrorIsUnknown) {
  Film film = film_of({0, 1});
  film.add(film_of({2, 1}));
  EXPECT_EQ(film.samples(), 2);
  EXPECT_TRUE(std::isinf(film.standard_error().rgb[0]));
  EXPECT_TRUE(std::isinf(estimate_error(film).relmse));
}

TEST(FilmParts, TakeTheSamplesThatAreMissing) {
  Film film = film_of({4, 2});
  EXPECT_EQ(film.missing().first, 6) << "goes on from where it began";
  film.go_on_from(0);
  EXPECT_EQ(film.missing(), (SampleRange{0, 4}));
  film.finish_pass(4);
  EXPECT_EQ(film.missing().first, 6);
  EXPECT_EQ(film.ranges(), (SampleRanges{{0, 6}}));
}

TEST(SceneChange, NamesTheFirstThingThatDiffers) {
  const Scene scene = small_scene();
  const auto change = [&](const std::string& override) {
    return first_change(parse_scene(write_scene(scene), "scene", std::vector{override}), scene);
  };
  EXPECT_EQ(change("render.spp=1000"), "");
  EXPECT_EQ(change("render.target_error=0.1"), "");
  EXPECT_EQ(change("image.width=3"), "the image is 3x1, not 2x1");
  EXPECT_EQ(change("render.seed=1"), "seed is 1, not 7");
  EXPECT_EQ(change("render.sampler=sobol"), "sampler is sobol, not lattice");
  EXPECT_EQ(change("camera.fov_y=50"), "[camera] has fov_y = 50, not 40");
  EXPECT_EQ(change("material.clay.reflectance=[0.1, 0.2, 0.3]"),
            "[material.clay] has reflectance = [0.1, 0.2, 0.3], not [0.5, 0.5, 0.5]");
  EXPECT_EQ(change("sphere.ball.radius=2"), "[[sphere]] \"ball\" has radius = 2, not 1");
  EXPECT_EQ(change("name=\"Dash\""), "name is \"Dash\", not \"Dot\"");
  Scene more = scene;
  more.spheres.push_back(more.spheres.front());
  EXPECT_EQ(first_change(more, scene), "it has other shapes");
}

// Sub-pixels are as many as the samples, so their number makes another picture.
TEST(SceneChange, SamplesCountWhereSubPixelsDependOnThem) {
  Scene scene = small_scene();
  scene.render.sampler = Sampler::centres;
  scene.render.spp = 16;
  Scene other = scene;
  other.render.spp = 25;
  EXPECT_EQ(first_change(other, scene), "spp is 25, not 16");
}

class CheckpointFile : public glimt::testing::OwnFolder {
 protected:
  void SetUp() override {
    OwnFolder::SetUp();
    Film film = film_of({3, 5});
    film.add(film_of({10, 1}));
    film.add(0, 0, -1, 1e30f, 0);
    whole_ = {small_scene(), std::move(film), 1.25, 42};
    whole_.scene.render.target_error = 0.01;
    write_checkpoint("a.ckpt", whole_);
    std::ifstream stream("a.ckpt", std::ios::binary);
    bytes_.assign(std::istreambuf_iterator<char>(stream), {});
  }

  /// What reading these bytes as a file throws; one line that names it.
  static std::string refusal(const std::string& bytes) {
    std::ofstream("b.ckpt", std::ios::binary) << bytes;
    try {
      read_checkpoint("b.ckpt");
      return "";
    } catch (const CheckpointError& error) {
      const std::string what = error.what();
      EXPECT_TRUE(what.starts_with("b.ckpt: ")) << what;
      EXPECT_EQ(what.find('\n'), std::string::npos) << what;
      return what.substr(8);
    }
  }

  /// The file with other bytes at a place, and the checksum that they have.
  template <class T>
  std::string forged(std::size_t place, T value) const {
    std::string bytes = bytes_;
    std::memcpy(bytes.data() + place, &value, sizeof value);
    const auto sum = static_cast<std::uint32_t>(
        crc32_z(0, reinterpret_cast<const Bytef*>(bytes.data()) + checked_from, bytes.size() - checked_from));
    std::memcpy(bytes.data() + checked_from - 4, &sum, sizeof sum);
    return bytes;
  }

  static constexpr std::size_t checked_from = 16;  ///< behind signature, format and checksum
  static constexpr std::size_t width_at = 28, scale_at = 40, nanoseconds_at = 64, version_at = 80;
  std::size_t ranges_at() const { return bytes_.size() - 2 * 6 * 8 - (16 + 5 * 8) - 2 * 8; }
  Checkpoint whole_;
  std::string bytes_;
};

TEST_F(CheckpointFile, ReadsBackAsItWas) {
  const Checkpoint read = read_checkpoint("a.ckpt");
  EXPECT_EQ(read.scene, whole_.scene);
  EXPECT_EQ(read.seconds, whole_.seconds);
  EXPECT_EQ(read.next_check, whole_.next_check);
  expect_same(read.film, whole_.film);
  EXPECT_EQ(read.film.ranges(), (SampleRanges{{3, 5}, {10, 1}}));
  EXPECT_GT(read.film.invalid() + read.film.saturated(), 0U);
}

TEST_F(CheckpointFile, WithAnyByteDamagedIsRefused) {
  for (std::size_t i = 0; i < bytes_.size(); ++i)
    for (const int change : {0x01, 0x80, 0xff}) {
      std::string bytes = bytes_;
      bytes[i] = static_cast<char>(bytes[i] ^ change);
      EXPECT_NE(refusal(bytes), "") << "byte " << i << " changed by " << change;
    }
}

TEST_F(CheckpointFile, CutShortAnywhereOrTooLongIsRefused) {
  for (std::size_t size = 0; size < bytes_.size(); ++size)
    EXPECT_NE(refusal(bytes_.substr(0, size)), "") << "cut to " << size;
  EXPECT_NE(refusal(bytes_ + '\0'), "");
  EXPECT_EQ(refusal(bytes_), "");
}

TEST_F(CheckpointFile, SaysWhatIsWrong) {
  EXPECT_EQ(refusal(""), "is no checkpoint: it is too short");
  EXPECT_EQ(refusal(std::string(1000, 'x')), "is no checkpoint of glimt");
  const std::string size = std::to_string(bytes_.size());
  EXPECT_EQ(refusal(bytes_.substr(0, 200)), "is cut short or damaged: it has 200 bytes, and by its beginning " + size);
  std::string damaged = bytes_;
  damaged.back() ^= 1;
  EXPECT_EQ(refusal(damaged), "is damaged: its checksum or its numbers are wrong");
  std::string later = bytes_;
  later[8] = 2;
  EXPECT_EQ(refusal(later), "is a checkpoint of format 2; this glimt reads format 1");
  EXPECT_EQ(refusal(forged(version_at, '9')), std::string("was written by glimt 9") + (GLIMT_VERSION + 1) +
                                                  ", and samples of glimt " GLIMT_VERSION " may differ");
}

// A checksum proves no good will: sizes beyond the file, memory's or a number's end, ranges that overlap.
TEST_F(CheckpointFile, ForgedNumbersAreRefused) {
  constexpr const char* damaged = "is damaged: its checksum or its numbers are wrong";
  for (const std::int32_t side : {-1, 0, 1 << 30, std::numeric_limits<std::int32_t>::min()})
    EXPECT_EQ(refusal(forged(width_at, side)), damaged) << side;
  for (const std::size_t length_at : {16U, 20U, 24U})
    EXPECT_NE(refusal(forged(length_at, ~std::uint32_t{0})).find("is cut short or damaged"), std::string::npos);
  for (const double scale : {0.0, -1.0, 3.0, std::numeric_limits<double>::quiet_NaN(), HUGE_VAL})
    EXPECT_EQ(refusal(forged(scale_at, scale)), damaged) << scale;
  EXPECT_EQ(refusal(forged(nanoseconds_at, std::int64_t{-1})), damaged);
  for (const SampleRange range : {SampleRange{-1, 5}, {3, 0}, {3, -5}, {3, 8}, {3, 7}, {1 << 30, 1 << 30}})
    EXPECT_EQ(refusal(forged(ranges_at(), range)), damaged) << range.first << ":" << range.count;
  EXPECT_EQ(refusal(forged(bytes_.size() - 8, ~std::uint64_t{0})), damaged);
  EXPECT_NE(refusal(forged(version_at + 5, '=')).find("its scene:1:1"), std::string::npos) << "in its scene";
  EXPECT_EQ(refusal(forged(scale_at, whole_.film.scale())), "") << "the forger's hand is good";
}

TEST_F(CheckpointFile, IsAFile) {
  std::filesystem::create_directory("folder");
  EXPECT_THROW(read_checkpoint("folder"), CheckpointError);
  EXPECT_THROW(read_checkpoint("missing"), CheckpointError);
  EXPECT_THROW(read_checkpoint("/dev/null"), CheckpointError);
  EXPECT_THROW(write_checkpoint("missing/a.ckpt", whole_), ImageFileError);
}

}  // namespace
