#include "viewer/widgets/colour.h"

#include <cmath>

namespace glimt {

double srgb_from_linear(double linear) {
  return linear <= 0.0031308 ? 12.92 * linear : 1.055 * std::pow(linear, 1 / 2.4) - 0.055;
}

double linear_from_srgb(double srgb) { return srgb <= 0.04045 ? srgb / 12.92 : std::pow((srgb + 0.055) / 1.055, 2.4); }

glm::dvec3 srgb_from_linear(const glm::dvec3& linear) {
  return {srgb_from_linear(linear.x), srgb_from_linear(linear.y), srgb_from_linear(linear.z)};
}

glm::dvec3 linear_from_srgb(const glm::dvec3& srgb) {
  return {linear_from_srgb(srgb.x), linear_from_srgb(srgb.y), linear_from_srgb(srgb.z)};
}

}  // namespace glimt
