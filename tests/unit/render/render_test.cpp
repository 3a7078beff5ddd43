#include "render/render.h"

#include <gtest/gtest.h>

#include <thread>

#include "material/mirror.h"
#include "pictures.h"
#include "random_scene.h"
#include "scene/file/scene_file.h"

using namespace glimt;

namespace {

/// Sizes that are no multiples of a tile.
Scene from_file(const std::string& name) {
  Scene scene = read_scene(GLIMT_SCENES "/" + name + ".toml");
  scene.image = {101, 67};
  return scene;
}

/// Both halves' sums of every pixel.
std::vector<std::array<double, 3>> sums(const Film& film) {
  std::vector<std::array<double, 3>> result;
  for (int pixel = 0; pixel < film.width() * film.height(); ++pixel)
    for (const int half : {0, 1}) result.push_back(film.half_sum(pixel, half));
  return result;
}

/// The same, and what is counted of light left to chance.
std::vector<std::array<double, 3>> contents(const Film& film) {
  auto result = sums(film);
  for (const std::uint64_t counter : film.by_chance()) result.push_back({static_cast<double>(counter)});
  return result;
}

TEST(Render, PictureDoesNotDependOnTheNumberOfThreads) {
  for (const std::string name : {"hexagon", "report", "furnace"}) {
    const CompiledScene scene = compile(from_file(name));
    const auto one = contents(render(scene, 6, {.threads = 1}));
    for (const int threads : {2, 3, 4, 7})
      EXPECT_EQ(contents(render(scene, 6, {.threads = threads})), one) << name << ", " << threads << " threads";
    EXPECT_EQ(contents(render(scene, 6, {.threads = 2, .lanes = Lanes::scalar})), one) << name << ", scalar";
  }
}

TEST(Render, PictureDoesNotDependOnThePasses) {
  const CompiledScene scene = compile(from_file("hexagon"));
  const auto whole = contents(render(scene, 8));
  for (const std::vector<int>& passes : {std::vector{1, 7}, {3, 5}, {1, 1, 1, 1, 1, 1, 1, 1}, {7, 1}}) {
    Film film = make_film(scene);
    for (const int count : passes) EXPECT_TRUE(render_pass(scene, film, count, {}));
    EXPECT_EQ(film.samples(), 8);
    EXPECT_EQ(contents(film), whole) << passes.size() << " passes, first " << passes[0];
  }
}

TEST(Render, FilmHoldsTheKernelsValues) {
  const CompiledScene scene = compile(from_file("hexagon"));
  const auto rgb = trace_all(scene, 3, Lanes::native);
  Film film = make_film(scene);
  std::vector<Splat> splats;
  for (int s = 0; s < 3; ++s) {
    film.add(0, s % 2,
             {rgb.data() + static_cast<std::ptrdiff_t>(s) * 3 * scene.width * scene.height,
              3 * static_cast<std::size_t>(scene.width * scene.height)});
    splats.clear();
    trace_light(scene, {0, scene.light_paths, static_cast<std::uint32_t>(s)}, Lanes::native, splats);
    EXPECT_GT(splats.size(), 0u);
    film.add(s % 2, splats);
  }
  film.finish_pass(3);
  EXPECT_EQ(sums(render(scene, 3)), sums(film));
}

TEST(Render, CancelledPassSaysSoAndAddsNoSamples) {
  const CompiledScene scene = compile(from_file("hexagon"));
  Film film = make_film(scene);
  std::atomic<bool> cancel{true};
  EXPECT_FALSE(render_pass(scene, film, 4, {}, &cancel));
  EXPECT_EQ(film.samples(), 0);
  cancel = false;
  EXPECT_TRUE(render_pass(scene, film, 4, {}, &cancel));
  // A pass that would take hours ends when it is cancelled on its way.
  std::thread later([&] { cancel = true; });
  EXPECT_FALSE(render_pass(scene, film, 1 << 24, {}, &cancel));
  later.join();
}

// Constant roulette is played at diffuse hits only, of which a room of mirrors has none: without another end the paths
// in it would go on for ever. Black is exact, since nothing emits.
TEST(Render, PathsAmongMirrorsEndWithConstantRoulette) {
  Scene scene = from_file("furnace");
  scene.render.roulette = Roulette::constant;
  for (Material& m : scene.materials) {
    m.type = "mirror";
    m.set(Mirror::reflectance, {1, 1, 1});
  }
  const Film film = render(compile(scene), 2, {});
  for (const float value : film.mean().rgb) ASSERT_EQ(value, 0.0F);
}

TEST(Render, CountersAreZeroInSoundScenes) {
  std::vector<Scene> scenes;
  for (const std::string name : {"cornell", "furnace", "hexagon", "hexagon_diffuse", "hexagon_empty", "report"})
    scenes.push_back(from_file(name));
  for (unsigned seed = 0; seed < 10; ++seed) scenes.push_back(RandomScene(seed).scene);
  for (const Scene& scene : scenes) {
    const CompiledScene compiled = compile(scene);
    Film film = make_film(compiled);
    render_pass(compiled, film, 2 * effort, {});
    EXPECT_EQ(film.invalid(), 0u) << scene.name;
    EXPECT_EQ(film.saturated(), 0u) << scene.name;
  }
}

}  // namespace
