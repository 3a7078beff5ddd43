#pragma once

#include <glm/vec3.hpp>
#include <string>
#include <vector>

namespace glimt {

/// Relative to a shape's size (squared for areas): less is nothing.
inline constexpr double degenerate = 1e-10;

/// How the outline of a polygon is cut into flat convex pieces, or what is wrong with it.
struct ConvexPieces {
  /// Counter-clockwise from the front. Only the outline itself where it is flat and convex; none where it is wrong.
  std::vector<std::vector<glm::dvec3>> pieces;
  bool bent = false;    ///< the outline is not flat or not convex
  int left_out = 0;     ///< vertices that are where the one before them is, and tips of spikes
  std::string mistake;  ///< what is wrong, and what is allowed; empty where nothing is
  int vertex = -1;      ///< the one to blame for the mistake, or -1
};

/// The vertices are finite.
ConvexPieces convex_pieces(const std::vector<glm::dvec3>& outline);

}  // namespace glimt
