#pragma once

#include <glm/vec3.hpp>

#include "scene/scene.h"

/// How far points are from the surfaces of a scene. All in world space and metres.
namespace glimt {

/// To the nearest surface; infinite where there is none.
double clearance(const Scene& scene, const glm::dvec3& point);

/// Where a point comes to that heads for `to`: it keeps `margin` away from all surfaces, slides along them, and crosses
/// none, however long the way is. One that begins nearer moves off first; where there is no room for that, it keeps the
/// distance it has. A point on a surface goes straight to `to`.
glm::dvec3 slide(const Scene& scene, const glm::dvec3& from, const glm::dvec3& to, double margin);

}  // namespace glimt
