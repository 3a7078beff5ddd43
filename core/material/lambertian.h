#pragma once

#include "material/shared.h"

namespace glimt {

/// Equally bright in every direction: f = colour / pi.
struct LambertianLobe {
  static constexpr LobeClass lobe_class = LobeClass::cosine;
  static constexpr LobeUse use = LobeUse::always;

  template <class F, class Row>
  static Vec3<F> evaluate(const Row&, const Vec3<F>&, const Vec3<F>&, F, F) {
    return Vec3<F>::all(F(1.0f));
  }
};

/// f = reflectance / pi.
struct Lambertian : Matt {
  static constexpr std::string_view name = "lambertian", doc = "matt, equally bright from everywhere";
  using Lobes = std::tuple<LambertianLobe>;

  static std::vector<Field<Material>> fields() { return {field<reflectance>(), field<emission>()}; }
  static void lower(const Material&, auto& row) { row.template choose<LambertianLobe>(); }
};

}  // namespace glimt
