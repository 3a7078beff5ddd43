#pragma once

#include <string>
#include <vector>

#include "scene/scene.h"

namespace glimt {

/// One thing in which two scenes differ.
struct Difference {
  std::string key;       ///< which thing: "shadow_rays"
  std::string from, to;  ///< in words, for each scene: "shadow rays 4", "sobol", "clay roughness 0.3"
};

/// What differs between two scenes, except where they stop. Settings come first, in the order of the field table.
std::vector<Difference> differences(const Scene& from, const Scene& to);

}  // namespace glimt
