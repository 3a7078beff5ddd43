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
/// degenerate, non-planar and non-convex polygons, mesh indices, glass on open shapes, overlapping glass solids, the
/// camera at its target, image sizes. Empty for a scene that can be rendered. The file reader adds line and column; the
/// window shows the message.
std::vector<Problem> validate(const Scene& scene);

/// True where every edge of the mesh is shared by exactly two triangles that run along it in opposite directions.
bool is_closed(const Mesh& mesh);

}  // namespace glimt
