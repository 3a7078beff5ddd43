#pragma once

#include <glm/vec3.hpp>

namespace glimt {

/// Linear values 0..1 to sRGB 0..1 (IEC 61966-2-1) and back, for colour pickers.
double srgb_from_linear(double linear);
double linear_from_srgb(double srgb);
glm::dvec3 srgb_from_linear(const glm::dvec3& linear);
glm::dvec3 linear_from_srgb(const glm::dvec3& srgb);

}  // namespace glimt
