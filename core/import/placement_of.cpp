#include "import/placement_of.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>
#include <glm/trigonometric.hpp>

namespace glimt {

std::optional<Placement> placement_of(const glm::dmat4& matrix) {
  glm::dmat3 m(matrix);
  Placement placement;
  for (int i = 0; i < 3; ++i) {
    placement.scale[i] = length(m[i]);
    if (!(placement.scale[i] > 0)) return std::nullopt;
  }
  // Equal lengths stay equal, so that a file has one number.
  const double largest = std::max({placement.scale.x, placement.scale.y, placement.scale.z});
  for (int i = 0; i < 3; ++i)
    if (std::abs(placement.scale[i] - placement.scale.x) < 1e-12 * largest) placement.scale[i] = placement.scale.x;
  if (determinant(m) < 0) placement.scale = -placement.scale;
  for (int i = 0; i < 3; ++i) m[i] = m[i] / placement.scale[i];
  for (int i = 0; i < 3; ++i)
    if (std::abs(dot(m[i], m[(i + 1) % 3])) > 1e-9) return std::nullopt;
  // m = Rz Ry Rx; m[column][row].
  const double sin_y = -m[0][2];
  const double y = std::atan2(sin_y, std::hypot(m[0][0], m[0][1]));
  const bool locked = std::hypot(m[0][0], m[0][1]) < 1e-9;
  const double x = locked ? std::atan2(-m[2][1], m[1][1]) : std::atan2(m[1][2], m[2][2]);
  const double z = locked ? 0 : std::atan2(m[0][1], m[0][0]);
  placement.rotate = glm::degrees(glm::dvec3{x, y, z}) + 0.0;
  placement.translate = glm::dvec3(matrix[3]);
  return placement;
}

}  // namespace glimt
