#pragma once

#include <array>
#include <cstdint>

#include "compile/triangle_tree.h"

/// One ray through a tree of triangles. Eight boxes or triangles are tested side by side, whatever the number of paths
/// that are traced so, and so a path has one value at every lane width.
///
/// No ray passes between two triangles that share an edge (Woop, Benthin, Wald, "Watertight ray/triangle intersection",
/// 2013), and boxes are wider by what the arithmetic may be off.
namespace glimt {

/// In compiled space; the direction is of unit length.
struct TreeRay {
  std::array<float, 3> origin, direction;
  std::int32_t from;  ///< place of the triangle that it starts on, which it does not meet; negative: on none
};

struct TreeHit {
  float t;             ///< metres along the ray
  std::int32_t place;  ///< of the triangle; -1: none
};

/// The first triangle nearer than `farthest`. Of two at one distance it is the one that comes first in the scene.
TreeHit first_in_tree(const TriangleTree& tree, const TreeRay& ray, float farthest);

/// Whether there is a triangle nearer than `distance`, but for those with places from `first` to `last`.
bool hidden_in_tree(const TriangleTree& tree, const TreeRay& ray, float distance, std::int32_t first,
                    std::int32_t last);

}  // namespace glimt
