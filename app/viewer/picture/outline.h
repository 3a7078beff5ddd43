#pragma once

#include <glm/vec2.hpp>
#include <vector>

#include "scene/pick.h"
#include "scene/scene.h"

namespace glimt {

/// A piece of an object's outline in the image, pixels from the top left.
struct OutlinePiece {
  glm::dvec2 from, to;
  bool hidden = false;  ///< something else is in front of it
};

/// The outline of the object in the camera's view. For a sphere it is the circle where view rays touch it; for a
/// polygon its edges. For a mesh it is the edges between a triangle that faces the camera and one that does not, and
/// the edges of a single triangle. Empty where the camera is inside the sphere.
std::vector<OutlinePiece> outline_of(const Scene& scene, const ObjectId& object);

}  // namespace glimt
