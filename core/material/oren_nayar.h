#pragma once

#include <array>
#include <numbers>

#include "material/lambertian.h"

namespace glimt {

/// A and B of the Oren-Nayar model, per lane.
template <class F>
struct OrenNayarFactors {
  F a, b;
  Mask<F> report;  ///< sin(beta) replaces tan(beta)
};

/// The BRDF divided by rho / pi: A + B max(0, cos(phi_i - phi_o)) sin(alpha) tan(beta), where alpha is the larger and
/// beta the smaller angle to the normal (Oren and Nayar 1994, eq. 30; the report's eq. 7 has sin(beta)). No angle is
/// computed. With s = sin(theta_i) sin(theta_o) cos(phi_i - phi_o) = wi.wo - cos(theta_i) cos(theta_o), the product
/// cos(phi_i - phi_o) sin(alpha) tan(beta) is s / (the larger cosine).
template <class F>
F oren_nayar_factor(const OrenNayarFactors<F>& m, const Vec3<F>& wi, const Vec3<F>& wo, F cos_i, F cos_o) {
  const F s = max(dot(wi, wo) - cos_i * cos_o, F(0.0f));
  const F larger_cos = max(max(cos_i, cos_o), F(1e-6f));
  return fma(m.b, select(m.report, s, s * reciprocal(larger_cos)), m.a);
}

/// A rough diffuse surface: V-shaped grooves of Lambertian facets.
struct OrenNayarLobe {
  static constexpr std::string_view feature = "Oren-Nayar";
  enum Columns { a, b, report, column_count };
  static constexpr LobeClass lobe_class = LobeClass::cosine;
  static constexpr LobeUse use = LobeUse::often;

  template <class F, class Row>
  static Vec3<F> evaluate(const Row& row, const Vec3<F>& wi, const Vec3<F>& wo, F cos_i, F cos_o) {
    const OrenNayarFactors<F> m{row(a), row(b), row(report) > F(0.5f)};
    return Vec3<F>::all(oren_nayar_factor(m, wi, wo, cos_i, cos_o));
  }
};

/// The two printed forms of the Oren-Nayar model.
enum class OrenNayarFormula {
  published,  ///< sin(alpha) tan(beta): Oren and Nayar 1994, eq. 30
  report,     ///< sin(alpha) sin(beta): the course report's eq. 7
};

/// Lambertian facets whose slope angles are normally distributed (Oren and Nayar 1994).
struct OrenNayar : Matt {
  static constexpr std::string_view name = "oren-nayar", doc = "rough and matt, like clay";
  static constexpr Parameter<double> roughness{.key = "roughness",
                                               .doc = "standard deviation of the facets' slope angle, radians",
                                               .fallback = 0.6,
                                               .max = std::numbers::pi / 2,
                                               .required = true,
                                               .stored = "oren-nayar roughness"};
  static constexpr std::array<std::string_view, 2> formula_names{"published", "report"};
  static constexpr Parameter<OrenNayarFormula> formula{
      .key = "formula",
      .doc = "form of the Oren-Nayar model: as published, or as the report prints it",
      .names = formula_names};

  using Lobes = std::tuple<OrenNayarLobe>;

  static std::vector<Field<Material>> fields() {
    return {field<reflectance>(), field<roughness>(), field<formula>(), field<emission>()};
  }
  static void lower(const Material& m, auto& row) {
    const double sigma2 = m.get(roughness) * m.get(roughness);
    if (sigma2 == 0) return row.template choose<LambertianLobe>();
    row.template choose<OrenNayarLobe>(1 - sigma2 / (2 * (sigma2 + 0.33)), 0.45 * sigma2 / (sigma2 + 0.09),
                                       m.get(formula) == OrenNayarFormula::report ? 1 : 0);
  }
};

}  // namespace glimt
