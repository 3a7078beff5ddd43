#pragma once

#include "scene/fields.h"

/// What several materials have.
namespace glimt {

/// What a material writes into its own columns of the surface table (compile/compiled_scene.h). A matt material that
/// leaves all as they are is Lambertian.
struct SurfaceRow {
  double oren_nayar_a = 1, oren_nayar_b = 0;  ///< A and B of Oren-Nayar; A and roughness of EON
  bool oren_nayar_report = false;
  bool eon = false;
  glm::dvec3 eon_multiple{0};
  bool schlick = false;

  bool operator==(const SurfaceRow&) const = default;
};

/// What holds of a material that says nothing else.
struct AnyMaterial {
  static constexpr bool transmits = false, emits = false;
  static constexpr std::string_view feature = {};
  static glm::dvec3 radiance_of(const Material&) { return glm::dvec3{0}; }
  static double refractive_index(const Material&) { return 1; }
  static void lower(const Material&, SurfaceRow&) {}
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

/// A reflecting surface that scatters in all directions, and may glow.
struct Matt : Reflecting {
  static constexpr LobeClass lobe_class = LobeClass::cosine;
  static constexpr Parameter<glm::dvec3> emission{
      .key = "emission", .doc = "glow, not sampled as a lamp, W/(m^2 sr)", .max = 1e9};
  static glm::dvec3 radiance_of(const Material& m) { return m.get(emission); }
};

}  // namespace glimt
