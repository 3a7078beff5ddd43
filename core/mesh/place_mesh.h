#pragma once

#include <array>
#include <glm/vec3.hpp>
#include <vector>

#include "mesh/mesh_data.h"

namespace glimt {

/// Where a mesh stands: it is scaled, turned about x, then y, then z, then moved.
struct Placement {
  glm::dvec3 scale{1};
  glm::dvec3 rotate{0};     ///< degrees
  glm::dvec3 translate{0};  ///< metres

  bool operator==(const Placement&) const = default;
};

/// A mesh in world space.
struct PlacedMesh {
  std::vector<glm::dvec3> vertices;
  std::vector<std::array<int, 3>> triangles;  ///< into `vertices`, counter-clockwise from the front
  std::vector<glm::dvec3> normals;            ///< one a vertex, of length 1; empty for a mesh that is not smooth
};

/// An odd number of negative scales mirrors the mesh; its front stays its front. A smooth mesh has the file's normals,
/// and computed ones where the file has none: a vertex with several becomes several.
PlacedMesh place(const MeshData& data, const Placement& placement, bool smooth);

/// For each vertex the mean of the normals of the triangles around its place, weighted by their angles there (Thürmer
/// and Wüthrich 1998).
std::vector<glm::dvec3> smooth_normals(const std::vector<glm::dvec3>& vertices,
                                       const std::vector<std::array<int, 3>>& triangles);

}  // namespace glimt
