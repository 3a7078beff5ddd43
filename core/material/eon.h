#pragma once

#include <numbers>

#include "material/lambertian.h"
#include "math/warp.h"

namespace glimt {

/// The directional albedo of EON's single-scattering (FON) part for reflectance 1, exact (Portsmouth, Kutz and Hill,
/// "EON: a practical energy-preserving rough diffuse BRDF", JCGT 14(1), 2025). `cos` is the cosine of the direction to
/// the normal, `a` = 1 / (1 + (1/2 - 2/(3 pi)) roughness).
template <class F>
F eon_albedo(F cos, F a, F roughness) {
  const F sin = sqrt(max(fnma(cos, cos, F(1.0f)), F(0.0f)));
  const F angle = F(0.5f * std::numbers::pi_v<float>) - arcsine(cos);
  // sin/cos (1 - sin^3), without dividing by the cosine.
  const F grazing = sin * cos * fma(sin, F(1.0f) + sin, F(1.0f)) * reciprocal(F(1.0f) + sin);
  const F g = fma(sin, fnma(sin, cos, angle), F(2.0f / 3.0f) * (grazing - sin));
  return a * fma(roughness * F(std::numbers::inv_pi_v<float>), g, F(1.0f));
}

/// EON's parameters, per lane.
template <class F>
struct EonFactors {
  F a, roughness;
  Vec3<F> multiple;  ///< weight of light reflected several times, per channel; see Eon::lower
};

/// The BRDF divided by rho / pi, in two parts. The FON part is A (1 + r s / t), where s = wi.wo - cos_i cos_o, and t is
/// the larger cosine where s > 0, else 1. The light that single scattering loses comes back as (1 - E(wi)) (1 - E(wo)).
template <class F>
Vec3<F> eon_factor(const EonFactors<F>& m, const Vec3<F>& wi, const Vec3<F>& wo, F cos_i, F cos_o) {
  const F s = dot(wi, wo) - cos_i * cos_o;
  const F larger_cos = max(max(cos_i, cos_o), F(1e-6f));
  const F over_t = select(s > F(0.0f), s * reciprocal(larger_cos), s);
  const F single = m.a * fma(m.roughness, over_t, F(1.0f));
  const F lost = (F(1.0f) - eon_albedo(cos_i, m.a, m.roughness)) * (F(1.0f) - eon_albedo(cos_o, m.a, m.roughness));
  return fma(m.multiple, lost, Vec3<F>::all(single));
}

/// A rough diffuse surface that keeps all energy.
struct EonLobe {
  static constexpr std::string_view feature = "EON";
  enum Columns { a, roughness, multiple_r, multiple_g, multiple_b, column_count };
  static constexpr LobeClass lobe_class = LobeClass::cosine;
  static constexpr LobeUse use = LobeUse::seldom;

  template <class F, class Row>
  static Vec3<F> evaluate(const Row& row, const Vec3<F>& wi, const Vec3<F>& wo, F cos_i, F cos_o) {
    const EonFactors<F> m{row(a), row(roughness), row.vector(multiple_r)};
    return eon_factor(m, wi, wo, cos_i, cos_o);
  }
};

/// The energy-preserving Oren-Nayar model (Portsmouth, Kutz and Hill 2025).
struct Eon : Matt {
  static constexpr std::string_view name = "eon", doc = "rough and matt, keeping all energy";
  static constexpr Parameter<double> roughness{.key = "roughness",
                                               .doc = "of the surface, from smooth to roughest",
                                               .fallback = 0.6,
                                               .max = 1,
                                               .required = true,
                                               .stored = "eon roughness"};

  using Lobes = std::tuple<EonLobe>;

  static std::vector<Field<Material>> fields() { return {field<reflectance>(), field<roughness>(), field<emission>()}; }
  static void lower(const Material& m, auto& row) {
    const double r = m.get(roughness);
    if (!(r > 0)) return row.template choose<LambertianLobe>();
    const double a = 1 / (1 + (0.5 - 2 / (3 * std::numbers::pi)) * r);
    // With E the mean albedo of the FON part, light reflected several times has the albedo rho^2 E / (1 - rho (1 - E)).
    // Its lobe (1 - E(wi)) (1 - E(wo)) is normalised by 1 - E. One rho is left out: the path's throughput has it
    // already.
    const double mean = a * (1 + (2.0 / 3 - 28 / (15 * std::numbers::pi)) * r);
    const glm::dvec3 rho = m.get(reflectance);
    const glm::dvec3 multiple = rho * mean / ((1.0 - rho * (1 - mean)) * (1 - mean));
    row.template choose<EonLobe>(a, r, multiple.r, multiple.g, multiple.b);
  }
};

}  // namespace glimt
