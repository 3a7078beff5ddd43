#include <gtest/gtest.h>

#include "accuracy/glossy_parts.h"
#include "pictures.h"
#include "same_picture.h"

using namespace glimt;

// Pictures of glossy surfaces: every estimator against every other, and the smooth limits. The probability of a false
// alarm is alpha for each test.
namespace {

constexpr double alpha = 1e-4;

/// A room with a gold ball, one of frosted glass, a lamp and matt walls.
Scene glossy_room(double roughness) {
  Scene scene;
  scene.name = "glossy room";
  scene.materials = {lambertian("white", {0.7, 0.7, 0.6}), lambertian("red", {0.7, 0.2, 0.1}), light("lamp", {6, 7, 8}),
                     metal(roughness), frosted(roughness)};
  scene.materials[3].name = "gold", scene.materials[4].name = "glass";
  scene.polygons = box({-2, -1, -2}, {2, 1, 2}, "white");
  scene.polygons[4].material = "red";
  scene.polygons.push_back(square_lamp(1, 0.95));
  scene.spheres = {{"gold", "gold", {-0.8, -0.4, -0.4}, 0.6}, {"glass", "glass", {0.8, -0.4, 0}, 0.6}};
  scene.camera = {{0, 0, 1.9}, {0, -0.1, 0}, {0, 1, 0}, 75};
  scene.image = {32, 32};
  return scene;
}

// Every estimator of the same picture agrees with every other: lamps by chance, by light sampling, MIS, with light
// paths and shared tails and without, every sampler.
TEST(Glossy, EstimatorsAgree) {
  struct Way {
    const char* name;
    int samples;
    void (*change)(Settings&);
  };
  const std::vector<Way> ways{
      {"default", 16, [](Settings&) {}},
      {"naive", 64, [](Settings& s) { set_method(s, Method::naive); }},
      {"no light paths", 16, [](Settings& s) { s.light_paths = 0; }},
      {"no sharing", 16, [](Settings& s) { s.path_sharing = PathSharing::off; }},
      {"MIS, two shadow rays", 8, [](Settings& s) { s.mis = Mis::on, s.shadow_rays = 2; }},
      {"solid angle, Sobol", 16,
       [](Settings& s) { s.light_sampling = LightSampling::solid_angle, s.sampler = Sampler::sobol; }},
      {"independent, no light paths, no sharing", 16,
       [](Settings& s) { s.sampler = Sampler::independent, s.light_paths = 0, s.path_sharing = PathSharing::off; }}};
  for (const double roughness : {0.15, 0.5}) {
    std::vector<Named> all;
    for (const Way& way : ways) {
      Scene scene = glossy_room(roughness);
      way.change(scene.render);
      Series series;
      const int first_seed = 1 + 100 * static_cast<int>(all.size());
      for (int seed = first_seed; seed < first_seed + 32; ++seed) {
        scene.render.seed = seed;
        series.blocks.push_back(block_means(render(compile(scene), way.samples * effort / 8).mean(), 8));
      }
      all.push_back({std::string(way.name) + " (seeds from " + std::to_string(first_seed) + ")", std::move(series)});
    }
    const auto n = static_cast<double>(all.size());
    const double level = sidak(alpha / 2, n * (n - 1) / 2 * comparisons(all[0].series));
    for (std::size_t i = 0; i < all.size(); ++i)
      for (std::size_t k = 0; k < i; ++k) expect_same(all[k], all[i], level, "roughness " + std::to_string(roughness));
  }
}

// Without caustics and caustics alone add up to the picture, by light paths and without.
TEST(Glossy, CausticsAreWhatCausticsOffLeavesOut) {
  for (const double light_paths : {0.0, 0.5}) {
    Scene scene = glossy_room(0.3);
    scene.render.light_paths = light_paths;
    const auto series = [&](Caustics caustics, int seed) {
      scene.render.caustics = caustics;
      Series s;
      for (int i = 0; i < 32; ++i) {
        scene.render.seed = seed + i;
        s.blocks.push_back(block_means(render(compile(scene), 2 * effort).mean(), 8));
      }
      return s;
    };
    const Series on = series(Caustics::on, 1), off = series(Caustics::off, 101), only = series(Caustics::only, 201);
    Series sum = off;
    for (std::size_t i = 0; i < sum.blocks.size(); ++i)
      for (std::size_t b = 0; b < sum.blocks[i].size(); ++b) sum.blocks[i][b] += only.blocks[i][b];
    expect_same({"on (seeds from 1)", on}, {"off + only (seeds from 101, 201)", sum}, sidak(alpha / 2, comparisons(on)),
                "light paths " + std::to_string(light_paths));
    EXPECT_GT(only.overall().mean, 0.01 * on.overall().mean);
  }
}

// A camera path of one sample is the same by one lane and by many.
TEST(Glossy, OneLaneIsMany) {
  const CompiledScene scene = compile(glossy_room(0.3));
  const auto one = trace_all(scene, 4, Lanes::scalar), many = trace_all(scene, 4, Lanes::native);
  const std::ptrdiff_t at = first_difference(one, many);
  EXPECT_EQ(at, -1) << replay(scene, at);
}

// Below an alpha of 1e-3 a surface is smooth: roughness 0.01 is the mirror and the clear glass. The glass bit for bit.
// A white metal's Fresnel factor may be an ulp off 1. Roulette leaves paths whose throughput is `roulette_below` to an
// ulp, so at the next mirror that ulp decides whether it is played again, and one path in a hundred of those then ends.
TEST(Glossy, SmoothLimits) {
  const auto picture = [](const Material& gold, const Material& glass) {
    Scene scene = glossy_room(0);
    scene.materials[3] = gold, scene.materials[4] = glass;
    scene.materials[3].name = "gold", scene.materials[4].name = "glass";
    scene.render.sphere_connections = SphereConnections::off;
    scene.render.path_sharing = PathSharing::off;
    return trace_all(compile(scene), 4, Lanes::native);
  };
  const Material silver = mirror("", dvec3{1}), clear = glass("", 1.5);
  const auto smooth = picture(silver, clear);
  for (const double roughness : {0.0, 0.01}) {
    EXPECT_EQ(first_difference(smooth, picture(silver, frosted(roughness))), -1) << roughness;
    const auto other = picture(white_metal(roughness), clear);
    int differ = 0;
    for (std::size_t i = 0; i < smooth.size(); ++i) differ += std::abs(other[i] - smooth[i]) > 1e-4f * smooth[i];
    EXPECT_LT(differ, static_cast<int>(smooth.size()) / 100) << roughness;
  }
}

}  // namespace
