#pragma once

#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "chart/svg_chart.h"
#include "film/statistics.h"
#include "render/render.h"

/// Renders one picture in several ways and measures them side by side as their samples grow.
namespace glimt {

struct Variant {
  std::string name;     ///< in files: "path:sampler=sobol"
  std::string label;    ///< for people: "path, sampler sobol"
  CompiledScene scene;  ///< all variants have one picture size
};

struct Plan {
  int seeds = 5;
  int spp = 1 << 24;   ///< at most
  double seconds = 4;  ///< rendering time for each variant and seed, at most
  Execution execution{};
};

struct Measurement {
  std::size_t variant = 0;
  int seed = 0;
  int spp = 0;
  double seconds = 0;                 ///< wall-clock time of rendering
  double estimate = 0;                ///< relmse_scaled, from the two halves; infinite where unknown
  std::optional<Comparison> error{};  ///< against the reference, where there is one
  bool at_least = false;              ///< the estimate is only a lower bound: light may not have been found yet
};

/// Adds `count` samples to every pixel of the film. Returns the wall-clock time it took.
double seconds_of_pass(const CompiledScene& scene, Film& film, int count, const Execution& execution);

/// Renders every variant with plan.seeds seeds, beginning with its own, and measures after 1, 2, 4, ... samples and
/// after the last. Variants take turns at every step, so that other load on the machine slows all alike. The run with
/// the first seed decides how many samples each variant gets. `reference` may be null. Calls `report` with the share
/// done after each step.
std::vector<Measurement> measure(std::span<Variant> variants, const Plan& plan, const Image* reference,
                                 const std::function<void(double)>& report);

/// The value below which the share `q` of the values lies, interpolated. NaN where there are no values.
double quantile(std::vector<double> values, double q);

/// Medians over seeds of what a variant reached at its last sample count.
struct Outcome {
  int spp = 0;
  double seconds = 0;
  double error = 0;       ///< relmse999 against the reference, or the estimate of relmse_scaled
  double efficiency = 0;  ///< 1 / (error * seconds)
};
Outcome outcome(std::span<const Measurement> measurements, std::size_t variant);

/// Error against time: medians and quartiles over seeds. The error is relmse_scaled against the reference, with its
/// estimate as a thin line, or the estimate alone. The scene's brightness does not move the curves.
Chart error_chart(std::span<const Variant> variants, std::span<const Measurement> measurements);

/// One line for each measurement: method, seed, spp, seconds, relmse_scaled, relmse999, and the estimate of
/// relmse_scaled. Unknown values are empty.
std::string measurements_csv(std::span<const Variant> variants, std::span<const Measurement> measurements);

}  // namespace glimt
