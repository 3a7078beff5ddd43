#pragma once

#include <array>
#include <glm/vec3.hpp>
#include <string_view>

#include "scene/scene.h"

/// How a camera moves under mouse and keys. `up` stays as it is and stays away from the direction of view.
namespace glimt {

/// What a drag over the picture does with the camera.
enum class DragView {
  automatic,  ///< turn in a closed room, orbit outside
  turn,       ///< the view, about the eye
  orbit,      ///< the camera, about the point under the mouse
};
inline constexpr std::array<std::string_view, 3> drag_view_names{"auto", "turn", "orbit"};

/// Turns the camera about a world point: by `yaw` about the up axis, then by `pitch` about its own horizontal axis;
/// radians. The pivot stays where it is in the image.
Camera orbit(const Camera& camera, const glm::dvec3& pivot, double yaw, double pitch);

/// Moves eye and look_at alike; world, metres.
Camera pan(const Camera& camera, const glm::dvec3& by);

/// Moves the eye so that it is `factor` times as far from look_at.
Camera dolly(const Camera& camera, double factor);

/// How far moved cameras stay away from surfaces, metres.
double camera_margin(const Scene& scene);

/// The scene's camera on its way to `to`, as far as it may go: it stops short of surfaces and slides along them, and it
/// stays where it is where `to` sees next to no light. A cutaway is looked at through the walls, so there it passes
/// through surfaces.
Camera approach(const Scene& scene, const Camera& to);

/// orbit() in steps small enough to follow the arc, each of which may go as far as approach() lets it.
Camera approach_orbit(Scene scene, const glm::dvec3& pivot, double yaw, double pitch);

/// The share of the camera's picture, 0..1, in which some light is seen. Takes about a thousandth of a second.
double lit_share(Scene scene);

/// A camera in the room that sees light: the one given, or from a place in the middle of the room.
Camera back_in_room(const Scene& scene, const Camera& opened);

/// Moves a sphere, but not over the eye; where the eye is in it, it stays.
void move_sphere(Scene& scene, std::size_t sphere, const glm::dvec3& by);

}  // namespace glimt
