#pragma once

#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "chart/svg_chart.h"
#include "film/statistics.h"
#include "render/render.h"

/// Renderings of one picture in several ways, measured side by side as they grow.
namespace glimt {

struct Variant {
  std::string name;     ///< in files: "path:sampler=sobol"
  std::string label;    ///< for people: "path, sampler sobol"
  CompiledScene scene;  ///< all of one size
};

struct Plan {
  int seeds = 5;
  int spp = 1 << 24;   ///< at most
  double seconds = 4;  ///< of rendering for each variant and seed, at most
  Execution execution{};
};

struct Measurement {
  std::size_t variant = 0;
  int seed = 0;
  int spp = 0;
  double seconds = 0;                 ///< wall-clock, of rendering
  double estimate = 0;                ///< relmse_scaled, from the two halves; infinite where unknown
  std::optional<Comparison> error{};  ///< against the reference, where there is one
  bool at_least = false;              ///< the estimate is a bound: light may not have been found yet
};

/// Adds `count` samples to every pixel of the film. Returns the wall-clock time it took.
double seconds_of_pass(const CompiledScene& scene, Film& film, int count, const Execution& execution);

/// Renders every variant with plan.seeds seeds from its own on, and measures after 1, 2, 4, ... samples and after the
/// last. Variants take turns at every step, so that what else the machine does hits all alike; how far each goes is
/// decided with the first seed. `reference` may be null. `report` is called after each step with the share done.
std::vector<Measurement> measure(std::span<Variant> variants, const Plan& plan, const Image* reference,
                                 const std::function<void(double)>& report);

/// Value below which the share `q` of the values lies, interpolated. NaN for none.
double quantile(std::vector<double> values, double q);

/// The median over seeds of what a variant reached at its last sample count.
struct Outcome {
  int spp = 0;
  double seconds = 0;
  double error = 0;       ///< relmse999 against the reference, or the estimate of relmse_scaled
  double efficiency = 0;  ///< 1 / (error * seconds)
};
Outcome outcome(std::span<const Measurement> measurements, std::size_t variant);

/// Error against time: medians and quartiles over seeds. The error is relmse_scaled against the reference with its
/// estimate as thin line, or the estimate alone. The brightness of the scene moves no curve.
Chart error_chart(std::span<const Variant> variants, std::span<const Measurement> measurements);

/// One line for each measurement: method, seed, spp, seconds, relmse_scaled, relmse999, and relmse_scaled as estimated;
/// unknown ones empty.
std::string measurements_csv(std::span<const Variant> variants, std::span<const Measurement> measurements);

}  // namespace glimt
