#pragma once

#include "math/vec.h"

/// Reflection and refraction where two dielectrics meet.
namespace glimt {

/// A smooth surface between two dielectrics, for unpolarised light.
template <class F>
struct Dielectric {
  F reflected;  ///< reflected share of the light, 0..1; 1 beyond the critical angle
  F cos_t;      ///< cosine of the refracted direction to the normal; 0 beyond the critical angle
};

/// Fresnel's equations, or Schlick's approximation (1994) with the angle on the side of the smaller index. `cos_i` > 0
/// is the cosine to the normal, `eta` the index on the other side divided by the index on this side.
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

/// Snell's law: the direction behind the surface of light that arrives along `direction`, against the normal.
template <class F>
Vec3<F> refract(const Vec3<F>& direction, const Vec3<F>& normal, F cos_i, F cos_t, F inverse_eta) {
  return fma(normal, cos_i * inverse_eta - cos_t, direction * inverse_eta);
}

}  // namespace glimt
