#pragma once

#include <cstddef>

#include "scene/scene.h"

namespace glimt {

/// Gives the sphere this material and changes no other thing's look: where others share its material, the sphere first
/// gets one of its own, named after it. The name in `material` is not used.
void set_sphere_material(Scene& scene, std::size_t sphere, Material material);

}  // namespace glimt
