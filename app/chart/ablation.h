#pragma once

#include <functional>
#include <string>
#include <vector>

#include "chart/runs.h"
#include "scene/scene.h"

/// What each piece of a model costs and buys on a scene: renderings that each leave out or exchange one.
namespace glimt {

/// The scene with one piece changed.
struct Piece {
  std::string name;    ///< "max depth 4"
  bool model = false;  ///< it is part of what is simulated; else of how, and the image should stay the same
  Scene scene;
};

/// All pieces that the scene has: rough materials, exact Fresnel, and settings with the values worth trying.
std::vector<Piece> pieces_of(const Scene& scene);

/// A piece against the scene as it is, at equal sample counts with equal seeds. Medians over seeds, except the
/// difference, which is a mean.
struct Ablation {
  double time = 1;              ///< over the time of the scene as it is
  double noise = 1;             ///< estimated relmse_scaled over that of the scene as it is
  double efficiency = 1;        ///< 1 / (noise * time)
  double efficiency_low = 1;    ///< lower quartile
  double efficiency_high = 1;   ///< upper quartile
  double difference = 0;        ///< relmse_scaled between the images without noise; below 0 by chance alone
  double difference_error = 0;  ///< its standard error over seeds
  double mean = 1;              ///< radiance over that of the scene as it is
};

/// relmse_scaled between two films' expected images: mean of (a0 - b0)(a1 - b1) times b's relative_weights over pixels
/// and channels, a0 and a1 the halves' pictures of a. Halves are independent, so noise averages out.
double error_of_difference(const Film& a, const Film& b);

/// Renders the scene and all pieces in turn to plan.spp samples with plan.seeds seeds. `report` is called with the
/// share done.
std::vector<Ablation> ablate(const Scene& scene, const std::vector<Piece>& pieces, const Plan& plan,
                             const std::function<void(double)>& report);

/// Images that differ by less are taken to be the same: 1 % root mean square.
inline constexpr double visible_difference = 1e-4;

/// In a few words: "needed", "not needed here", "worse", ...
std::string verdict(const Piece& piece, const Ablation& ablation);

}  // namespace glimt
