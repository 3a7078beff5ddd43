#pragma once

#include <array>
#include <glm/vec3.hpp>
#include <string_view>

#include "scene/scene.h"

/// How mouse and keys move a camera. `up` never changes, and the view never turns all the way towards it.
namespace glimt {

/// What a drag over the picture does with the camera.
enum class DragView {
  automatic,  ///< turn where the eye is in a closed room, else orbit
  turn,       ///< the view turns about the eye
  orbit,      ///< the camera moves about the point under the mouse
};
inline constexpr std::array<std::string_view, 3> drag_view_names{"auto", "turn", "orbit"};

/// Turns the camera about the world point `pivot`: by `pitch` about its own horizontal axis, then by `yaw` about the up
/// axis; radians. The pivot stays where it is in the image.
Camera orbit(const Camera& camera, const glm::dvec3& pivot, double yaw, double pitch);

/// Moves eye and look_at by the same vector; world space, metres.
Camera pan(const Camera& camera, const glm::dvec3& by);

/// Moves the eye to `factor` times its distance from look_at.
Camera dolly(const Camera& camera, double factor);

/// The distance that moved cameras keep from surfaces, metres.
double camera_margin(const Scene& scene);

/// Moves the scene's camera towards `to` as far as it may go. It stops short of surfaces and slides along them. It does
/// not move at all where it would see next to no light, and less than now. A cutaway's camera looks through walls, so
/// it passes surfaces.
Camera approach(const Scene& scene, const Camera& to);

/// orbit() in steps small enough to follow the arc; each goes as far as approach() lets it.
Camera approach_orbit(Scene scene, const glm::dvec3& pivot, double yaw, double pitch);

/// The share of the camera's picture, 0..1, in which some light is seen. Takes about a thousandth of a second.
double lit_share(Scene scene);

/// A camera in the room that sees light: `opened`, or the scene's camera moved to the middle of the room.
Camera back_in_room(const Scene& scene, const Camera& opened);

/// Moves a sphere but not its surface across the eye: an eye outside stays outside, an eye inside stays inside.
void move_sphere(Scene& scene, std::size_t sphere, const glm::dvec3& by);

}  // namespace glimt
