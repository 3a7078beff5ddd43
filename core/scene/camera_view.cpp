#include "scene/camera_view.h"

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

namespace glimt {

CameraView::CameraView(const Camera& camera, const ImageSize& image)
    : eye(camera.eye),
      forward(normalize(camera.look_at - camera.eye)),
      pixel(2 * std::tan(glm::radians(camera.fov_y) / 2) / image.height),
      middle(image.width / 2.0, image.height / 2.0) {
  right = normalize(cross(forward, camera.up));
  up = cross(right, forward);
}

glm::dvec3 CameraView::direction(const glm::dvec2& place) const {
  return forward + right * (pixel * (place.x - middle.x)) - up * (pixel * (place.y - middle.y));
}

std::optional<glm::dvec2> CameraView::project(const glm::dvec3& point) const {
  const double distance = depth(point);
  if (!(distance > 0)) return std::nullopt;
  const glm::dvec3 at = point - eye;
  return middle + glm::dvec2(dot(at, right), -dot(at, up)) / (distance * pixel);
}

double CameraView::depth(const glm::dvec3& point) const { return dot(point - eye, forward); }

}  // namespace glimt
