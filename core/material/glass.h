#pragma once

#include <array>

#include "material/dielectric.h"
#include "material/ggx.h"
#include "material/shared.h"

namespace glimt {

/// Refractive indices at a glass surface, as seen from the side that the path comes from.
template <class F>
struct GlassSides {
  F eta, inverse_eta;  ///< index behind the surface divided by the index here
  Mask<F> schlick;

  template <class Row>
  GlassSides(const Row& row, F is_schlick) {
    const F ratio = row.eta();
    const F inverse = reciprocal(ratio);
    eta = select(row.at.front, ratio, inverse);
    inverse_eta = select(row.at.front, inverse, ratio);
    schlick = is_schlick > F(0.5f);
  }
};

/// Smooth, clear glass. The number u chooses reflection or refraction with Fresnel's shares as probabilities, so both
/// have weight 1.
struct SmoothGlassLobe {
  static constexpr std::string_view feature = "glass";
  enum Columns { schlick, column_count };
  static constexpr LobeClass lobe_class = LobeClass::delta;
  static constexpr LobeUse use = LobeUse::always;
  static constexpr bool weighs = false, transmits = true, connects = true;

  template <class F, class Row>
  static ScatterSample<F> sample(const Row& row, const Vec3<F>& wo, F u, F, F) {
    const GlassSides<F> sides(row, row(schlick));
    const Dielectric<F> interface = fresnel(row.at.cos_o, sides.eta, sides.inverse_eta, sides.schlick);
    const Mask<F> reflected = u < interface.reflected;
    const Vec3<F> direction = wo * F(-1.0f);
    const Vec3<F> back = fma(row.at.normal, row.at.cos_o + row.at.cos_o, direction);
    const Vec3<F> through = refract(direction, row.at.normal, row.at.cos_o, interface.cos_t, sides.inverse_eta);
    // Normalised, because rounding errors of the length would build up over many hits.
    return {
        normalize(select(reflected, back, through)), Vec3<F>::all(F(1.0f)), F(0.0f), !reflected, sides.eta * sides.eta,
        sides.inverse_eta * sides.inverse_eta};
  }
};

/// Frosted glass: microscopic smooth interfaces whose normals follow GGX (Walter et al. 2007).
struct RoughGlassLobe {
  static constexpr std::string_view feature = "frosted glass";
  enum Columns { alpha, schlick, column_count };
  static constexpr LobeClass lobe_class = LobeClass::glossy;
  static constexpr LobeUse use = LobeUse::seldom;
  static constexpr bool weighs = true, transmits = true, connects = false;

  template <class F, class Row>
  static ScatterSample<F> sample(const Row& row, const Vec3<F>& wo_world, F u, F v, F lobe) {
    const GlassSides<F> sides(row, row(schlick));
    const LocalFrame<F> frame(row.at.normal);
    const Vec3<F> wo = frame.to_local(wo_world);
    const Ggx<F> ggx{row(alpha)};
    const Vec3<F> m = ggx.visible_normal(wo, u, v);
    const F cos = max(dot(wo, m), F(0.0f)), cos_o = max(wo.z, F(1e-7f));
    const Dielectric<F> interface = fresnel(cos, sides.eta, sides.inverse_eta, sides.schlick);
    const Mask<F> reflected = lobe < interface.reflected;
    const Vec3<F> direction = wo * F(-1.0f);
    const Vec3<F> wi =
        select(reflected, fma(m, cos + cos, direction), refract(direction, m, cos, interface.cos_t, sides.inverse_eta));
    const Mask<F> refracted = !reflected;
    const Mask<F> right_side = (reflected & (wi.z > F(0.0f))) | (refracted & (wi.z < F(0.0f)));
    const F share = select(reflected, interface.reflected, F(1.0f) - interface.reflected);
    const F pdf_w = share * ggx.visible_density(m, cos_o) *
                    select(reflected, F(0.5f), refraction_jacobian(sides, cos, interface.cos_t) * cos);
    return {normalize(frame.to_world(wi)),
            Vec3<F>::all(select(right_side, ggx.unmasked(abs(wi.z), cos_o), F(0.0f))),
            select(right_side, pdf_w, F(0.0f)),
            refracted,
            sides.eta * sides.eta,
            sides.inverse_eta * sides.inverse_eta};
  }

  template <class F, class Row>
  static Vec3<F> evaluate(const Row& row, const Vec3<F>& wi, const Vec3<F>& wo, F cos_i, F cos_o) {
    const Half<F> half(row, wi, wo, cos_i);
    const Ggx<F> ggx{row(alpha)};
    const F facets =
        F(std::numbers::pi_v<float>) * half.share * ggx.density(half.m) * ggx.visibility(abs(cos_i), cos_o);
    // 4 wi.m wo.m / (wo.m + eta wi.m)^2. The factor 1 / eta^2 of radiance cancels the Jacobian's eta^2.
    const F turned = F(2.0f) * half.cos_o * half.jacobian * (half.sides.inverse_eta * half.sides.inverse_eta);
    return Vec3<F>::all(select(half.possible, facets * select(half.reflects, F(1.0f), turned), F(0.0f)));
  }

  template <class F, class Row>
  static F pdf_w(const Row& row, const Vec3<F>& wi, const Vec3<F>& wo, F cos_i, F cos_o) {
    const Half<F> half(row, wi, wo, cos_i);
    const F seen = Ggx<F>{row(alpha)}.visible_density(half.m, max(cos_o, F(1e-7f)));
    return select(half.possible, half.share * seen * select(half.reflects, F(0.5f), half.jacobian * half.cos_o),
                  F(0.0f));
  }

 private:
  /// Twice the solid angle of normals per solid angle of refracted directions (Walter et al., eq. 17):
  /// 2 eta^2 wi.m / (wo.m + eta wi.m)^2, with signed cosines.
  template <class F>
  static F refraction_jacobian(const GlassSides<F>& sides, F cos, F cos_t) {
    const F sum = fnma(sides.eta, cos_t, cos);
    return F(2.0f) * sides.eta * sides.eta * cos_t * reciprocal(max(sum * sum, F(1e-20f)));
  }

  /// The facet that sends wo to wi.
  template <class F>
  struct Half {
    GlassSides<F> sides;
    Mask<F> reflects, possible;
    Vec3<F> m;   ///< the facet's normal, in the surface's frame
    F cos_o;     ///< wo.m
    F share;     ///< share of the light that goes this way, by Fresnel
    F jacobian;  ///< refraction_jacobian

    template <class Row>
    Half(const Row& row, const Vec3<F>& wi_world, const Vec3<F>& wo_world, F cos_i) : sides(row, row(schlick)) {
      const LocalFrame<F> frame(row.at.normal);
      const Vec3<F> wi = frame.to_local(wi_world), wo = frame.to_local(wo_world);
      reflects = cos_i > F(0.0f);
      const Vec3<F> sum = fma(wi, select(reflects, F(1.0f), sides.eta), wo);
      m = normalize(sum);
      m = m * select(m.z < F(0.0f), F(-1.0f), F(1.0f));
      cos_o = dot(wo, m);
      const F cos_m_i = dot(wi, m);
      possible = (cos_o > F(0.0f)) & (reflects | (cos_m_i < F(0.0f)));
      const Dielectric<F> interface = fresnel(max(cos_o, F(0.0f)), sides.eta, sides.inverse_eta, sides.schlick);
      share = select(reflects, interface.reflected, F(1.0f) - interface.reflected);
      jacobian = refraction_jacobian(sides, cos_o, F(0.0f) - cos_m_i);
    }
  };
};

enum class Fresnel { exact, schlick };

struct Glass : AnyMaterial {
  static constexpr std::string_view name = "glass", doc = "clear or frosted, for closed shapes";
  static constexpr LobeClass lobe_class = LobeClass::delta;
  static constexpr bool transmits = true;
  static constexpr Parameter<double> ior{.key = "ior",
                                         .doc = "absolute refractive index",
                                         .fallback = 1.5,
                                         .max = 10,
                                         .min_excluded = true,
                                         .required = true};
  static constexpr std::array<std::string_view, 2> fresnel_names{"exact", "schlick"};
  static constexpr Parameter<Fresnel> fresnel{
      .key = "fresnel", .doc = "reflected share: exact, or Schlick's approximation", .names = fresnel_names};

  static constexpr Parameter<double> roughness = ggx_roughness;
  using Lobes = std::tuple<SmoothGlassLobe, RoughGlassLobe>;

  static std::vector<Field<Material>> fields() { return {field<ior>(), field<roughness>(), field<fresnel>()}; }
  static glm::dvec3 albedo(const Material&) { return glm::dvec3{1}; }
  static double refractive_index(const Material& m) { return m.get(ior); }
  static void lower(const Material& m, auto& row) {
    const double alpha = ggx_alpha(m.get(roughness)), schlick = m.get(fresnel) == Fresnel::schlick ? 1 : 0;
    if (alpha < smallest_alpha) return row.template choose<SmoothGlassLobe>(schlick);
    row.template choose<RoughGlassLobe>(alpha, schlick);
  }
};

}  // namespace glimt
