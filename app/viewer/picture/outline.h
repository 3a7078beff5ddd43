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

/// What surrounds the object in the camera's view: a sphere's circle of tangents, a polygon's edges, a mesh's edges
/// between triangles that face the camera and ones that do not. Empty where the camera is inside a sphere.
std::vector<OutlinePiece> outline_of(const Scene& scene, const ObjectId& object);

}  // namespace glimt
