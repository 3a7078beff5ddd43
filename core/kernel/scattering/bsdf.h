#pragma once

#include <numbers>

#include "math/warp.h"

/// Reflection and refraction. Directions point away from the surface, normals to the side they are on, unless said
/// otherwise.
namespace glimt {

/// A and B of the Oren-Nayar model, per lane; 1 and 0 for Lambertian.
template <class F>
struct OrenNayarFactors {
  F a, b;
  Mask<F> report;  ///< sin(beta) for tan(beta)
};

/// The BRDF over rho / pi: A + B max(0, cos(phi_i - phi_o)) sin(alpha) tan(beta), alpha the larger and beta the smaller
/// angle to the normal (Oren and Nayar 1994, eq. 30; the report's eq. 7 prints sin(beta)). No angle is computed: with s
/// = sin(theta_i) sin(theta_o) cos(phi_i - phi_o) = wi.wo - cos(theta_i) cos(theta_o), sin(alpha) tan(beta) cos(phi_i -
/// phi_o) is s over the larger cosine.
template <class F>
F oren_nayar_factor(const OrenNayarFactors<F>& m, const Vec3<F>& wi, const Vec3<F>& wo, F cos_i, F cos_o) {
  const F s = max(dot(wi, wo) - cos_i * cos_o, F(0.0f));
  const F larger_cos = max(max(cos_i, cos_o), F(1e-6f));
  return fma(m.b, select(m.report, s, s * reciprocal(larger_cos)), m.a);
}

/// Share of the light that EON's single bounce sends back towards a direction at that cosine, for reflectance 1
/// (Portsmouth, Kutz and Hill, "EON: a practical energy-preserving rough diffuse BRDF", JCGT 14(1), 2025: the exact
/// directional albedo of its FON part). `a` = 1 / (1 + (1/2 - 2/(3 pi)) roughness).
template <class F>
F eon_albedo(F cos, F a, F roughness) {
  const F sin = sqrt(max(fnma(cos, cos, F(1.0f)), F(0.0f)));
  const F angle = F(0.5f * std::numbers::pi_v<float>) - arcsine(cos);
  // sin/cos (1 - sin^3) without a quotient by the cosine.
  const F grazing = sin * cos * fma(sin, F(1.0f) + sin, F(1.0f)) * reciprocal(F(1.0f) + sin);
  const F g = fma(sin, fnma(sin, cos, angle), F(2.0f / 3.0f) * (grazing - sin));
  return a * fma(roughness * F(std::numbers::inv_pi_v<float>), g, F(1.0f));
}

/// EON's parameters, per lane.
template <class F>
struct EonFactors {
  F a, roughness;
  Vec3<F> multiple;  ///< weight of the light reflected many times, by channel; see material/eon.h
};

/// The BRDF over rho / pi: the FON part, A (1 + r s / t) with s as above and t the larger cosine where s > 0, else 1;
/// and the light that its single bounce loses, spread as (1 - E(wi)) (1 - E(wo)).
template <class F>
Vec3<F> eon_factor(const EonFactors<F>& m, const Vec3<F>& wi, const Vec3<F>& wo, F cos_i, F cos_o) {
  const F s = dot(wi, wo) - cos_i * cos_o;
  const F larger_cos = max(max(cos_i, cos_o), F(1e-6f));
  const F over_t = select(s > F(0.0f), s * reciprocal(larger_cos), s);
  const F single = m.a * fma(m.roughness, over_t, F(1.0f));
  const F lost = (F(1.0f) - eon_albedo(cos_i, m.a, m.roughness)) * (F(1.0f) - eon_albedo(cos_o, m.a, m.roughness));
  return fma(m.multiple, lost, Vec3<F>::all(single));
}

/// Where `direction`, moving towards the surface at that cosine to its normal, goes on after a mirror.
template <class F>
Vec3<F> reflect(const Vec3<F>& direction, const Vec3<F>& normal, F cos_i) {
  return fma(normal, cos_i + cos_i, direction);
}

/// A smooth surface between two dielectrics, for unpolarised light.
template <class F>
struct Dielectric {
  F reflected;  ///< share of the light, 0..1; 1 past the critical angle
  F cos_t;      ///< of the refracted direction to the normal; 0 past the critical angle
};

/// `cos_i` > 0 to the normal, `eta` = index on the other side over index on this side. Fresnel's equations, or
/// Schlick's approximation (1994), which takes the angle on the thinner side.
template <class F>
Dielectric<F> fresnel(F cos_i, F eta, F inverse_eta, const Mask<F>& schlick) {
  const F sin2_t = max(fnma(cos_i, cos_i, F(1.0f)), F(0.0f)) * (inverse_eta * inverse_eta);
  const Mask<F> total = sin2_t >= F(1.0f);
  const F cos_t = sqrt(F(1.0f) - sin2_t);
  const F perpendicular = (cos_i - eta * cos_t) * reciprocal(cos_i + eta * cos_t);
  const F parallel = (eta * cos_i - cos_t) * reciprocal(eta * cos_i + cos_t);
  const F exact = F(0.5f) * fma(perpendicular, perpendicular, parallel * parallel);
  const F root = (F(1.0f) - eta) * reciprocal(F(1.0f) + eta);
  const F r0 = root * root;
  const F m = F(1.0f) - select(eta < F(1.0f), cos_t, cos_i);
  const F m2 = m * m;
  const F approximate = fma(F(1.0f) - r0, m2 * m2 * m, r0);
  return {select(total, F(1.0f), select(schlick, approximate, exact)), select(total, F(0.0f), cos_t)};
}

/// Snell's law: where `direction`, moving against the normal, goes on behind the surface.
template <class F>
Vec3<F> refract(const Vec3<F>& direction, const Vec3<F>& normal, F cos_i, F cos_t, F inverse_eta) {
  return fma(normal, cos_i * inverse_eta - cos_t, direction * inverse_eta);
}

}  // namespace glimt
