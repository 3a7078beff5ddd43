#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <optional>

#include "scene/scene.h"

namespace glimt {

/// A camera as axes, to go from places in the image to rays and back. Image coordinates are in pixels from the top left
/// corner of the image.
struct CameraView {
  glm::dvec3 eye;                 ///< world
  glm::dvec3 right, up, forward;  ///< world, orthonormal
  double pixel = 0;               ///< size of a pixel on the plane at distance 1
  glm::dvec2 middle;              ///< of the image, pixels

  CameraView(const Camera& camera, const ImageSize& image);

  /// World direction through a place in the image; its part along `forward` is 1.
  glm::dvec3 direction(const glm::dvec2& place) const;
  /// Where in the image a world point is seen; nothing where it is not in front of the camera.
  std::optional<glm::dvec2> project(const glm::dvec3& point) const;
  /// Distance of a point along `forward`.
  double depth(const glm::dvec3& point) const;
};

}  // namespace glimt
