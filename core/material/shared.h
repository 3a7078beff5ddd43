#pragma once

#include "material/lobe.h"

/// What several materials have in common.
namespace glimt {

/// The defaults of every material.
struct AnyMaterial {
  static constexpr bool transmits = false, emits = false;
  static glm::dvec3 radiance_of(const Material&) { return glm::dvec3{0}; }
  static double refractive_index(const Material&) { return 1; }
};

/// A surface that reflects a given share of the light.
struct Reflecting : AnyMaterial {
  static constexpr Parameter<glm::dvec3> reflectance{.key = "reflectance",
                                                     .doc = "share of the light that is reflected, per channel",
                                                     .fallback = glm::dvec3{0.75},
                                                     .max = 1,
                                                     .required = true};
  static glm::dvec3 albedo(const Material& m) { return m.get(reflectance); }
};

/// A diffuse surface: it scatters light in all directions, and it may glow.
struct Matt : Reflecting {
  static constexpr LobeClass lobe_class = LobeClass::cosine;
  static constexpr Parameter<glm::dvec3> emission{
      .key = "emission", .doc = "glow, not sampled as a lamp, W/(m^2 sr)", .max = 1e9};
  static glm::dvec3 radiance_of(const Material& m) { return m.get(emission); }
};

}  // namespace glimt
