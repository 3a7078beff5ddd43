#pragma once

#include <string>
#include <vector>

#include "scene/scene.h"

/// Scenes as people have them become scenes as the compiler wants them: flat convex polygons, and meshes whose
/// triangles have areas and whose vertices are shared.
namespace glimt {

struct Mended {
  /// Spheres and meshes are at their places; a polygon in pieces is several of its name. A mesh of several materials is
  /// several of its name, which but for the first come last.
  Scene scene;
  std::vector<std::string> told;  ///< what was mended, for people: a kind each, with its count and its first place
};

/// The scene has no mistakes (validate.h), except that glass may be open or overlap.
Mended mend(const Scene& scene);

/// Whether the corners are on one line.
bool has_no_area(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c);

}  // namespace glimt
