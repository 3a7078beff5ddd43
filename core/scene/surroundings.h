#pragma once

#include <glm/vec3.hpp>
#include <optional>

#include "math/box.h"
#include "scene/scene.h"

/// Where a point is in a scene: in a closed room or in the open. All in world space.
namespace glimt {

/// Around all objects.
Box box_of(const Scene& scene);
/// Diagonal of that box, metres.
double size_of(const Scene& scene);

/// Whether surfaces that are not glass hide the open in all of some directions that are spread evenly.
bool is_enclosed(const Scene& scene, const glm::dvec3& point);

/// A point between the surfaces of a closed room, of several the one nearest to `eye`; nothing where the scene has no
/// closed room.
std::optional<glm::dvec3> place_in_room(const Scene& scene, const glm::dvec3& eye);

}  // namespace glimt
