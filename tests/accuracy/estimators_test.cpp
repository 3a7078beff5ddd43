#include <gtest/gtest.h>

#include <iostream>

#include "same_picture.h"
#include "scene_parts.h"

using namespace glimt;

// Estimators that must agree. The probability of a false alarm is alpha for each test.
namespace {

constexpr double alpha = 1e-4;

/// A box with large lamps of every shape, so that chance finds them too, and things that stand in the light.
Scene lamps_of_all_shapes() {
  Scene scene;
  scene.name = "lamps of all shapes";
  scene.materials = {lambertian("white", {0.7, 0.7, 0.6}), lambertian("red", {0.7, 0.2, 0.1}),
                     light("ceiling lamp", {2, 3, 4}),     light("bulb", {5, 3, 1}),
                     light("crystal", {1, 6, 2}),          oren_nayar("clay", 0.8, {0.6, 0.6, 0.7})};
  scene.polygons = box({-2, -1, -2}, {2, 1, 2}, "white");
  scene.polygons[4].material = "red";
  scene.polygons.push_back(
      {"ceiling lamp", "ceiling lamp", {{-1, 0.9, -1}, {0.5, 0.9, -1.2}, {1, 0.9, 0}, {0, 0.9, 1}, {-1, 0.9, 0.5}}});
  scene.spheres = {{"bulb", "bulb", {1.2, -0.2, -0.8}, 0.4}, {"ball", "clay", {0, -0.5, 0}, 0.5}};
  scene.meshes = {tetrahedron("crystal", "crystal", {-1.2, -0.3, -0.5}, 0.5),
                  tetrahedron("block", "white", {0.9, -0.6, 0.6}, 0.4)};
  scene.camera = {{0, 0, 1.9}, {0, -0.1, 0}, {0, 1, 0}, 75};
  scene.image = {32, 32};
  return scene;
}

/// Lamps are also seen through glass and mirrors, which chance alone finds.
Scene with_mirror_and_glass() {
  Scene scene = lamps_of_all_shapes();
  scene.name = "mirror and glass";
  scene.materials.push_back(mirror("mirror", {0.9, 0.8, 0.9}));
  scene.materials.push_back(glass("glass", 1.5));
  scene.spheres[1].material = "glass";
  scene.meshes[1].material = "mirror";
  return scene;
}

/// Rectangles that stand on the floor and hang near walls, among EON walls.
Scene rectangles() {
  Scene scene;
  scene.name = "rectangles";
  scene.materials = {eon("white", 1, {0.8, 0.6, 0.5}), light("lamp", {2, 4, 3}), light("panel", {3, 1, 2})};
  scene.polygons = box({-2, -1, -2}, {2, 1, 2}, "white");
  scene.polygons.push_back({"lamp", "lamp", {{-1.5, 0.95, -1}, {0.5, 0.95, -1}, {0.5, 0.95, 0.5}, {-1.5, 0.95, 0.5}}});
  scene.polygons.push_back({"panel", "panel", {{1.5, -1, -1.5}, {1.5, -1, 0}, {1.5, 0.2, 0}, {1.5, 0.2, -1.5}}});
  std::reverse(scene.polygons.back().vertices.begin(), scene.polygons.back().vertices.end());
  scene.meshes = {tetrahedron("block", "white", {-0.6, -0.5, 0.3}, 0.5)};
  scene.camera = {{0, 0, 1.9}, {0, -0.1, 0}, {0, 1, 0}, 75};
  scene.image = {32, 32};
  return scene;
}

struct Variant {
  const char* name;
  int samples = 8;  ///< per pixel
  LightSampling light_sampling = LightSampling::area;
  Mis mis = Mis::off;
  int shadow_rays = 1;
  Roulette roulette = Roulette::throughput;
  int roulette_depth = 3;
  Sampler sampler = Sampler::independent;
  Lanes lanes = Lanes::native;
};

const std::vector<Variant> variants{
    {.name = "area"},
    {.name = "naive", .samples = 32, .light_sampling = LightSampling::none},
    {.name = "solid angle", .light_sampling = LightSampling::solid_angle},
    {.name = "auto", .light_sampling = LightSampling::automatic},
    {.name = "area, MIS", .mis = Mis::on},
    {.name = "solid angle, MIS", .light_sampling = LightSampling::solid_angle, .mis = Mis::on},
    {.name = "area, M = 2", .samples = 6, .shadow_rays = 2},
    {.name = "solid angle, MIS, M = 3",
     .samples = 4,
     .light_sampling = LightSampling::solid_angle,
     .mis = Mis::on,
     .shadow_rays = 3},
    {.name = "area, M = 7", .samples = 2, .shadow_rays = 7},
    {.name = "roulette from the first hit", .roulette_depth = 0},
    {.name = "roulette from depth 20", .roulette_depth = 20},
    {.name = "constant roulette", .samples = 16, .roulette = Roulette::constant},
    {.name = "stratified", .sampler = Sampler::stratified},
    {.name = "lattice", .sampler = Sampler::lattice},
    {.name = "lattice, M = 2", .samples = 4, .shadow_rays = 2, .sampler = Sampler::lattice},
    {.name = "Sobol", .sampler = Sampler::sobol},
    {.name = "Sobol, solid angle, MIS, M = 2",
     .samples = 4,
     .light_sampling = LightSampling::solid_angle,
     .mis = Mis::on,
     .shadow_rays = 2,
     .sampler = Sampler::sobol},
    {.name = "one lane", .samples = 4, .lanes = Lanes::scalar},
};

/// Pictures by that variant; `first_seed` is its own, so that no two variants share random numbers.
Series render_variant(Scene scene, const Variant& v, int seeds, int first_seed, int block_size) {
  Settings& s = scene.render;
  s.light_sampling = v.light_sampling, s.mis = v.mis, s.shadow_rays = v.shadow_rays, s.roulette = v.roulette;
  s.roulette_depth = v.roulette_depth, s.sampler = v.sampler;
  Series series;
  for (int seed = first_seed; seed < first_seed + seeds; ++seed) {
    s.seed = seed;
    const Film film = render(compile(scene), v.samples * effort / 8, {.threads = 0, .lanes = v.lanes});
    series.blocks.push_back(block_means(film.mean(), block_size));
  }
  return series;
}

/// The seeds are named so that a failure can be replayed.
Named named(const Variant& v, int first_seed, Series series) {
  return {std::string(v.name) + " (seeds from " + std::to_string(first_seed) + ")", std::move(series)};
}

class Estimators : public testing::TestWithParam<Scene (*)()> {};

// Each variant against each other one.
TEST_P(Estimators, AgreePairwise) {
  const Scene scene = GetParam()();
  constexpr int seeds = 32;
  std::vector<Named> all;
  for (const Variant& v : variants) {
    const int first_seed = 1 + 100 * static_cast<int>(all.size());
    all.push_back(named(v, first_seed, render_variant(scene, v, seeds, first_seed, 16)));
    const Estimate e = all.back().series.overall();
    EXPECT_LT(e.error, (effort > 1 ? 0.01 : 0.05) * e.mean) << v.name << ": too few paths to say anything";
  }
  const auto n = static_cast<double>(all.size());
  const double level = sidak(alpha, n * (n - 1) / 2 * comparisons(all[0].series));
  for (std::size_t i = 0; i < all.size(); ++i)
    for (std::size_t k = 0; k < i; ++k) expect_same(all[k], all[i], level, scene.name);
}

INSTANTIATE_TEST_SUITE_P(Scenes, Estimators, testing::Values(lamps_of_all_shapes, with_mirror_and_glass, rectangles),
                         [](const auto& scene) { return case_name(scene.param()); });

// A lamp that is half behind the wall lights the room with its other half only, whatever it is made of.
TEST(HiddenLamps, NaiveIsPathWhereWallsHideLamps) {
  for (const bool as_mesh : {false, true}) {
    Scene scene = lamps_of_all_shapes();
    scene.name = as_mesh ? "a mesh in the wall" : "a polygon in the wall";
    scene.polygons.pop_back();
    scene.spheres[0].center = {2, 0, 0};
    const std::vector<dvec3> pane{{-1, 0.3, 1}, {-1, 0.3, -1}, {-1, 1.8, -1}, {-1, 1.8, 1}};
    if (as_mesh) {
      scene.meshes.push_back({"pane", "ceiling lamp", pane, {{0, 1, 2}, {0, 2, 3}}});
    } else {
      scene.polygons.push_back({"pane", "ceiling lamp", pane});
    }
    std::vector<Named> all;
    for (const Variant& v : {variants[0], variants[1], variants[5]}) {
      const int first_seed = 5001 + 100 * static_cast<int>(all.size());
      all.push_back(named(v, first_seed, render_variant(scene, v, 32, first_seed, 8)));
    }
    const double level = sidak(alpha, 2.0 * 3 * comparisons(all[0].series));
    for (std::size_t i = 0; i < all.size(); ++i)
      for (std::size_t k = 0; k < i; ++k) expect_same(all[k], all[i], level, scene.name);
  }
}

}  // namespace
