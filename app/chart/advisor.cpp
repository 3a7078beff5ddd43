#include "chart/advisor.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>
#include <stdexcept>

namespace glimt {
namespace {

/// intercept + slope x.
struct Line {
  double intercept, slope;
};

/// The line through two points, with neither part below 0. Where noise makes the slope negative, the line is the mean.
/// Where it makes the intercept negative, the line goes through the origin and the mean point.
Line fitted(double x0, double y0, double x1, double y1) {
  const double slope = (y1 - y0) / (x1 - x0), intercept = y0 - slope * x0;
  if (slope < 0) return {(y0 + y1) / 2, 0};
  if (intercept < 0) return {0, (y0 + y1) / (x0 + x1)};
  return {intercept, slope};
}

}  // namespace

ShadowRayModel shadow_ray_model(const ShadowRayRun& a, const ShadowRayRun& b) {
  const double rays_a = a.shadow_rays, rays_b = b.shadow_rays;
  const Line error = fitted(1 / rays_a, a.error, 1 / rays_b, b.error);
  const Line seconds = fitted(rays_a, a.seconds, rays_b, b.seconds);
  return {error.intercept, error.slope, seconds.intercept, seconds.slope};
}

double ideal_shadow_rays(const ShadowRayModel& m) {
  if (m.ray_error * m.path_seconds == 0) return 0;
  return std::sqrt(m.ray_error * m.path_seconds / (m.path_error * m.ray_seconds));
}

int best_shadow_rays(const ShadowRayModel& model) {
  // Error times time is convex in M, so the best whole number is next to the ideal one.
  const double ideal = std::clamp(ideal_shadow_rays(model), 1.0, 1.0 * most_shadow_rays);
  const double below = std::floor(ideal), above = std::ceil(ideal);
  return static_cast<int>(model.efficiency(above) > model.efficiency(below) ? above : below);
}

ShadowRayAdvice shadow_ray_advice(std::span<const int> rays, std::span<const Measurement> measurements) {
  std::set<std::pair<std::size_t, int>> runs;  // variant and seed
  std::map<int, std::size_t> known;            // number of runs that know their error, by samples
  for (const Measurement& m : measurements) {
    runs.emplace(m.variant, m.seed);
    if (std::isfinite(m.estimate)) ++known[m.spp];
  }
  ShadowRayAdvice advice;
  for (const auto& [spp, count] : known)
    if (count == runs.size()) advice.samples = spp;
  if (advice.samples == 0) throw std::runtime_error("Too little light was found to tell how many shadow rays pay");

  std::map<int, std::array<ShadowRayRun, 2>> by_seed;
  std::array<std::vector<double>, 2> errors, seconds;
  for (const Measurement& m : measurements) {
    if (m.spp != advice.samples) continue;
    by_seed[m.seed].at(m.variant) = {rays[m.variant], m.estimate, m.seconds};
    errors.at(m.variant).push_back(m.estimate);
    seconds.at(m.variant).push_back(m.seconds);
  }
  for (std::size_t i = 0; i < rays.size(); ++i)
    advice.runs.push_back({rays[i], quantile(errors.at(i), 0.5), quantile(seconds.at(i), 0.5)});
  advice.model = shadow_ray_model(advice.runs.front(), advice.runs.back());
  advice.best = best_shadow_rays(advice.model);

  std::vector<double> bests;
  bests.reserve(by_seed.size());
  for (const auto& [seed, both] : by_seed) bests.push_back(best_shadow_rays(shadow_ray_model(both[0], both[1])));
  advice.low = static_cast<int>(std::floor(quantile(bests, 0.25)));
  advice.high = static_cast<int>(std::ceil(quantile(bests, 0.75)));
  return advice;
}

ShadowRayAdvice advise_shadow_rays(Scene scene, const Plan& plan, const std::function<void(double)>& report) {
  if (scene.render.light_sampling == LightSampling::none)
    throw std::runtime_error("Lamps are not sampled, so shadow rays play no part");
  constexpr std::array rays{1, 4};
  std::vector<Variant> variants;
  for (const int count : rays) {
    scene.render.shadow_rays = count;
    variants.push_back({std::to_string(count), std::to_string(count), compile(scene)});
  }
  return shadow_ray_advice(rays, measure(variants, plan, nullptr, report));
}

}  // namespace glimt
