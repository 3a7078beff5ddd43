#pragma once

#include <functional>
#include <string>
#include <vector>

#include "chart/runs.h"
#include "scene/scene.h"

/// What each piece of a model costs and buys on a scene. Each rendering leaves out or replaces one piece.
namespace glimt {

/// The scene with one piece changed.
struct Piece {
  std::string name;    ///< "max depth 4"
  bool model = false;  ///< it changes what is simulated; otherwise only how, and the image should stay the same
  Scene scene;
};

/// All pieces worth trying on the scene: other choices in its materials (such as the Fresnel formula), 0 in place of
/// their numbers (such as roughness), and other values of the settings.
std::vector<Piece> pieces_of(const Scene& scene);

/// The scene with one piece changed, compared with the scene as it is, at equal sample counts and with equal seeds.
/// Values are medians over seeds; the difference is a mean.
struct Ablation {
  double time = 1;              ///< divided by the time of the scene as it is
  double noise = 1;             ///< estimated relmse_scaled divided by that of the scene as it is
  double efficiency = 1;        ///< 1 / (noise * time)
  double efficiency_low = 1;    ///< lower quartile
  double efficiency_high = 1;   ///< upper quartile
  double difference = 0;        ///< estimated relmse_scaled between the noise-free images; noise may take it below 0
  double difference_error = 0;  ///< its standard error over seeds
  double mean = 1;              ///< mean radiance divided by that of the scene as it is
};

/// Estimates relmse_scaled between the expected images of two films: the mean over pixels and channels of
/// (a0 - b0)(a1 - b1) times b's relative_weights. a0 and a1 are the pictures of a's halves, b0 and b1 those of b. The
/// halves are independent, so noise averages out.
double error_of_difference(const Film& a, const Film& b);

/// Renders the scene and each piece in turn, to plan.spp samples with plan.seeds seeds. Calls `report` with the share
/// done.
std::vector<Ablation> ablate(const Scene& scene, const std::vector<Piece>& pieces, const Plan& plan,
                             const std::function<void(double)>& report);

/// relmse_scaled below which two images count as the same: 1 % root mean square.
inline constexpr double visible_difference = 1e-4;

/// In a few words: "needed", "not needed here", "worse", ...
std::string verdict(const Piece& piece, const Ablation& ablation);

}  // namespace glimt
