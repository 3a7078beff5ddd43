#pragma once

#include <string>

#include "render/render.h"
#include "scene/scene.h"

namespace glimt {

/// What was rendered and what it cost, as JSON. It has every setting by its key (spp: the samples that were taken),
/// scene, width, height, sample_ranges (which samples: "0:64" is 64 from sample 0 on), paths, seconds,
/// paths_per_second, mean, relmse_estimate (null where unknown), threads and lanes of each
/// process, ranks (how many processes), invalid, saturated and version.
std::string stats_json(const Scene& scene, const Film& film, const Execution& execution, int ranks, double seconds);

}  // namespace glimt
