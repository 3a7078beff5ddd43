#pragma once

#include <array>

#include "material/shared.h"

namespace glimt {

enum class Fresnel { exact, schlick };

struct Glass : AnyMaterial {
  static constexpr std::string_view name = "glass", doc = "smooth and clear, for closed shapes", feature = "glass";
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

  static std::vector<Field<Material>> fields() { return {field<ior>(), field<fresnel>()}; }
  static glm::dvec3 albedo(const Material&) { return glm::dvec3{1}; }
  static double refractive_index(const Material& m) { return m.get(ior); }
  static void lower(const Material& m, SurfaceRow& row) { row.schlick = m.get(fresnel) == Fresnel::schlick; }
};

}  // namespace glimt
