#pragma once

#include <numbers>

#include "material/shared.h"

namespace glimt {

/// The energy-preserving Oren-Nayar model (Portsmouth, Kutz and Hill 2025).
struct Eon : Matt {
  static constexpr std::string_view name = "eon", doc = "rough and matt, keeping all energy", feature = "EON";
  static constexpr Parameter<double> roughness{.key = "roughness",
                                               .doc = "of the surface, from smooth to roughest",
                                               .fallback = 0.6,
                                               .max = 1,
                                               .required = true,
                                               .stored = "eon roughness"};

  static std::vector<Field<Material>> fields() { return {field<reflectance>(), field<roughness>(), field<emission>()}; }
  static void lower(const Material& m, SurfaceRow& row) {
    const double r = m.get(roughness);
    if (!(r > 0)) return;
    const double a = 1 / (1 + (0.5 - 2 / (3 * std::numbers::pi)) * r);
    // With E the mean albedo of the FON model: light that is reflected again and again comes to rho^2 E / (1 - rho (1 -
    // E)) of a share 1 - E lost by each side; here over rho, which the path's throughput holds already.
    const double mean = a * (1 + (2.0 / 3 - 28 / (15 * std::numbers::pi)) * r);
    const glm::dvec3 rho = m.get(reflectance);
    row.eon = true;
    row.oren_nayar_a = a;
    row.oren_nayar_b = r;
    row.eon_multiple = rho * mean / ((1.0 - rho * (1 - mean)) * (1 - mean));
  }
};

}  // namespace glimt
