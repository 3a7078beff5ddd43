#pragma once

#include <array>

#include "math/box.h"
#include "scene/scene.h"

namespace glimt {

std::vector<glm::dvec3> triangle_vertices(const Mesh& mesh, const std::array<int, 3>& triangle);
/// The same where there are many.
std::array<glm::dvec3, 3> triangle_corners(const Mesh& mesh, const std::array<int, 3>& triangle);

/// Of all vertices.
Box box_of(const Mesh& mesh);

/// True where triangles run along every edge as often one way as the other.
bool is_closed(const Mesh& mesh);

/// Cubic metres; positive where the triangles' fronts look outwards. The mesh is closed.
double signed_volume(const Mesh& mesh);

/// How often a closed mesh wraps around the point: 1 or -1 inside, by its orientation, 0 outside. The sum of the
/// triangles' signed solid angles over 4 pi (Van Oosterom and Strackee, "The solid angle of a plane triangle", 1983,
/// eq. 8).
double winding_number(const Mesh& mesh, const glm::dvec3& point);

}  // namespace glimt
