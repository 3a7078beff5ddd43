#pragma once

#include <array>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

namespace glimt {

/// Outlines that are not convex may have so many corners.
inline constexpr std::size_t most_corners = 1024;

/// A polygon with four corners or more, by the places of its triangles' corners, with the polygon's winding. It need
/// not be convex or quite flat. Empty where it is not convex and has more than `most_corners`.
std::vector<std::array<std::size_t, 3>> triangulate(std::span<const glm::dvec3> outline);

}  // namespace glimt
