#pragma once

#include "scene/scene.h"

namespace glimt {

/// Whether an object of the scene has a material that `is` says yes to.
bool has_material(const Scene& scene, bool (*is)(const Material&));

/// Whether the scene has a mirror or glass.
bool has_specular(const Scene& scene);

}  // namespace glimt
