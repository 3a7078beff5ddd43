// Paths that share their ends make the picture of those that do not. The probability of a false alarm is alpha for each
// test.
#include <gtest/gtest.h>

#include "random_scene.h"
#include "same_picture.h"
#include "scene/file/scene_file.h"
#include "scene_parts.h"

using namespace glimt;

namespace {

constexpr double alpha = 1e-4;

/// Files, a room with every material, and rooms of all kinds with all shapes in them.
std::vector<Scene> scenes() {
  std::vector<Scene> all;
  for (const char* file : {"hexagon", "cornell", "report"}) {
    all.push_back(read_scene(GLIMT_SCENES "/" + std::string(file) + ".toml"));
    all.back().name = file;
  }
  Scene rough;
  rough.name = "rough walls, a mirror, and glass with things in it";
  rough.materials = {lambertian("white", {0.8, 0.7, 0.6}),
                     lambertian("glow", {0.5, 0.6, 0.7}, {0.2, 0.1, 0.1}),
                     light("lamp", {4, 5, 6}),
                     mirror("mirror", {0.9, 0.8, 0.9}),
                     glass("glass", 1.5),
                     oren_nayar("clay", 0.8, {0.6, 0.6, 0.7}),
                     eon("eon", 1, {0.8, 0.6, 0.5})};
  rough.polygons = box({-2, -1, -2}, {2, 1, 2}, "white");
  rough.polygons[0].material = "clay";
  rough.polygons[1].material = "eon";
  rough.polygons[2].material = "mirror";
  rough.polygons[3].material = "glow";
  rough.polygons.push_back(square_lamp(1, 0.95));
  rough.spheres = {{"glass", "glass", {0.5, -0.4, 0}, 0.5}, {"in it", "white", {0.5, -0.4, 0.1}, 0.2}};
  rough.meshes = {tetrahedron("block", "white", {-0.7, -0.5, 0.3}, 0.5)};
  rough.camera = {{0, 0, 1.9}, {0, -0.3, 0}, {0, 1, 0}, 75};
  all.push_back(rough);
  // Most squares see walls both straight and in mirrors.
  all.push_back(rough);
  all.back().name = "small mirrors";
  all.back().spheres = {{"glass", "glass", {0.5, -0.4, 0}, 0.5}};
  for (int i = 0; i < 25; ++i)
    all.back().spheres.push_back(
        {"mirror " + std::to_string(i), "mirror", {(i % 5 - 2) * 0.2, (i / 5 - 2) * 0.2, 1.2}, 0.06});
  // Most squares see things near and far, ...
  all.push_back(all.back());
  all.back().name = "small balls";
  for (Sphere& ball : all.back().spheres) ball.material = "white";
  // ... or into two cells, a red and a green one, which do not see each other.
  Scene fins;
  fins.name = "fins";
  fins.materials = {lambertian("white", dvec3{0.8}), lambertian("red", {0.9, 0.1, 0.1}),
                    lambertian("green", {0.1, 0.9, 0.1}), light("lamp", dvec3{5})};
  fins.polygons = box({-2, -1, -2}, {2, 1, 2}, "white");
  fins.polygons.push_back(square_lamp(1, 0.95));
  for (int i = -7; i <= 7; ++i)
    for (const double side : {-0.001, 0.001})
      fins.polygons.push_back(
          {"",
           (i % 2 != 0) == (side > 0) ? "red" : "green",
           {{0.25 * i + side, -1, -2}, {0.25 * i + side, -1, -1}, {0.25 * i + side, 1, -1}, {0.25 * i + side, 1, -2}}});
  fins.camera = rough.camera;
  all.push_back(fins);
  for (unsigned seed = 0; seed < 2 * surroundings_count; ++seed) all.push_back(RandomScene(seed).scene);
  for (Scene& scene : all) scene.image = {32, 32};
  return all;
}

struct Variant {
  const char* name;
  void (*set)(Settings&);
};

constexpr std::array<Variant, 6> variants{{
    {"as it is", [](Settings&) {}},
    {"depth 3", [](Settings& s) { s.max_depth = 3; }},
    {"only caustics", [](Settings& s) { s.caustics = Caustics::only; }},
    {"no caustics, three shadow rays, MIS",
     [](Settings& s) { s.caustics = Caustics::off, s.shadow_rays = 3, s.mis = Mis::on; }},
    {"lamps by chance", [](Settings& s) { s.light_sampling = LightSampling::none; }},
    {"early roulette, independent",
     [](Settings& s) { s.roulette_depth = 0, s.roulette_below = 1, s.sampler = Sampler::independent; }},
}};

/// Pictures that share and pictures that do not; no two have random numbers in common.
std::vector<Named> alone_and_shared(Scene scene, int samples, int block_size) {
  std::vector<Named> pictures{{"alone", {}}, {"shared", {}}};
  for (std::size_t k = 0; k < 2; ++k)
    for (int seed = 0; seed < 16; ++seed) {
      scene.render.path_sharing = static_cast<PathSharing>(k);
      scene.render.seed = 50'000 * static_cast<int>(k + 1) + seed;
      pictures[k].series.blocks.push_back(block_means(render(compile(scene), samples).mean(), block_size));
    }
  return pictures;
}

class TailSharing : public testing::TestWithParam<Scene> {};

TEST_P(TailSharing, KeepsThePicture) {
  for (const Variant& variant : variants) {
    Scene scene = GetParam();
    variant.set(scene.render);
    const std::vector<Named> pictures = alone_and_shared(scene, 4 * effort, 8);
    const double level = sidak(alpha, variants.size() * comparisons(pictures[0].series));
    expect_same(pictures[0], pictures[1], level, scene.name + ", " + variant.name);
  }
}

INSTANTIATE_TEST_SUITE_P(Scenes, TailSharing, testing::ValuesIn(every_third(scenes())),
                         [](const auto& scene) { return case_name(scene.param); });
INSTANTIATE_TEST_SUITE_P(MoreScenesLong, TailSharing, testing::ValuesIn(every_third(scenes(), true)),
                         [](const auto& scene) { return case_name(scene.param); });

// Pixel by pixel, since means of blocks do not see what a square gives to the wrong one of its pixels. In scenes whose
// squares look at very different things, and without caustics, whose noise is far from normal.
TEST(SharedTailsLong, GoToThePixelsTheyAreFor) {
  for (Scene scene : scenes()) {
    if (scene.name != "small mirrors" && scene.name != "small balls" && scene.name != "fins") continue;
    scene.render.caustics = Caustics::off;
    for (const Variant& variant : {variants[0], variants[1]}) {
      variant.set(scene.render);
      const std::vector<Named> pictures = alone_and_shared(scene, 16 * effort, 1);
      const double level = sidak(alpha, 6 * comparisons(pictures[0].series));
      expect_same(pictures[0], pictures[1], level, scene.name + ", " + variant.name);
    }
  }
}

// Where all surfaces reflect the same, a square of pixels gets what its four paths have found, no more and no less:
// without roulette, sharing changes none of its random numbers.
TEST(SharedTails, AddUpToWhatTheFourPathsFound) {
  Scene scene = read_scene(GLIMT_SCENES "/hexagon_diffuse.toml");
  for (Material& m : scene.materials)
    if (m.type == "lambertian") m.set(Matt::reflectance, dvec3{0.5});
  scene.image = {64, 48};
  scene.render.roulette_depth = 64;
  scene.render.max_depth = 6;
  scene.render.path_sharing = PathSharing::off;
  const auto alone = trace_all(compile(scene), 4, Lanes::native);
  scene.render.path_sharing = PathSharing::on;
  const CompiledScene compiled = compile(scene);
  const auto shared = trace_all(compiled, 4, Lanes::native);
  int differ = 0;
  for (int sample = 0; sample < 4; ++sample)
    for (int y = 0; y < 48; y += 2)
      for (int x = 0; x < 64; x += 2) {
        double found = 0, given = 0;
        for (const int place : {0, 1, 64, 65}) {
          const auto i = 3 * static_cast<std::size_t>((sample * 48 + y) * 64 + x + place);
          found += static_cast<double>(alone[i]), given += static_cast<double>(shared[i]);
          differ += alone[i] != shared[i];
        }
        ASSERT_NEAR(given, found, 1e-5 * found) << "square at (" << x << ", " << y << "), sample " << sample;
      }
  EXPECT_GT(differ, 64 * 48);
}

}  // namespace
