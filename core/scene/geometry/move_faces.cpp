#include "scene/geometry/move_faces.h"

#include <algorithm>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include "scene/geometry/mesh_measures.h"
#include "scene/geometry/room.h"

namespace glimt {

using glm::dvec3;

void move_faces(Mesh& mesh, const std::vector<FaceMove>& moves) {
  /// n.x = move for the way x of a vertex.
  struct Constraint {
    dvec3 normal;
    double move;
  };
  std::vector<dvec3> by(mesh.triangles.size(), dvec3{0});
  std::vector<std::vector<Constraint>> constraints(mesh.vertices.size());
  std::vector<bool> touched(mesh.vertices.size());
  for (const FaceMove& move : moves) {
    const auto t = static_cast<std::size_t>(move.triangle);
    by[t] = move.by;
    for (const int v : mesh.triangles[t]) touched[static_cast<std::size_t>(v)] = true;
  }
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const auto& corners = mesh.triangles[t];
    if (std::ranges::none_of(corners, [&](int v) { return touched[static_cast<std::size_t>(v)]; })) continue;
    const dvec3 n = plane_of(triangle_vertices(mesh, corners)).n;
    for (const int v : corners) {
      auto& own = constraints[static_cast<std::size_t>(v)];
      if (std::ranges::none_of(own, [&](const Constraint& c) { return dot(c.normal, n) > 1 - 1e-10; }))
        own.push_back({n, dot(n, by[t])});
    }
  }
  std::vector<dvec3>& vertices = mesh.vertices.edit();
  for (std::size_t v = 0; v < vertices.size(); ++v) {
    if (!touched[v]) continue;
    // Least squares; the term without a constraint keeps a vertex from sliding where it is free to.
    glm::dmat3 squares(1e-9);
    dvec3 sum{0};
    for (const Constraint& c : constraints[v]) {
      squares += outerProduct(c.normal, c.normal);
      sum += c.normal * c.move;
    }
    vertices[v] += inverse(squares) * sum;
  }
}

void move_apart(Mesh& mesh, const std::vector<FaceMove>& moves) {
  if (moves.empty()) return;
  std::vector<dvec3>& vertices = mesh.vertices.edit();
  std::vector<std::array<int, 3>>& triangles = mesh.triangles.edit();
  for (const FaceMove& move : moves)
    for (int& v : triangles[static_cast<std::size_t>(move.triangle)]) {
      vertices.push_back(vertices[static_cast<std::size_t>(v)] + move.by);
      v = static_cast<int>(vertices.size()) - 1;
    }
}

}  // namespace glimt
