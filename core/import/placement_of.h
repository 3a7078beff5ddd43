#pragma once

#include <glm/mat4x4.hpp>
#include <optional>

#include "mesh/place_mesh.h"

namespace glimt {

/// The scale, turn and move that the matrix is made of; nothing where it shears or flattens.
std::optional<Placement> placement_of(const glm::dmat4& matrix);

}  // namespace glimt
