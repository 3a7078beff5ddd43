#pragma once

#include <vector>

#include "scene/scene.h"

namespace glimt {

/// How far a triangle of a mesh is to move, metres.
struct FaceMove {
  int triangle;
  glm::dvec3 by;  ///< along its normal
};

/// Moves each vertex so that the planes of all faces around it are moved as they are to be. A closed mesh stays closed.
void move_faces(Mesh& mesh, const std::vector<FaceMove>& moves);

/// Moves triangles, with vertices of their own.
void move_apart(Mesh& mesh, const std::vector<FaceMove>& moves);

}  // namespace glimt
