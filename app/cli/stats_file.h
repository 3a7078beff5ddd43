#pragma once

#include <string>

#include "render/render.h"
#include "scene/scene.h"

namespace glimt {

/// What was rendered and what it cost, as JSON. It has every setting by its key (spp: the samples that were taken),
/// scene, width, height, sample_ranges (which samples: "0:64" is 64 from sample 0 on), paths, seconds,
/// paths_per_second, mean, relmse_estimate, relmse_scaled, relmse_scaled_interval, relmse_bound, flux_unseen, threads,
/// lanes, invalid, saturated and version. An unknown error is null.
std::string stats_json(const Scene& scene, const Film& film, const Execution& execution, double seconds);

}  // namespace glimt
