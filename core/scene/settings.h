#pragma once

#include <cstdint>
#include <string_view>

namespace glimt {

/// Named sets of the settings below. A method is where they begin; each can then be set on its own.
enum class Method {
  path,    ///< the best measured
  naive,   ///< lamps are reached by chance alone
  report,  ///< what the course report did, its missing caustics included
};

/// How next-event estimation chooses points of lamps.
enum class LightSampling {
  none,         ///< not at all: lamps are reached by chance
  area,         ///< uniform by area: the report's eq. 15
  solid_angle,  ///< uniform by solid angle; with MIS, lamps of several triangles by area
  automatic,    ///< flat lamps by area and spheres by solid angle; near to what they light flat lamps too, with MIS
};

/// Whether light sampling and BSDF sampling share the lamps that both can reach, by the balance heuristic (Veach 1997).
enum class Mis { off, on };

/// How Russian roulette chooses the probability of survival.
enum class Roulette {
  throughput,  ///< the largest component of the path's throughput over `roulette_below`, from `roulette_depth` on
  constant,    ///< 0.75 at every diffuse hit (the report); infinite variance where the reflectance is above 0.866
};

inline constexpr int max_spp = 1 << 24;

/// Where the random numbers come from.
enum class Sampler {
  independent,  ///< hashed
  stratified,   ///< pairs of numbers in 4x4 strata, each taken once in 16 samples
  lattice,      ///< randomly shifted points of a lattice
  sobol,        ///< pairs of an Owen-scrambled Sobol sequence, shuffled for each pair (padded)
  centres,  ///< independent, but camera rays through the centres of a pixel's sub-pixels (the report's multisampling)
};

/// Light that reaches a diffuse surface by way of mirrors or glass.
enum class Caustics { off, on, only };

/// Whether caustics that are seen in mirrors and through glass are connected to lamps over single spheres.
enum class SphereConnections { off, on };

/// Whether the four pixels of a square share the ends of their paths (kernel/sharing/tail_sharing.h).
enum class PathSharing { off, on };

/// Everything that says how a scene is rendered, and nothing of what is in it. Declared for files, command line and
/// window in fields.cpp.
struct Settings {
  int spp = 64;                  ///< samples per pixel to stop at
  double target_error = 0;       ///< relmse_scaled to stop at in place of `spp`; 0: stop at `spp`
  int shadow_rays = 1;           ///< M, shadow rays per diffuse hit
  int seed = 1;                  ///< of the random numbers
  Method method = Method::path;  ///< what the settings below began from
  LightSampling light_sampling = LightSampling::automatic;
  Mis mis = Mis::off;
  Roulette roulette = Roulette::throughput;
  int roulette_depth = 3;        ///< surface hits before `throughput` roulette begins
  double roulette_below = 0.25;  ///< throughput, of 0..1, below which it is played
  Sampler sampler = Sampler::lattice;
  Caustics caustics = Caustics::on;
  double light_paths = 0.3;  ///< from lamps to mirrors and glass, for each path from the camera; 0: no light tracing
  SphereConnections sphere_connections = SphereConnections::on;
  PathSharing path_sharing = PathSharing::on;
  int max_depth = 0;  ///< surfaces that a path may meet, its lamp included; 0: no limit

  bool operator==(const Settings&) const = default;
};

/// Takes all settings from `light_sampling` on from the method.
void set_method(Settings& settings, Method method);

/// The settings without where to stop: what decides the value of every sample. Sub-pixels are as many as the samples.
inline Settings without_target(Settings settings) {
  if (settings.sampler != Sampler::centres) settings.spp = Settings{}.spp;
  settings.target_error = 0;
  return settings;
}

}  // namespace glimt
