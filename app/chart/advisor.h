#pragma once

#include <span>
#include <vector>

#include "chart/runs.h"
#include "scene/scene.h"

/// How many shadow rays pay. With M of them at each diffuse hit, noise is that of the camera's paths and a share 1/M of
/// what one shadow ray adds, and time that of the paths and M times that of a shadow ray.
namespace glimt {

/// A rendering with M shadow rays.
struct ShadowRayRun {
  int shadow_rays = 1;
  double error = 0;    ///< relmse_scaled at some number of samples, the same for all runs
  double seconds = 0;  ///< up to there
};

/// error(M) = path_error + ray_error / M, seconds(M) = path_seconds + ray_seconds M. None is negative.
struct ShadowRayModel {
  double path_error = 0, ray_error = 0;
  double path_seconds = 0, ray_seconds = 0;

  double error(double rays) const { return path_error + ray_error / rays; }
  double seconds(double rays) const { return path_seconds + ray_seconds * rays; }
  double efficiency(double rays) const { return 1 / (error(rays) * seconds(rays)); }
};

/// The model through two runs with different numbers of shadow rays.
ShadowRayModel shadow_ray_model(const ShadowRayRun& a, const ShadowRayRun& b);

/// Where the derivative of the efficiency is 0: sqrt(ray_error path_seconds / (path_error ray_seconds)); infinite where
/// more always pay.
double ideal_shadow_rays(const ShadowRayModel& model);

inline constexpr int most_shadow_rays = 64;

/// The number 1..most_shadow_rays with the best efficiency.
int best_shadow_rays(const ShadowRayModel& model);

struct ShadowRayAdvice {
  ShadowRayModel model;            ///< of the medians over seeds
  std::vector<ShadowRayRun> runs;  ///< what it goes through: medians over seeds
  int samples = 0;                 ///< per pixel, of the runs
  int best = 1;
  int low = 1, high = 1;  ///< quartiles of the best over seeds
};

/// The advice of measurements whose variant i has rays[i] shadow rays, two variants: at the largest number of samples
/// where all know their error. Throws std::runtime_error where there is none: a picture is black.
ShadowRayAdvice shadow_ray_advice(std::span<const int> rays, std::span<const Measurement> measurements);

/// Renders the scene with 1 and with 4 shadow rays in turn. `report` is called with the share done, and may throw to
/// end it. Throws std::runtime_error where shadow rays play no part.
ShadowRayAdvice advise_shadow_rays(Scene scene, const Plan& plan, const std::function<void(double)>& report);

}  // namespace glimt
