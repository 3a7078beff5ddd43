#pragma once

#include <string>
#include <vector>

#include "compile/reach.h"

namespace glimt {

// In sizes of what is around (local_size()).
inline constexpr double coincident_distance = 0x1p-22;  ///< rays cannot tell apart what is nearer than this
inline constexpr double least_gap = 0x1p-20;            ///< rays can tell apart what this is between

/// What compile has to say to people.
struct CoincidenceNotes {
  std::vector<std::string> told, warnings;
};

/// Moves surfaces in reach apart that coincide, by a little more than what hits may be off, so that rays meet one of
/// them first and every estimator agrees which. A body, which is a closed mesh, stays behind its own faces. Between
/// bodies lie sheets, which are polygons and open meshes, each to its front; lamps are in front of others, then the
/// smaller of the larger. A surface that is there twice is left out once. Walls of the room are not moved: they hide
/// what is in their plane. Returns whether it has changed the scene.
bool separate_coincident(Scene& scene, const Reach& reach, CoincidenceNotes& notes);

/// The same for spheres, which become shells of each other: from the outside in lamps, glass, others.
bool separate_coincident_spheres(Scene& scene, const Reach& reach, CoincidenceNotes& notes);

}  // namespace glimt
