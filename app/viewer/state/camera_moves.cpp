#include "viewer/state/camera_moves.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <numbers>

namespace glimt {
namespace {

using glm::dvec3;

/// The view is at least so far from straight up and down, radians.
constexpr double from_pole = 0.05;
constexpr double nearest = 1e-3;  ///< distance of the eye from look_at, metres

}  // namespace

Camera orbit(const Camera& camera, const dvec3& pivot, double yaw, double pitch) {
  const dvec3 forward = normalize(camera.look_at - camera.eye), up = normalize(camera.up);
  const dvec3 right = normalize(cross(forward, up));
  const double from_up = std::acos(std::clamp(dot(forward, up), -1.0, 1.0));
  // Where the file's camera looks steeper than that already, it may come back but go no further.
  const double lowest = std::min(from_pole, from_up), highest = std::max(std::numbers::pi - from_pole, from_up);
  const double allowed = from_up - std::clamp(from_up - pitch, lowest, highest);
  const glm::dquat turn = glm::angleAxis(yaw, up) * glm::angleAxis(allowed, right);
  Camera turned = camera;
  turned.eye = pivot + turn * (camera.eye - pivot);
  turned.look_at = turned.eye + turn * (camera.look_at - camera.eye);
  return turned;
}

Camera pan(const Camera& camera, const dvec3& by) {
  Camera moved = camera;
  moved.eye += by;
  moved.look_at += by;
  return moved;
}

Camera dolly(const Camera& camera, double factor) {
  const dvec3 back = camera.eye - camera.look_at;
  Camera moved = camera;
  moved.eye = camera.look_at + back * std::max(factor, nearest / length(back));
  return moved;
}

}  // namespace glimt
