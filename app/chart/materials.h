#pragma once

#include "scene/scene.h"

namespace glimt {

/// Whether an object of the scene is made of the material.
bool is_used(const Scene& scene, const std::string& material);

/// Whether the scene has a mirror or glass.
bool has_specular(const Scene& scene);

}  // namespace glimt
