#pragma once

#include "kernel/caustics/found_chain.h"
#include "kernel/transport/next_event.h"
#include "kernel/transport/path_state.h"

/// What counts of a lamp that a path has met by chance. Other techniques may find the same light, and each has its
/// clause; the shares of all techniques add up to 1.
namespace glimt {

/// Along s.ray at the distance `t`, in the lanes `lamp`, where the path meets the front of a lamp. The clauses are
/// multiplied: each shares what the others leave to chance. `light_traced`, `connects`: whether there are light paths,
/// and connections over spheres.
template <class F, Features features>
F lamp_weight(const CompiledScene& scene, const Surfaces<F, features>& surfaces, const NextEvent<F, features>& lamps,
              const PathState<F>& s, const Interaction<F>& at, F t, const Mask<F>& lamp, bool light_traced,
              bool connects) {
  using I = Int<F>;
  using M = Mask<F>;
  F weight(1.0f);
  const auto row_of = [&](M& mask) {
    const I row = surfaces.lamp_row(at);
    mask = mask & less(I(-1), row);
    return select(mask, row, I(0));
  };
  // Light sampling at the last surface, where that shares.
  if (lamps.shares()) {
    M shared = lamp & (s.lamps.pdf_w > F(0.0f));
    if (any(shared)) {
      const I row = row_of(shared);
      const F q = s.lamps.pdf_w * lamp_inverse_pdf(scene, row, s.ray.origin, t, at.cos_o);
      const F m(static_cast<float>(setting<features, &Settings::shadow_rays>(scene)));
      weight = select(shared, max(fnma(m, reciprocal(q + m), F(1.0f)), F(0.0f)), weight);
    }
  }
  // Light paths, which reach the first surface by way of mirrors or glass.
  if (light_traced) weight = weight * select(lamp, s.lamps.next, F(1.0f));
  // Connections over spheres, where the path has come along one of their chains.
  if (connects) {
    M chained = lamp & s.chain.found.complete();
    if (any(chained)) {
      const I row = row_of(chained);
      weight = weight * select(chained, chance_share(scene, surfaces, s.chain.found, s.ray, at, row), F(1.0f));
    }
  }
  return weight;
}

}  // namespace glimt
