#pragma once

#include <numbers>

#include "kernel/entry/features.h"
#include "kernel/lamps/sample_lamp.h"
#include "kernel/scattering/surfaces.h"
#include "kernel/transport/hit_numbers.h"

/// Next-event estimation: light that comes straight from lamps, by shadow rays to points of them.
namespace glimt {

template <class F, Features features>
class NextEvent {
  using M = Mask<F>;
  using V = Vec3<F>;

 public:
  NextEvent(const CompiledScene& scene, const Surfaces<F, features>& surfaces)
      : scene_(scene),
        surfaces_(surfaces),
        on_(setting<features, &Settings::light_sampling>(scene) != LightSampling::none && scene.lamps.rows() > 0 &&
            setting<features, &Settings::caustics>(scene) != Caustics::only),
        matt_shares_(on_ && setting<features, &Settings::mis>(scene) == Mis::on) {}

  /// Whether lamps are sampled at all.
  bool on() const { return on_; }
  /// Whether lamps that a ray from a matt surface finds by chance share with those that are sampled. At glossy surfaces
  /// they always do.
  bool matt_shares() const { return features.any_settings && matt_shares_; }
  bool glossy_shares() const { return on_ && surfaces_.has_glossy(); }
  bool shares() const { return matt_shares() || glossy_shares(); }

  /// Light from the lamps that the surface sends towards wo, over its colour, in the lanes that ask.
  V direct_light(const HitNumbers<F>& numbers, const Interaction<F>& at, const M& asks, const V& wo) const {
    const int rays = setting<features, &Settings::shadow_rays>(scene_);
    const F scale(std::numbers::inv_pi_v<float> / static_cast<float>(rays));
    const bool several = !features.one_parallelogram && scene_.lamps.rows() > 1;
    V direct = V::all(F(0.0f));
    for (int k = 0; k < rays; ++k) {
      const F which = several ? numbers.number(HitDimension::lamp, rays, k) : F(0.0f);
      const Point2<F> uv = numbers.pair(HitDimension::lamp_u, rays, k);
      const LampSample<F> lamp = sample_lamp<F, features.one_parallelogram>(scene_, at.point, which, uv.u, uv.v);
      const F cos_i = dot(lamp.direction, at.normal);
      M faces = cos_i > F(0.0f);
      if constexpr (Surfaces<F, features>::may_be_glossy())
        if (scene_.has_glass) faces = faces | surfaces_.is_glossy(at);
      const bool smooth = surfaces_.has_smooth();
      if (smooth)
        faces = (faces & !at.smooth) |
                (at.smooth & ((surfaces_.flat_cos(at, lamp.direction, cos_i) > F(0.0f)) | surfaces_.transmits(at)));
      const M lit = asks & faces & (lamp.inverse_pdf > F(0.0f));
      if (!any(lit)) continue;
      const Ray<F> shadow{at.point, lamp.direction, at.surface};
      const M seen =
          lit & !occluded<F, features>(scene_, shadow, lamp.distance, lamp.first_surface, lamp.last_surface, lit);
      F weight = abs_cos(cos_i) * (lamp.inverse_pdf * scale);
      if (smooth) weight = select(at.smooth, lamp.inverse_pdf * scale, weight);
      if (shares()) {
        // M rays here and one direction there (the balance heuristic): M / (M + pdf_w there / pdf_w here).
        const F m(static_cast<float>(rays));
        F there = surfaces_.pdf_w(at, lamp.direction, wo, cos_i, at.cos_o);
        if (smooth && any(at.smooth)) there = select(at.smooth, surfaces_.folded_pdf_w(at, lamp.direction, wo), there);
        const F share = m * reciprocal(fma(there, lamp.inverse_pdf * lamp.inverse_choice, m));
        weight = weight * (matt_shares() ? share : select(surfaces_.is_glossy(at), share, F(1.0f)));
      }
      // Lanes that do not see the lamp may hold values that are no numbers.
      V factor = surfaces_.evaluate(at, lamp.direction, wo, cos_i, at.cos_o) * weight;
      if (smooth && any(at.smooth))
        factor = select(at.smooth, surfaces_.folded_evaluate(at, lamp.direction, wo) * weight, factor);
      direct = fma(lamp.weight, select(seen, factor, V::all(F(0.0f))), direct);
    }
    return direct;
  }

 private:
  static F abs_cos(F cos) {
    if constexpr (Surfaces<F, features>::may_be_glossy()) return abs(cos);
    return cos;
  }

  const CompiledScene& scene_;
  const Surfaces<F, features>& surfaces_;
  bool on_, matt_shares_;
};

}  // namespace glimt
