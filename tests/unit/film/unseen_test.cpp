#include "film/unseen.h"

#include <gtest/gtest.h>

#include <cmath>

#include "film/statistics.h"
#include "pictures.h"
#include "scene_parts.h"

using namespace glimt;

namespace {

constexpr int side = 10, samples = 4;
constexpr double paths = side * side * samples;

/// A grey picture, in which that much was found of one emitter.
Film grey_film(double radiance, const Emitter& emitter, ChanceWay way, double hits, double mirror_paths = 0) {
  Film film(side, side, emitter.radiance, {emitter});
  const auto value = static_cast<float>(radiance);
  for (int pixel = 0; pixel < side * side; ++pixel)
    for (int k = 0; k < samples; ++k) film.add(pixel, k % 2, value, value, value);
  film.finish_pass(samples);
  std::vector<std::uint64_t> counters(chance_counters(1));
  counters[static_cast<std::size_t>(way)] = static_cast<std::uint64_t>(hits * chance_unit);
  counters.back() = static_cast<std::uint64_t>(mirror_paths);
  film.add_by_chance(counters);
  return film;
}

Emitter emitter_of(double radiance, ChanceWay way) {
  Emitter emitter{radiance};
  emitter.leave(way, true);
  return emitter;
}

// Upper limits at 95 % of the mean of a Poisson distribution, as Gehrels (1986), table 1, has them.
TEST(Unseen, MissingEventsAreThoseOfThePoissonDistribution) {
  EXPECT_NEAR(missing_events(0), -std::log(0.05), 1e-9) << "the rule of three";
  EXPECT_NEAR(missing_events(1), 4.744 - 1, 5e-4);
  EXPECT_NEAR(missing_events(2), 6.296 - 2, 5e-4);
  EXPECT_NEAR(missing_events(5), 10.51 - 5, 5e-3);
  EXPECT_NEAR(missing_events(10), 16.96 - 10, 5e-3);
  for (double hits = 0; hits < 20; hits += 0.25) EXPECT_GT(missing_events(hits + 0.25), missing_events(hits)) << hits;
}

TEST(Unseen, IsTheRuleOfThreeTimesTheLargestContribution) {
  const Emitter lamp = emitter_of(50, ChanceWay::lit);
  const double missing = 50 * -std::log(0.05) / paths;
  const Unseen none = unseen_light(grey_film(1, lamp, ChanceWay::lit, 0), 1);
  EXPECT_NEAR(none.flux, missing / (1 + missing), 1e-9);
  EXPECT_FALSE(none.light.empty());
  const Unseen elsewhere = unseen_light(grey_film(1, lamp, ChanceWay::straight, 1000), 1);
  EXPECT_EQ(elsewhere.flux, none.flux) << "hits of another way say nothing of this one";
  const Unseen few = unseen_light(grey_film(1, lamp, ChanceWay::lit, 3), 1);
  EXPECT_GT(few.flux, none.flux) << "few hits say that there are rare ones";
  EXPECT_EQ(unseen_light(grey_film(1, lamp, ChanceWay::lit, 20), 1).flux, 0) << "the halves tell their error";
  EXPECT_EQ(unseen_light(Film(side, side, 1), 1).flux, 0) << "nothing is left to chance";
}

// Wherever in the picture the missing light is, the error is no larger. At its worst it stands in black pixels, in each
// as much as makes the error there 1/2: the bound is then reached but for what the light adds to the mean.
TEST(Unseen, BoundsTheErrorOfAnyPictureThatLacksTheLight) {
  const Emitter lamp = emitter_of(8, ChanceWay::lit);
  const Unseen unseen = unseen_light(grey_film(1, lamp, ChanceWay::lit, 0), 1);
  const double missing = unseen.flux / (1 - unseen.flux) * side * side;
  ASSERT_LT(unseen.relmse, 1);
  double worst = 0;
  for (int dark = 0; dark < side * side; ++dark)
    for (int lit = 1; lit <= side * side; ++lit) {
      Image found{side, side, std::vector<float>(3 * side * side, 0.0f)};
      for (int pixel = dark; pixel < side * side; ++pixel)
        for (int c = 0; c < 3; ++c)
          found.pixel(pixel, 0)[c] = static_cast<float>(side * side / static_cast<double>(side * side - dark));
      Image whole = found;
      for (int pixel = 0; pixel < lit; ++pixel)
        for (int c = 0; c < 3; ++c) whole.pixel(pixel, 0)[c] += static_cast<float>(missing / lit);
      worst = std::max(worst, compare(found, whole).relmse_scaled);
    }
  EXPECT_LE(worst, unseen.relmse);
  EXPECT_GT(worst, 0.9 * unseen.relmse) << "the bound is no larger than it must be";
}

TEST(Unseen, LightByWayOfMirrorsIsMissingOnlyWhereTheCameraSeesThem) {
  const Emitter lamp = emitter_of(1e6, ChanceWay::lit_and_mirrored);
  const double mirror_paths = 25;
  const Unseen unseen = unseen_light(grey_film(1, lamp, ChanceWay::lit_and_mirrored, 0, mirror_paths), 1);
  EXPECT_GT(unseen.flux, 0.9);
  EXPECT_GT(unseen.relmse, mirror_paths / paths);
  EXPECT_LT(unseen.relmse, 2 * mirror_paths / paths);
}

TEST(Unseen, MakesTheErrorABoundWhereItWouldShow) {
  const auto estimate = [](double radiance, double hits) {
    Film film = grey_film(1, emitter_of(radiance, ChanceWay::lit), ChanceWay::lit, hits);
    for (int pixel = 0; pixel < side * side; ++pixel)
      film.add(pixel, 0, 0.1f * static_cast<float>(pixel % 3), 0, 0);  // the halves differ
    return estimate_error(film);
  };
  const ErrorEstimate bound = estimate(1e4, 0);
  EXPECT_TRUE(bound.is_bound());
  EXPECT_GT(bound.at_most(), 0.9);
  EXPECT_NE(trust_text(bound).find("error at least "), std::string::npos) << trust_text(bound);
  EXPECT_NE(trust_text(bound).find(bound.unseen.light), std::string::npos) << trust_text(bound);
  for (const ErrorEstimate& known : {estimate(1e4, 20), estimate(1e-4, 0)}) {
    EXPECT_FALSE(known.is_bound());
    EXPECT_EQ(known.at_most(), known.relmse_scaled);
    EXPECT_NEAR(known.relmse_scaled, bound.relmse_scaled, 1e-6 * bound.relmse_scaled) << "another fixed point";
  }
}

/// A white box around the camera with a lamp below its ceiling, light sampling off, and what the view shows.
Scene chance_box(const std::string& front) {
  Scene scene;
  scene.materials = {lambertian("white", dvec3{0.5}), light("lamp", {4, 5, 6}), mirror("mirror", dvec3{0.9}),
                     glass("glass", 1.5)};
  scene.polygons = box(dvec3{-1}, dvec3{1}, "white");
  scene.polygons[2].material = front;
  scene.polygons.push_back(square_lamp(0.8, 0.9));
  scene.camera = {{0, 0, 0.9}, {0, 0, 0}, {0, 1, 0}, 50};
  scene.image = {16, 16};
  scene.render.light_sampling = LightSampling::none;
  scene.render.path_sharing = PathSharing::off;
  scene.render.light_paths = 0;
  return scene;
}

/// Hits of the only emitter by a way.
double hits(const Film& film, ChanceWay way) {
  return static_cast<double>(film.by_chance()[static_cast<std::size_t>(way)]) / chance_unit;
}

// Without any technique but chance a path brings its throughput times the lamp's radiance, so the counters add up to
// the picture: each of N hits was rounded down by less than a unit.
TEST(Unseen, TheKernelCountsAllLightThatChanceFinds) {
  for (const std::string front : {"white", "mirror", "glass"}) {
    Scene scene = chance_box(front == "glass" ? "white" : front);
    if (front == "glass") scene.spheres = {{"ball", "glass", {0, 0, 0}, 0.4}};
    const CompiledScene compiled = compile(scene);
    ASSERT_EQ(compiled.emitters.size(), 1U);
    const Film film = render(compiled, 256);
    double found = 0;
    for (std::size_t way = 0; way < chance_ways; ++way) found += hits(film, static_cast<ChanceWay>(way));
    const double all = 16 * 16 * 256;
    EXPECT_NEAR(found * 5 / all, mean(film.mean()), 5.0 / chance_unit) << front;
    EXPECT_GT(found, 1000);
  }
}

TEST(Unseen, TheKernelKnowsTheWays) {
  const auto film_of = [](const Scene& scene) { return render(compile(scene), 64); };
  const double all = 16 * 16 * 64;
  const Film matt = film_of(chance_box("white"));
  EXPECT_GT(hits(matt, ChanceWay::lit), 0);
  EXPECT_EQ(hits(matt, ChanceWay::mirrored) + hits(matt, ChanceWay::lit_and_mirrored), 0);
  EXPECT_EQ(matt.by_chance().back(), 0U);
  Scene scene = chance_box("mirror");
  scene.camera.fov_y = 20;  // nothing else in view
  const Film mirrored = film_of(scene);
  EXPECT_GT(hits(mirrored, ChanceWay::lit_and_mirrored), 0);
  EXPECT_EQ(hits(mirrored, ChanceWay::straight) + hits(mirrored, ChanceWay::lit), 0);
  EXPECT_EQ(static_cast<double>(mirrored.by_chance().back()), all);
  scene.camera.look_at = {0, 0.45, -1};  // by way of the mirror to the lamp
  EXPECT_GT(hits(film_of(scene), ChanceWay::mirrored), 0);
  scene.camera.look_at = {0, 1, 0.9 - 1e-3};
  scene.camera.eye = {0, 0, 0};
  scene.camera.look_at = {0, 0.9, -0.1};
  EXPECT_GT(hits(film_of(scene), ChanceWay::straight), 0);
}

TEST(Unseen, NothingIsCountedWhereAllIsSampled) {
  Scene scene = chance_box("white");
  scene.render = {};
  EXPECT_TRUE(compile(scene).emitters.empty());
  scene.polygons[2].material = "mirror";
  EXPECT_EQ(compile(scene).emitters.size(), 1U) << "lamps and caustics in the mirror";
  scene.render.caustics = Caustics::off;
  scene.render.max_depth = 1;
  EXPECT_TRUE(compile(scene).emitters.empty());
}

}  // namespace
