#pragma once

#include <glm/vec3.hpp>

#include "scene/scene.h"

/// How a camera moves under the mouse. `up` stays as it is and stays away from the direction of view.
namespace glimt {

/// Turns the camera about a world point: by `yaw` about the up axis, then by `pitch` about its own horizontal axis;
/// radians. The pivot stays where it is in the image.
Camera orbit(const Camera& camera, const glm::dvec3& pivot, double yaw, double pitch);

/// Moves eye and look_at alike; world, metres.
Camera pan(const Camera& camera, const glm::dvec3& by);

/// Moves the eye so that it is `factor` times as far from look_at.
Camera dolly(const Camera& camera, double factor);

}  // namespace glimt
