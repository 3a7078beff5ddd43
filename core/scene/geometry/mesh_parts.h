#pragma once

#include <vector>

#include "scene/scene.h"

namespace glimt {

/// The mesh as one mesh for each of its materials, all of its name.
std::vector<Mesh> by_material(const Mesh& mesh);

}  // namespace glimt
