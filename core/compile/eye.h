#pragma once

#include <string>
#include <vector>

#include "scene/scene.h"

namespace glimt {

/// Moves an eye that lies on a surface off it, to the side it looks to, and tells so: a ray that starts on a surface
/// knows of no side. Where the view is along the surface, the eye goes to its front.
void move_eye_off_surfaces(Scene& scene, std::vector<std::string>& told);

}  // namespace glimt
