#pragma once

#include <array>

#include "material/ggx.h"
#include "material/mirror.h"

namespace glimt {

/// The share of unpolarised light that a smooth metal reflects, for one wavelength: Fresnel's equations with the
/// complex index eta + i k relative to the outside (Born and Wolf, "Principles of Optics", ch. 14).
template <class F>
F conductor_fresnel(F cos, F eta, F k) {
  const F cos2 = cos * cos, sin2 = max(F(1.0f) - cos2, F(0.0f));
  const F eta2 = eta * eta, k2 = k * k;
  const F difference = eta2 - k2 - sin2;
  const F sum = sqrt(fma(difference, difference, F(4.0f) * eta2 * k2));
  // (sum + difference) / 2, without the cancellation where the difference is negative.
  const F half = select(difference > F(0.0f), F(0.5f) * (sum + difference),
                        F(2.0f) * eta2 * k2 * reciprocal(max(sum - difference, F(1e-30f))));
  const F across = sum + cos2, twice = F(2.0f) * cos * sqrt(half);
  const F perpendicular = (across - twice) * reciprocal(across + twice);
  const F along = fma(cos2, sum, sin2 * sin2), part = twice * sin2;
  const F parallel = perpendicular * (along - part) * reciprocal(along + part);
  return F(0.5f) * (perpendicular + parallel);
}

template <class F>
Vec3<F> conductor_fresnel(const Vec3<F>& eta, const Vec3<F>& k, F cos) {
  return {conductor_fresnel(cos, eta.x, k.x), conductor_fresnel(cos, eta.y, k.y), conductor_fresnel(cos, eta.z, k.z)};
}

/// A polished metal.
struct SmoothConductorLobe {
  static constexpr std::string_view feature = "metal";
  enum Columns { eta_r, eta_g, eta_b, k_r, k_g, k_b, column_count };
  static constexpr LobeClass lobe_class = LobeClass::delta;
  static constexpr LobeUse use = LobeUse::seldom;
  static constexpr bool weighs = true, transmits = false, connects = false;

  template <class F, class Row>
  static ScatterSample<F> sample(const Row& row, const Vec3<F>& wo, F, F, F) {
    return {mirrored(wo, row.at.normal, row.at.cos_o),
            conductor_fresnel(row.vector(eta_r), row.vector(k_r), row.at.cos_o),
            F(0.0f),
            no_lanes<F>(),
            F(1.0f),
            F(1.0f)};
  }
};

/// A metal of microscopic mirrors whose normals follow GGX. Light that one mirror sends to another is lost.
struct RoughConductorLobe {
  static constexpr std::string_view feature = "rough metal";
  enum Columns { alpha, eta_r, eta_g, eta_b, k_r, k_g, k_b, column_count };
  static constexpr LobeClass lobe_class = LobeClass::glossy;
  static constexpr LobeUse use = LobeUse::seldom;
  static constexpr bool weighs = true, transmits = false, connects = false;

  template <class F, class Row>
  static ScatterSample<F> sample(const Row& row, const Vec3<F>& wo_world, F u, F v, F) {
    const LocalFrame<F> frame(row.at.normal);
    const Vec3<F> wo = frame.to_local(wo_world);
    const Ggx<F> ggx{row(alpha)};
    const Vec3<F> m = ggx.visible_normal(wo, u, v);
    const F cos = max(dot(wo, m), F(0.0f)), cos_o = max(wo.z, F(1e-7f));
    const Vec3<F> wi = fma(m, cos + cos, wo * F(-1.0f));
    const F left = select(wi.z > F(0.0f), ggx.unmasked(wi.z, cos_o), F(0.0f));
    return {normalize(frame.to_world(wi)),
            conductor_fresnel(row.vector(eta_r), row.vector(k_r), cos) * left,
            F(0.5f) * ggx.visible_density(m, cos_o),
            no_lanes<F>(),
            F(1.0f),
            F(1.0f)};
  }

  template <class F, class Row>
  static Vec3<F> evaluate(const Row& row, const Vec3<F>& wi_world, const Vec3<F>& wo_world, F cos_i, F cos_o) {
    const LocalFrame<F> frame(row.at.normal);
    const Ggx<F> ggx{row(alpha)};
    const Vec3<F> m = normalize(frame.to_local(wi_world + wo_world));
    const F f = F(std::numbers::pi_v<float>) * ggx.density(m) * ggx.visibility(cos_i, cos_o);
    const F cos = max(dot(wo_world, frame.to_world(m)), F(0.0f));
    return conductor_fresnel(row.vector(eta_r), row.vector(k_r), cos) *
           select((cos_i > F(0.0f)) & (cos_o > F(0.0f)), f, F(0.0f));
  }

  template <class F, class Row>
  static F pdf_w(const Row& row, const Vec3<F>& wi_world, const Vec3<F>& wo_world, F cos_i, F cos_o) {
    const Ggx<F> ggx{row(alpha)};
    const Vec3<F> m = normalize(LocalFrame<F>(row.at.normal).to_local(wi_world + wo_world));
    return select(cos_i > F(0.0f), F(0.5f) * ggx.visible_density(m, max(cos_o, F(1e-7f))), F(0.0f));
  }
};

/// Metals by name; `given`: eta and k give the index.
enum class Metal { given, gold, silver, copper, aluminium, iron };

struct Conductor : AnyMaterial {
  static constexpr std::string_view name = "conductor", doc = "metal, from polished to brushed";
  static constexpr LobeClass lobe_class = LobeClass::glossy;
  using Lobes = std::tuple<SmoothConductorLobe, RoughConductorLobe>;

  struct Index {
    glm::dvec3 eta, k;
  };
  /// Measured values at 650, 550 and 450 nm, from refractiveindex.info: Rakic, Djurisic, Elazar and Majewski, "Optical
  /// properties of metallic films", Applied Optics 37 (1998); iron from Johnson and Christy, Physical Review B 9
  /// (1974).
  static constexpr std::array<Index, 6> indices{{{},
                                                 {{0.18299, 0.42108, 1.3734}, {3.4242, 2.3459, 1.7704}},
                                                 {{0.15943, 0.14512, 0.13547}, {3.9291, 3.1900, 2.3808}},
                                                 {{0.27105, 0.67693, 1.3164}, {3.6092, 2.6248, 2.2921}},
                                                 {{1.3456, 0.96521, 0.61722}, {7.4746, 6.3995, 5.3031}},
                                                 {{2.9114, 2.9497, 2.5845}, {3.0893, 2.9318, 2.7670}}}};
  static constexpr std::array<std::string_view, 6> metals{"given", "gold", "silver", "copper", "aluminium", "iron"};
  static constexpr Parameter<Metal> preset{
      .key = "preset", .doc = "a metal whose index is known, or given: eta and k as they stand", .names = metals};
  static constexpr Parameter<glm::dvec3> eta{
      .key = "eta", .doc = "refractive index over the outside's, per channel", .fallback = indices[1].eta, .max = 100};
  static constexpr Parameter<glm::dvec3> k{.key = "k",
                                           .doc = "extinction coefficient over the outside's index, per channel",
                                           .fallback = indices[1].k,
                                           .max = 100};
  static constexpr Parameter<double> roughness = ggx_roughness;

  static std::vector<Field<Material>> fields() {
    return {field<preset>(), field<eta>(), field<k>(), field<roughness>()};
  }
  static glm::dvec3 albedo(const Material&) { return glm::dvec3{1}; }
  static void lower(const Material& m, auto& row) {
    const auto metal = static_cast<std::size_t>(m.get(preset));
    const Index n = metal == 0 ? Index{m.get(eta), m.get(k)} : indices[metal];
    const double alpha = ggx_alpha(m.get(roughness));
    if (alpha < smallest_alpha)
      return row.template choose<SmoothConductorLobe>(n.eta.r, n.eta.g, n.eta.b, n.k.r, n.k.g, n.k.b);
    row.template choose<RoughConductorLobe>(alpha, n.eta.r, n.eta.g, n.eta.b, n.k.r, n.k.g, n.k.b);
  }
};

}  // namespace glimt
