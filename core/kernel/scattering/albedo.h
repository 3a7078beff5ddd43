#pragma once

#include "scene/scene.h"

namespace glimt {

/// Share of the light that a surface sends on, reflected and refracted, of light that comes at that angle to the normal
/// from the front side (radians): the directional albedo, green. What is missing from 1 in a material that absorbs
/// nothing is light that one facet sends to another. Flux is counted, so refraction has no factor n^2. Good to 0.001.
double directional_albedo(const Material& material, double angle);

}  // namespace glimt
