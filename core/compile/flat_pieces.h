#pragma once

#include <map>
#include <set>
#include <utility>

#include "compile/reach.h"
#include "math/box.h"

namespace glimt {

/// A polygon or a triangle of a mesh.
struct FlatPiece {
  int object;       ///< polygons by their index, then meshes
  int triangle;     ///< of a mesh, else -1
  HalfSpace plane;  ///< n to the front
  double size;      ///< of what is around, metres
};

/// Whether unit vectors are parallel, as far as it matters in a scene.
bool same_direction(const glm::dvec3& a, const glm::dvec3& b);

/// Whether every vertex is in the plane.
bool lies_in(const std::vector<glm::dvec3>& outline, const HalfSpace& plane, double tolerance);

/// The polygons and triangles in reach that the room's walls do not hide, and which of them coincide; without those of
/// large meshes.
class FlatPieces {
 public:
  FlatPieces(const Scene& scene, const Reach& reach);

  int count() const { return static_cast<int>(pieces_.size()); }
  const FlatPiece& operator[](int i) const { return pieces_[static_cast<std::size_t>(i)]; }
  std::vector<glm::dvec3> outline(const FlatPiece& piece) const;

  // Objects by their number.
  bool is_mesh(int object) const { return object >= polygons_; }
  std::size_t mesh_index(int object) const { return static_cast<std::size_t>(object - polygons_); }
  const Polygon& polygon(int object) const { return scene_.polygons[static_cast<std::size_t>(object)]; }
  const Mesh& mesh(int object) const { return scene_.meshes[mesh_index(object)]; }
  const std::string& material(int object) const;
  /// In quotes, or its kind and index.
  std::string called(int object) const;

  /// Pieces that have area in common, the lower first; of one object only where they face opposite ways.
  std::set<std::pair<int, int>> coincident_pairs() const;

  /// Whether the pieces are of the same polygon or mesh, in two objects of one material that face the same way.
  bool are_of_same_shape(const FlatPiece& a, const FlatPiece& b) const;

 private:
  using Pairs = std::set<std::pair<int, int>>;

  bool in_wall_or_beyond(const Reach& reach, const std::vector<glm::dvec3>& outline) const;
  double common_area(const FlatPiece& a, const FlatPiece& b) const;
  void find_pairs_in(const std::vector<int>& cell, Pairs& pairs) const;
  bool have_area_in_common(const FlatPiece& a, const FlatPiece& b) const;

  const Scene& scene_;
  int polygons_;
  Box box_;  ///< around the scene
  glm::dvec3 middle_;
  std::vector<FlatPiece> pieces_;
};

}  // namespace glimt
