#pragma once

#include "scene/scene.h"

/// Whether two solids share space without one of them holding the other. Solids that touch do not overlap: depths below
/// `touch_tolerance` of the smaller solid's size count as touching. Solids that coincide do overlap.
namespace glimt {

inline constexpr double touch_tolerance = 1e-7;

bool overlap(const Sphere& a, const Sphere& b);

/// The mesh is closed and its triangles have areas.
bool overlap(const Sphere& sphere, const Mesh& mesh);

/// The meshes are closed and their triangles have areas. For n triangles in both and k of them in touch with the other
/// mesh: time O(n sqrt(n) + k n) for evenly sized triangles.
bool overlap(const Mesh& a, const Mesh& b);

}  // namespace glimt
