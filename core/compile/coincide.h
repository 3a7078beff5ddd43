#pragma once

#include <string>
#include <vector>

#include "compile/reach.h"

namespace glimt {

/// Moves surfaces in reach apart that coincide, by a little more than what hits may be off, so that rays meet one of
/// them first and every estimator agrees which. A body, which is a closed mesh, stays behind its own faces. Between
/// bodies lie sheets, which are polygons and open meshes, each to its front; lamps are in front of others, then the
/// smaller of the larger. A surface that is there twice is left out once. Walls of the room are not moved: they hide
/// what is in their plane. Returns whether it has changed the scene. `told`: for people, as are the warnings.
bool separate_coincident(Scene& scene, const Reach& reach, std::vector<std::string>& told,
                         std::vector<std::string>& warnings);

}  // namespace glimt
