#pragma once

#include <numbers>

#include "material/lambertian.h"
#include "math/warp.h"

namespace glimt {

/// Share of the light that EON's single bounce sends back towards a direction at that cosine, for reflectance 1
/// (Portsmouth, Kutz and Hill, "EON: a practical energy-preserving rough diffuse BRDF", JCGT 14(1), 2025: the exact
/// directional albedo of its FON part). `a` = 1 / (1 + (1/2 - 2/(3 pi)) roughness).
template <class F>
F eon_albedo(F cos, F a, F roughness) {
  const F sin = sqrt(max(fnma(cos, cos, F(1.0f)), F(0.0f)));
  const F angle = F(0.5f * std::numbers::pi_v<float>) - arcsine(cos);
  // sin/cos (1 - sin^3) without a quotient by the cosine.
  const F grazing = sin * cos * fma(sin, F(1.0f) + sin, F(1.0f)) * reciprocal(F(1.0f) + sin);
  const F g = fma(sin, fnma(sin, cos, angle), F(2.0f / 3.0f) * (grazing - sin));
  return a * fma(roughness * F(std::numbers::inv_pi_v<float>), g, F(1.0f));
}

/// EON's parameters, per lane.
template <class F>
struct EonFactors {
  F a, roughness;
  Vec3<F> multiple;  ///< weight of the light reflected many times, by channel; see Eon::lower
};

/// The BRDF over rho / pi: the FON part, A (1 + r s / t) with s as above and t the larger cosine where s > 0, else 1;
/// and the light that its single bounce loses, spread as (1 - E(wi)) (1 - E(wo)).
template <class F>
Vec3<F> eon_factor(const EonFactors<F>& m, const Vec3<F>& wi, const Vec3<F>& wo, F cos_i, F cos_o) {
  const F s = dot(wi, wo) - cos_i * cos_o;
  const F larger_cos = max(max(cos_i, cos_o), F(1e-6f));
  const F over_t = select(s > F(0.0f), s * reciprocal(larger_cos), s);
  const F single = m.a * fma(m.roughness, over_t, F(1.0f));
  const F lost = (F(1.0f) - eon_albedo(cos_i, m.a, m.roughness)) * (F(1.0f) - eon_albedo(cos_o, m.a, m.roughness));
  return fma(m.multiple, lost, Vec3<F>::all(single));
}

/// Rough and matt, keeping all energy.
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
    // With E the mean albedo of the FON model: light that is reflected again and again comes to rho^2 E / (1 - rho (1 -
    // E)) of a share 1 - E lost by each side; here over rho, which the path's throughput holds already.
    const double mean = a * (1 + (2.0 / 3 - 28 / (15 * std::numbers::pi)) * r);
    const glm::dvec3 rho = m.get(reflectance);
    const glm::dvec3 multiple = rho * mean / ((1.0 - rho * (1 - mean)) * (1 - mean));
    row.template choose<EonLobe>(a, r, multiple.r, multiple.g, multiple.b);
  }
};

}  // namespace glimt
