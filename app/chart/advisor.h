#pragma once

#include <span>
#include <vector>

#include "chart/runs.h"
#include "scene/scene.h"

/// How many shadow rays pay. With M shadow rays at each diffuse hit, the error is that of the camera paths plus 1/M of
/// what one shadow ray adds. The time is that of the camera paths plus M times that of one shadow ray.
namespace glimt {

/// A rendering with M shadow rays.
struct ShadowRayRun {
  int shadow_rays = 1;
  double error = 0;    ///< relmse_scaled at a number of samples that is the same for all runs
  double seconds = 0;  ///< rendering time up to there
};

/// error(M) = path_error + ray_error / M, seconds(M) = path_seconds + ray_seconds M. No coefficient is negative.
struct ShadowRayModel {
  double path_error = 0, ray_error = 0;
  double path_seconds = 0, ray_seconds = 0;

  double error(double rays) const { return path_error + ray_error / rays; }
  double seconds(double rays) const { return path_seconds + ray_seconds * rays; }
  double efficiency(double rays) const { return 1 / (error(rays) * seconds(rays)); }
};

/// The model through two runs with different numbers of shadow rays.
ShadowRayModel shadow_ray_model(const ShadowRayRun& a, const ShadowRayRun& b);

/// The number, not rounded, where the derivative of the efficiency is 0:
/// sqrt(ray_error path_seconds / (path_error ray_seconds)). Infinite where more rays always pay.
double ideal_shadow_rays(const ShadowRayModel& model);

inline constexpr int most_shadow_rays = 64;

/// The number of shadow rays in 1..most_shadow_rays with the best efficiency.
int best_shadow_rays(const ShadowRayModel& model);

struct ShadowRayAdvice {
  ShadowRayModel model;            ///< fitted to the medians over seeds
  std::vector<ShadowRayRun> runs;  ///< the points it goes through: medians over seeds
  int samples = 0;                 ///< per pixel, of the runs
  int best = 1;
  int low = 1, high = 1;  ///< quartiles of the best over seeds
};

/// The advice from measurements of two variants, where variant i has rays[i] shadow rays. It uses the largest number of
/// samples at which every run knows its error. Throws std::runtime_error where there is none: a picture is black.
ShadowRayAdvice shadow_ray_advice(std::span<const int> rays, std::span<const Measurement> measurements);

/// Renders the scene with 1 and with 4 shadow rays in turn. Calls `report` with the share done; it may throw to stop
/// the work. Throws std::runtime_error where shadow rays play no part.
ShadowRayAdvice advise_shadow_rays(Scene scene, const Plan& plan, const std::function<void(double)>& report);

}  // namespace glimt
