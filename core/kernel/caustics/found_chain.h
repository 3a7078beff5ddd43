#pragma once

#include "kernel/caustics/sphere_chain.h"
#include "kernel/entry/features.h"
#include "kernel/lamps/sample_lamp.h"
#include "kernel/scattering/surfaces.h"

/// Chains over a sphere that a camera path finds by BSDF sampling and that connections find too (connect.h).
namespace glimt {

/// The column that says whether a clear glass sphere uses Schlick's approximation.
inline constexpr Column smooth_glass_schlick = lobe_column(first_column<SmoothGlassLobe>() + SmoothGlassLobe::schlick);

/// How far a path has come on a chain from a diffuse surface. Chains `reflected` and `refracted` are complete.
enum ChainStage : std::int32_t { chain_none, chain_open, chain_inside, chain_reflected, chain_refracted };

template <class F>
struct FoundChain {
  Int<F> stage;  ///< ChainStage
  F pdf_w;       ///< pdf with which the diffuse surface chose the direction, 1/sr
  F distance2;   ///< squared distance of that surface's point to the sphere's centre, m^2

  /// Follows the path to the next surface, `distance` away. `opens`: it is diffuse and gets connections. `crosses`: the
  /// path goes on behind it. The path loop sets pdf_w at diffuse surfaces.
  template <Features features>
  void follow(const Surfaces<F, features>& surfaces, const Ray<F>& ray, const Interaction<F>& at, F distance,
              const Mask<F>& opens, const Mask<F>& crosses) {
    using I = Int<F>;
    const I kind = as_int(surfaces.value(Column::chain, at));
    const Mask<F> meets = equal(stage, I(chain_open)) & at.front & less(I(0), kind);
    const Mask<F> enters = meets & crosses & equal(kind, I(2)), reflects = meets & !crosses;
    const Mask<F> leaves = equal(stage, I(chain_inside)) & crosses & equal(at.surface, ray.from);
    if (any(enters | reflects)) {
      const F radius = reciprocal(surfaces.value(Column::inverse_radius, at));
      const F square = fma(distance, fma(F(2.0f) * radius, at.cos_o, distance), radius * radius);
      distance2 = select(enters | reflects, square, distance2);
    }
    stage = select(opens, I(chain_open), I(chain_none));
    stage = select(enters, I(chain_inside), select(reflects, I(chain_reflected), stage));
    stage = select(leaves, I(chain_refracted), stage);
  }

  Mask<F> complete() const { return less(Int<F>(chain_inside), stage); }
};

/// The balance heuristic's weight of a lamp that BSDF sampling finds over a complete chain. `ray` leads from the sphere
/// to the lamp, which is in `row` of the lamp table.
template <class F, Features features>
F chance_share(const CompiledScene& scene, const Surfaces<F, features>& surfaces, const FoundChain<F>& chain,
               const Ray<F>& ray, const Interaction<F>& lamp, const Int<F>& row) {
  Interaction<F> sphere = lamp;
  sphere.surface = select(less(ray.from, Int<F>(0)), Int<F>(0), ray.from);  // lanes on no surface have no chain
  surfaces.find_row(sphere);
  const Vec3<F> center = surfaces.vector(Column::normal_x, sphere), way = lamp.point - center;
  const F inverse_radius = surfaces.value(Column::inverse_radius, sphere), radius = reciprocal(inverse_radius);
  const F cos = min(max(dot(ray.origin - center, ray.direction) * inverse_radius, F(0.0f)), F(1.0f));
  const F b = sqrt(fnma(cos, cos, F(1.0f)));
  const ChainEnd<F> x = chain_end(sqrt(chain.distance2), radius), y = chain_end(sqrt(dot(way, way)), radius);
  F tube = reflected_ray(x, y, b, cos).tube, chosen(1.0f);
  if (scene.has_glass) {
    const Mask<F> refracted = equal(chain.stage, Int<F>(chain_refracted));
    const F eta = surfaces.value(Column::eta, sphere);
    const Dielectric<F> interface =
        fresnel(cos, eta, reciprocal(eta), surfaces.value(smooth_glass_schlick, sphere) > F(0.5f));
    const SphereLens<F> lens = sphere_lens(eta);
    const F cos_omega = select(eta > F(1.0f), cos, interface.cos_t);
    tube = select(refracted, refracted_ray(lens, x, y, b * reciprocal(lens.outside), cos_omega).tube, tube);
    const F passed = F(1.0f) - interface.reflected;
    const Mask<F> glass = equal(as_int(surfaces.value(Column::kind, sphere)), Int<F>(lobe_kind<SmoothGlassLobe>));
    chosen = select(glass, select(refracted, passed * passed, interface.reflected), chosen);
  }
  const LampRow<F, false> piece{scene.lamps, row};
  const F chance = chain.pdf_w * chosen * (piece[LampColumn::inverse_choice] * piece[LampColumn::area_factor]);
  const F connections =
      F(static_cast<float>(setting<features, &Settings::shadow_rays>(scene))) * tube * reciprocal(lamp.cos_o);
  const F share = chance * reciprocal(chance + connections);
  // NaN where a grazing ray has no finite tube. Connections do not count there, so BSDF sampling has all the weight.
  return select(share >= F(0.0f), share, F(1.0f));
}

}  // namespace glimt
