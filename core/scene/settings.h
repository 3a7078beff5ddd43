#pragma once

#include <cstdint>
#include <string_view>

namespace glimt {

/// Which estimator of the light transport integral is used.
enum class Method {
  path,   ///< next-event estimation at diffuse hits, lamps reached by chance only through specular chains
  naive,  ///< no next-event estimation: lamps are reached by chance alone
};

/// How Russian roulette chooses the probability of survival.
enum class Roulette {
  throughput,  ///< the largest component of the path's throughput, from `roulette_depth` on, for every path
  constant,    ///< 0.75 at every diffuse hit (the report); infinite variance where the reflectance is above 0.866
};

inline constexpr int max_spp = 1 << 24;

/// Everything that says how a scene is rendered, and nothing of what is in it. Declared for files, command line and
/// window in fields.cpp.
struct Settings {
  int spp = 64;         ///< samples per pixel to stop at
  double target_error = 0;  ///< relmse_estimate to stop at in place of `spp`; 0: stop at `spp`
  int shadow_rays = 1;  ///< M, shadow rays per diffuse hit
  int seed = 1;         ///< of the random numbers
  Method method = Method::path;
  Roulette roulette = Roulette::throughput;
  int roulette_depth = 3;  ///< surface hits before `throughput` roulette begins

  bool operator==(const Settings&) const = default;
};

/// The settings without where to stop: what decides the value of every sample.
inline Settings without_target(Settings settings) {
  settings.spp = Settings{}.spp;
  settings.target_error = 0;
  return settings;
}

}  // namespace glimt
