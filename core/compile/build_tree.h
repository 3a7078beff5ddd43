#pragma once

#include <glm/vec3.hpp>
#include <memory>
#include <vector>

#include "compile/triangle_tree.h"
#include "scene/scene.h"

namespace glimt {

/// The triangles of one object, in world space.
struct TreePart {
  Shared<std::vector<glm::dvec3>> vertices;
  Shared<std::vector<std::array<int, 3>>> triangles;
  Shared<std::vector<glm::dvec3>> normals;  ///< as in a mesh
  bool smooth = false;
  bool inside_out = false;  ///< the fronts are the backs

  bool operator==(const TreePart&) const = default;
};

/// The tree of all parts, whose space begins at `origin`. The last one is kept, so that the same geometry in the same
/// place has no new one built.
std::shared_ptr<const TriangleTree> tree_of(const std::vector<TreePart>& parts, const glm::dvec3& origin);

}  // namespace glimt
