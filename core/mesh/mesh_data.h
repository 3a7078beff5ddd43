#pragma once

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <string>
#include <vector>

namespace glimt {

/// Triangles in a row that name one material.
struct MeshGroup {
  std::string material;  ///< as the file calls it; empty where it names none
  int first = 0;
  int count = 0;
};

/// What a mesh file holds, in its own coordinates. All indices are in range and all coordinates finite.
struct MeshData {
  std::vector<glm::dvec3> vertices;
  std::vector<std::array<int, 3>> triangles;  ///< into `vertices`, counter-clockwise from the front
  std::vector<glm::dvec3> normals;            ///< of length 1; a zero vector where the file's has no length
  /// Into `normals`, -1 for a corner without one. Empty: a corner's normal has its vertex's place, if there are
  /// normals.
  std::vector<std::array<int, 3>> normal_corners;
  std::vector<MeshGroup> groups;  ///< of all triangles, in their order; a material in one group only
  std::vector<std::string> told;  ///< what of the file is left out, for people
  std::uint64_t hash = 0;         ///< of all above but what is told
};

}  // namespace glimt
