#pragma once

#include "material/shared.h"

namespace glimt {

/// The mirror direction of wo. It is normalised, because in a hollow mirror an error of its length grows at every hit.
template <class F>
Vec3<F> mirrored(const Vec3<F>& wo, const Vec3<F>& normal, F cos_o) {
  return normalize(fma(normal, cos_o + cos_o, wo * F(-1.0f)));
}

/// A perfect mirror.
struct MirrorLobe {
  static constexpr std::string_view feature = "mirror reflection";
  static constexpr LobeClass lobe_class = LobeClass::delta;
  static constexpr LobeUse use = LobeUse::always;
  static constexpr bool weighs = false, transmits = false, connects = true;

  template <class F, class Row>
  static ScatterSample<F> sample(const Row& row, const Vec3<F>& wo, F, F, F) {
    return {mirrored(wo, row.at.normal, row.at.cos_o), Vec3<F>::all(F(1.0f)), F(0.0f), no_lanes<F>(), F(1.0f), F(1.0f)};
  }
};

struct Mirror : Reflecting {
  static constexpr std::string_view name = "mirror", doc = "perfect mirror";
  static constexpr LobeClass lobe_class = LobeClass::delta;
  using Lobes = std::tuple<MirrorLobe>;

  static std::vector<Field<Material>> fields() { return {field<reflectance>()}; }
  static void lower(const Material&, auto& row) { row.template choose<MirrorLobe>(); }
};

}  // namespace glimt
