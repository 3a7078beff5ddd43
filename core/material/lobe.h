#pragma once

#include <tuple>

#include "math/vec.h"
#include "scene/fields.h"

/// What a lobe is: one way in which a surface sends light on. A material has one or more, and compile chooses one for
/// each surface. Delta and glossy lobes say what they need: `weighs`, whether a sample's weight may differ from 1, and
/// `transmits`, whether it may lead behind the surface, and `connects`, whether connections pass over
/// spheres that have the lobe. What a lobe reads of the surface table it names in `Columns`; `feature` is what people
/// are told of it. Directions point away from the surface; wo is where the path
/// comes from, wi where it goes on.
namespace glimt {

/// In which kernels a lobe is compiled. Every kernel holds what is always there.
enum class LobeUse { always, often, seldom };

/// A direction in which a path goes on.
template <class F>
struct ScatterSample {
  Vec3<F> direction;  ///< unit
  Vec3<F> weight;     ///< BSDF |cos| / pdf_w over the surface's colour, without the factor n^2 of radiance
  F pdf_w;            ///< 1/sr; without meaning for delta lobes
  Mask<F> crosses;    ///< the direction leads behind the surface
  F eta2;             ///< square of the index there over the index here; has a meaning where `crosses`
  F inverse_eta2;     ///< what the radiance from there is multiplied by
};

/// A surface where a path meets it.
template <class F>
struct Interaction {
  Vec3<F> point;   ///< compiled space, metres
  Vec3<F> normal;  ///< unit, to the side that the path comes from
  F cos_o;         ///< of wo to the normal
  Mask<F> front;   ///< the side of the surface's own normal
  Int<F> surface;
  Int<F> kind;  ///< which lobe: lobe_kind of lobes.h
};

}  // namespace glimt
