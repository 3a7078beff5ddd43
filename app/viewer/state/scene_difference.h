#pragma once

#include <string>
#include <vector>

#include "scene/scene.h"

namespace glimt {

/// One thing that two scenes do not share.
struct Difference {
  std::string key;       ///< which thing: "shadow_rays"
  std::string from, to;  ///< in words, in either: "shadow rays 4", "sobol", "clay roughness 0.3"
};

/// What differs between two scenes but where they stop: settings first, in the order of the field table.
std::vector<Difference> differences(const Scene& from, const Scene& to);

}  // namespace glimt
