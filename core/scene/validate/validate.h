#pragma once

#include <string>
#include <vector>

#include "scene/scene.h"

namespace glimt {

/// One mistake in a scene.
struct Problem {
  std::string
      path;  ///< where, as a path in the file: "material.clay.roughness", "sphere[2].radius", "polygon[0].vertices"
  std::string message;  ///< what it is, and what is allowed
};

/// Every rule a scene must keep, checked in one place: ranges of all fields (fields.h), NaN, unknown materials,
/// polygons without area, far from planar or with edges that cross, mesh indices, glass on open shapes, overlapping
/// glass solids, the camera at its target, image sizes. What mend() puts right is no mistake. Empty for a scene that
/// can be rendered. The file reader adds line and column; the window shows the message.
std::vector<Problem> validate(const Scene& scene);

}  // namespace glimt
