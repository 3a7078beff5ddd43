#pragma once

#include "material/eon.h"
#include "material/glass.h"
#include "material/lambertian.h"
#include "material/light.h"
#include "material/mirror.h"
#include "material/oren_nayar.h"

namespace glimt {

template <class... Materials>
struct MaterialList {};

/// Every material there is. scene/fields.h tells the rest of the program about them.
using AllMaterials = MaterialList<Lambertian, OrenNayar, Eon, Mirror, Glass, Light>;

/// What the material's type makes of its parameters.
SurfaceRow lower(const Material& material);

}  // namespace glimt
