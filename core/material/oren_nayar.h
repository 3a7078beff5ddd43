#pragma once

#include <array>
#include <numbers>

#include "material/shared.h"

namespace glimt {

/// Which of the two printed forms of the Oren-Nayar model is meant.
enum class OrenNayarFormula {
  published,  ///< sin(alpha) tan(beta): Oren and Nayar 1994, eq. 30
  report,     ///< sin(alpha) sin(beta): the course report's eq. 7
};

/// Facets of a normally distributed slope, each Lambertian (Oren and Nayar 1994).
struct OrenNayar : Matt {
  static constexpr std::string_view name = "oren-nayar", doc = "rough and matt, like clay", feature = "Oren-Nayar";
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

  static std::vector<Field<Material>> fields() {
    return {field<reflectance>(), field<roughness>(), field<formula>(), field<emission>()};
  }
  static void lower(const Material& m, SurfaceRow& row) {
    const double sigma2 = m.get(roughness) * m.get(roughness);
    if (sigma2 == 0) return;
    row.oren_nayar_a = 1 - sigma2 / (2 * (sigma2 + 0.33));
    row.oren_nayar_b = 0.45 * sigma2 / (sigma2 + 0.09);
    row.oren_nayar_report = m.get(formula) == OrenNayarFormula::report;
  }
};

}  // namespace glimt
