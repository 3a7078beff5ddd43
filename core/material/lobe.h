#pragma once

#include <tuple>

#include "math/vec.h"
#include "scene/fields.h"

/// A lobe is one way in which a surface scatters light. A material has one or more, and compile chooses one for each
/// surface. `Columns` names what the lobe reads from the surface table, and `feature` is its name for people. Delta and
/// glossy lobes also say whether a sample's weight may differ from 1 (`weighs`), whether a sample may lead behind the
/// surface (`transmits`), and whether connections pass over spheres that have the lobe (`connects`). Directions point
/// away from the surface: wo towards where the path comes from, wi towards where it goes on.
namespace glimt {

/// Which kernels have the lobe. Every kernel has the lobes of use `always`.
enum class LobeUse { always, often, seldom };

/// A direction in which a path goes on.
template <class F>
struct ScatterSample {
  Vec3<F> direction;  ///< unit
  Vec3<F> weight;     ///< BSDF |cos| / (pdf_w colour), without the factor n^2 of radiance
  F pdf_w;            ///< 1/sr; meaningless for delta lobes
  Mask<F> crosses;    ///< the direction leads behind the surface
  F eta2;             ///< square of (index there / index here); meaningful only where `crosses`
  F inverse_eta2;     ///< factor of the radiance from there
};

/// A surface where a path meets it.
template <class F>
struct Interaction {
  F cos_o;         ///< cosine of wo to the normal
  Int<F> surface;  ///< a ray from here starts on it
  Int<F> row;      ///< of the surface table; differs from `surface` where that is a triangle of a tree
  Int<F> kind;     ///< names the lobe: lobe_kind of lobes.h
  Vec3<F> point;   ///< compiled space, metres
  Vec3<F> normal;  ///< unit, towards the side from which the path comes; the shading normal of a smooth triangle
  Vec3<F> flat;    ///< own normal of a smooth triangle, on the side of `normal`; like `smooth` for trees alone
  Mask<F> front;   ///< the path comes from the side of the surface's own normal
  Mask<F> smooth;  ///< the surface is a smooth triangle
};

}  // namespace glimt
