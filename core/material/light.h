#pragma once

#include "material/shared.h"

namespace glimt {

/// A lamp reflects nothing.
struct LampLobe {
  static constexpr LobeClass lobe_class = LobeClass::none;
  static constexpr LobeUse use = LobeUse::always;
};

struct Light : AnyMaterial {
  static constexpr std::string_view name = "light", doc = "lamp that reflects nothing";
  static constexpr LobeClass lobe_class = LobeClass::none;
  static constexpr bool emits = true;
  static constexpr Parameter<glm::dvec3> radiance{.key = "radiance",
                                                  .doc = "emitted from the front side, W/(m^2 sr)",
                                                  .fallback = glm::dvec3{20},
                                                  .max = 1e9,
                                                  .required = true};

  using Lobes = std::tuple<LampLobe>;

  static std::vector<Field<Material>> fields() { return {field<radiance>()}; }
  static glm::dvec3 albedo(const Material&) { return glm::dvec3{0}; }
  static glm::dvec3 radiance_of(const Material& m) { return m.get(radiance); }
  static void lower(const Material&, auto& row) { row.template choose<LampLobe>(); }
};

}  // namespace glimt
