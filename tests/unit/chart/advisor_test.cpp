#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>

#include "chart/advisor.h"
#include "scene/file/scene_file.h"

using namespace glimt;

namespace {

// Error 1 + 4/M and time 1 + M/4. Their product 2 + M/4 + 4/M has its derivative 1/4 - 4/M^2 = 0 at M = 4, where the
// efficiency is 1 / (2 * 2).
constexpr ShadowRayModel balanced{1, 4, 1, 0.25};

ShadowRayRun run(const ShadowRayModel& model, int rays) { return {rays, model.error(rays), model.seconds(rays)}; }

TEST(Advisor, BestNumberBalancesNoiseAndTime) {
  EXPECT_DOUBLE_EQ(ideal_shadow_rays(balanced), 4);
  EXPECT_EQ(best_shadow_rays(balanced), 4);
  EXPECT_DOUBLE_EQ(balanced.efficiency(4), 0.25);
  for (int rays = 1; rays <= most_shadow_rays; ++rays)
    EXPECT_LE(balanced.efficiency(rays), balanced.efficiency(4)) << rays;
}

TEST(Advisor, TwoRunsGiveTheModel) {
  for (const auto& [few, many] : {std::pair{1, 4}, {4, 1}, {2, 30}}) {
    const ShadowRayModel model = shadow_ray_model(run(balanced, few), run(balanced, many));
    EXPECT_NEAR(model.path_error, 1, 1e-12);
    EXPECT_NEAR(model.ray_error, 4, 1e-12);
    EXPECT_NEAR(model.path_seconds, 1, 1e-12);
    EXPECT_NEAR(model.ray_seconds, 0.25, 1e-12);
  }
}

// (1 + 5/M)(1 + M/2) = 3.5 + M/2 + 5/M is least at sqrt(10); it is 6.67 at 3 and 6.75 at 4.
TEST(Advisor, BestIsAWholeNumberInRange) {
  const ShadowRayModel uneven{1, 5, 1, 0.5};
  EXPECT_DOUBLE_EQ(ideal_shadow_rays(uneven), std::sqrt(10));
  EXPECT_EQ(best_shadow_rays(uneven), 3);
  EXPECT_GT(uneven.efficiency(3), uneven.efficiency(4));
  EXPECT_EQ(best_shadow_rays({1, 0, 1, 1}), 1) << "shadow rays make no noise";
  EXPECT_EQ(best_shadow_rays({1, 0.5, 1, 1}), 1) << "less than one would be best";
  EXPECT_EQ(best_shadow_rays({0, 1, 1, 1}), most_shadow_rays) << "they make all of it";
  EXPECT_EQ(best_shadow_rays({1, 1, 1, 0}), most_shadow_rays) << "they take no time";
}

// By chance more rays may measure noisier or faster: no part of the model is below 0 for that.
TEST(Advisor, NoPartIsNegative) {
  const ShadowRayModel noisier = shadow_ray_model({1, 2, 1}, {4, 2.2, 0.9});
  EXPECT_EQ(noisier.ray_error, 0);
  EXPECT_DOUBLE_EQ(noisier.path_error, 2.1);
  EXPECT_EQ(noisier.ray_seconds, 0);
  EXPECT_DOUBLE_EQ(noisier.path_seconds, 0.95);
  const ShadowRayModel faster = shadow_ray_model({1, 4, 1}, {4, 0.5, 5});
  EXPECT_EQ(faster.path_error, 0);
  EXPECT_DOUBLE_EQ(faster.ray_error, 4.5 / 1.25) << "through the means of error and 1/M";
  EXPECT_EQ(faster.path_seconds, 0);
  EXPECT_DOUBLE_EQ(faster.ray_seconds, 6.0 / 5);
}

// Three seeds, of which the middle one is the model; each measured at 1, 2, 4 samples, and one at 8 too.
TEST(Advisor, TakesMediansAtTheLastSampleCountThatAllHave) {
  constexpr std::array rays{1, 4};
  std::vector<Measurement> measurements;
  for (int seed = 1; seed <= 3; ++seed)
    for (std::size_t variant = 0; variant < 2; ++variant)
      for (const int spp : {1, 2, 4, 8}) {
        if (spp == 8 && variant == 1) continue;
        const ShadowRayRun at = run(balanced, rays.at(variant));
        const double error = spp == 1 ? std::numeric_limits<double>::infinity() : at.error * seed / 2 * 4 / spp;
        measurements.push_back({variant, seed, spp, at.seconds * spp / 4 * seed / 2, error});
      }
  const ShadowRayAdvice advice = shadow_ray_advice(rays, measurements);
  EXPECT_EQ(advice.samples, 4);
  ASSERT_EQ(advice.runs.size(), 2U);
  EXPECT_DOUBLE_EQ(advice.runs[0].error, 5);
  EXPECT_DOUBLE_EQ(advice.runs[1].seconds, 2);
  EXPECT_EQ(advice.best, 4);
  EXPECT_EQ(advice.low, 4) << "a factor on noise or time alone changes no answer";
  EXPECT_EQ(advice.high, 4);
}

// A black picture's error is unknown.
TEST(Advisor, SaysWhereTooLittleLightWasFound) {
  constexpr std::array rays{1, 4};
  constexpr double unknown = std::numeric_limits<double>::infinity();
  std::vector<Measurement> measurements{{0, 1, 2, 1, unknown}, {1, 1, 2, 1, 0.5}, {0, 1, 4, 2, unknown}};
  EXPECT_THROW(shadow_ray_advice(rays, measurements), std::runtime_error);
  measurements.insert(measurements.end(), {{1, 1, 4, 2, 0.25}, {0, 1, 8, 4, 1}, {1, 1, 8, 4, 0.125}});
  EXPECT_EQ(shadow_ray_advice(rays, measurements).samples, 8);
}

TEST(Advisor, SaysWhereShadowRaysPlayNoPart) {
  const std::vector<std::string> naive{"image.width=8", "image.height=8", "render.method=naive"};
  EXPECT_THROW(advise_shadow_rays(read_scene(GLIMT_SCENES "/hexagon.toml", naive), {.seeds = 1, .spp = 2}, {}),
               std::runtime_error);
}

TEST(Advisor, MeasuresAScene) {
  const std::vector<std::string> small{"image.width=48", "image.height=48"};
  double last = 0;
  const ShadowRayAdvice advice = advise_shadow_rays(read_scene(GLIMT_SCENES "/hexagon.toml", small),
                                                    {.seeds = 2, .spp = 16, .seconds = 1e9}, [&](double share) {
                                                      EXPECT_GE(share, last);
                                                      last = share;
                                                    });
  EXPECT_EQ(advice.samples, 16);
  EXPECT_GE(advice.best, 1);
  EXPECT_LE(advice.best, most_shadow_rays);
  EXPECT_LE(advice.low, advice.high);
  EXPECT_EQ(last, 1);
}

}  // namespace
