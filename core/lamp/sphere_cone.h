#pragma once

#include <numbers>

#include "math/warp.h"

namespace glimt {

/// 1 - cos of a cone's half angle, from its squared sine; without cancellation for small cones.
template <class F>
F cone_one_minus_cos(F sin2) {
  return sin2 * reciprocal(F(1.0f) + sqrt(F(1.0f) - sin2));
}

/// The cone of directions in which a sphere is seen.
template <class F>
struct SphereCone {
  Vec3<F> axis;        ///< unit, to the centre
  F distance, radius;  ///< to the centre, metres; NaN at the centre
  F one_minus_cos_max;
  F solid_angle;
  Mask<F> outside;  ///< the sphere is seen from outside

  /// A direction and the distance to the sphere along it.
  struct Sample {
    Vec3<F> direction;
    F distance;
  };

  /// A direction uniform in the cone's solid angle.
  Sample sample(F u, F v) const {
    const F one_minus_cos = u * one_minus_cos_max;
    const F cos = F(1.0f) - one_minus_cos;
    const F sin2 = one_minus_cos * (F(1.0f) + cos);
    const F sin = sqrt(sin2);
    const LocalFrame<F> frame(axis);
    const SinCos<F> turn = sincos_turns(v);
    const Vec3<F> direction = frame.to_world({sin * turn.cos, sin * turn.sin, cos});
    const F half_chord = sqrt(radius * radius - distance * distance * sin2);
    return {direction, max(fma(distance, cos, F(0.0f) - half_chord), F(0.0f))};
  }
};

template <class F>
SphereCone<F> cone_of_sphere(const Vec3<F>& to_centre, F radius) {
  const F d2 = dot(to_centre, to_centre);
  const F inverse_d = inverse_sqrt(d2);
  const F d = d2 * inverse_d;
  const F sin_max = radius * inverse_d;
  const F one_minus_cos_max = cone_one_minus_cos(min(sin_max * sin_max, F(1.0f)));
  return {to_centre * inverse_d,
          d,
          radius,
          one_minus_cos_max,
          F(2.0f * std::numbers::pi_v<float>) * one_minus_cos_max,
          d > radius};
}

}  // namespace glimt
