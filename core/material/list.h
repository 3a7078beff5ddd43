#pragma once

#include "material/conductor.h"
#include "material/eon.h"
#include "material/glass.h"
#include "material/lambertian.h"
#include "material/light.h"
#include "material/mirror.h"
#include "material/oren_nayar.h"

namespace glimt {

template <class... Materials>
struct MaterialList {};

/// All materials. The rest of the program knows them only through this list.
using AllMaterials = MaterialList<Lambertian, OrenNayar, Eon, Mirror, Conductor, Glass, Light>;

}  // namespace glimt
