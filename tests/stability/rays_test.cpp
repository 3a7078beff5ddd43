// Very many rays, and very many samples of one pixel.
#include <gtest/gtest.h>

#include "pictures.h"
#include "scene/file/scene_file.h"
#include "scene_parts.h"

using namespace glimt;

namespace {

/// The report's room with everything in it white and glowing with 1: a path that meets 64 surfaces and no lamp on its
/// way sums up 64 times 1 without rounding. A ray that escaped, or a value that is no number, would make it less.
Scene glowing_room() {
  Scene scene = read_scene(GLIMT_SCENES "/report.toml");
  for (Material& m : scene.materials) m = lambertian(m.name, dvec3{1}, dvec3{1});
  scene.render.max_depth = 64;
  scene.render.roulette_depth = 64;
  scene.render.path_sharing = PathSharing::off;  // each path for itself
  return scene;
}

// Failure: black dots where a ray slips between two walls, or between a wall and a thing that stands on it. 128 x 96
// pixels, 128 samples, 64 rays each: 100 663 296 rays, and one that escapes shows.
TEST(ManyRays, NoneOfAHundredMillionEscapes) {
  Scene scene = glowing_room();
  scene.image = {128, 96};
  const int samples = 16 * effort;
  const CompiledScene compiled = compile(scene);
  ASSERT_FALSE(compiled.room.empty());
  const Film film = render(compiled, samples);  // throws where a counter is not 0
  for (int pixel = 0; pixel < 128 * 96; ++pixel)
    for (const int half : {0, 1})
      for (const double sum : film.half_sum(pixel, half))
        ASSERT_EQ(sum, 64.0 * film.half_samples(half)) << "pixel " << pixel << ", half " << half;
}

// Failure: the same, in rooms that are no pairs of planes: a sphere around all, and a sphere in a box at an angle.
TEST(ManyRays, NoneEscapesOtherRooms) {
  for (const bool shell : {false, true}) {
    Scene scene = glowing_room();
    scene.image = {64, 48};
    const std::string white = scene.materials[0].name;
    if (shell) {
      scene.polygons.clear();
      scene.spheres.push_back({"shell", white, {5, 0, 0}, 9});
    } else {
      const double a = 0.3;
      for (Polygon& wall : scene.polygons)
        for (dvec3& v : wall.vertices)
          v = {v.x * std::cos(a) - v.y * std::sin(a), v.x * std::sin(a) + v.y * std::cos(a), v.z};
      scene.meshes.clear();
      for (Sphere& s : scene.spheres) s.center *= 0.4;
    }
    const CompiledScene compiled = compile(scene);
    ASSERT_TRUE(shell ? !compiled.shells.empty() : !compiled.room.empty());
    for (const float v : trace_all(compiled, 2 * effort, Lanes::native))
      ASSERT_EQ(v, 64) << (shell ? "shell" : "tilted");
  }
}

// Failure: one NaN, infinity or negative value in a long render. report.toml, all estimators that do not end a path at
// once: about 7 rays a path.
TEST(ManyRays, CountersStayZeroWithEveryEstimator) {
  Scene scene = read_scene(GLIMT_SCENES "/report.toml");
  scene.image = {200, 150};
  for (const LightSampling sampling : {LightSampling::none, LightSampling::area, LightSampling::solid_angle})
    for (const Mis mis : {Mis::off, Mis::on}) {
      scene.render.light_sampling = sampling;
      scene.render.mis = mis;
      const CompiledScene compiled = compile(scene);
      Film film = make_film(compiled);
      render_pass(compiled, film, 4 * effort, {});
      EXPECT_EQ(film.invalid(), 0u);
      EXPECT_EQ(film.saturated(), 0u);
    }
}

// Failure: sums that stop growing, or grow by rounded steps, after a million samples. furnace.toml's pixels are exactly
// 1, 2 and 4; the error comes from 1024 groups of paths, which also must add up to the film's sum.
TEST(ManySamples, AMillionOfOnePixelDoNotDrift) {
  Scene scene = read_scene(GLIMT_SCENES "/furnace.toml");
  scene.image = {1, 1};
  scene.render.sampler = Sampler::independent;
  const CompiledScene compiled = compile(scene);
  constexpr int groups = 128 * effort, size = 1024;  // 2^20 samples
  const Film film = render(compiled, groups * size);
  ASSERT_EQ(film.samples(), groups * size);
  std::array<std::vector<double>, 3> means;
  for (int group = 0; group < groups; ++group) {
    const auto rgb = trace_all(compiled, {0, 0, 1, 1, static_cast<std::uint32_t>(group * size), size}, Lanes::native);
    for (std::size_t c = 0; c < 3; ++c) {
      means[c].push_back(0);
      for (std::size_t i = c; i < rgb.size(); i += 3) means[c].back() += static_cast<double>(rgb[i]) / size;
    }
  }
  for (std::size_t c = 0; c < 3; ++c) {
    const Estimate e = estimate(means[c]);
    const double exact = std::array{1.0, 2.0, 4.0}[c];
    EXPECT_LT(std::abs(e.mean - exact), 4 * e.error) << e.mean << " +- " << e.error;  // 6e-5 of a false alarm
    EXPECT_LT(e.error, 0.01 * exact);
    const double in_film = (film.half_sum(0, 0)[c] + film.half_sum(0, 1)[c]) / film.samples();
    EXPECT_NEAR(in_film, e.mean, 1e-9 * e.mean) << "what the film holds is not what was put in";
  }
}

}  // namespace
