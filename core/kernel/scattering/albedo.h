#pragma once

#include "scene/scene.h"

namespace glimt {

/// The directional albedo, green channel: the share of light, arriving on the front side at this angle to the normal
/// (radians), that the surface reflects or refracts. If the material absorbs nothing, the rest is light that one facet
/// sends to another. It is a share of flux, so refraction has no factor n^2. Accurate to 0.001.
double directional_albedo(const Material& material, double angle);

}  // namespace glimt
