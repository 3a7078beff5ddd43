#pragma once

#include <numbers>

#include "math/vec.h"

/// Maps from the unit square to sampled points and directions.
namespace glimt {

template <class F>
struct SinCos {
  F sin, cos;
};

/// sin and cos of 2 pi u for u in [0, 1), each within 7e-7. Polynomials (Chebyshev fits on [-pi/2, pi/2]) give half the
/// angle, and the double-angle formulas the rest, so no range reduction is needed.
template <class F>
SinCos<F> sincos_turns(F u) {
  const F a = u - F(0.5f);  // half the angle is pi a, the angle itself is 2 pi u - pi
  const F q = a * a;
  const F sine = a * fma(q, fma(q, fma(q, fma(q, F(0.0776576623f), F(-0.598291278f)), F(2.55007744f)), F(-5.1677103f)),
                         F(3.14159274f));
  const F cosine =
      fma(q,
          fma(q, fma(q, fma(q, fma(q, F(-0.0243963245f), F(0.23493731f)), F(-1.33521199f)), F(4.05870914f)),
              F(-4.93480206f)),
          F(1.0f));
  return {F(-2.0f) * sine * cosine, fma(F(2.0f) * sine, sine, F(-1.0f))};
}

/// The angle in [-pi/2, pi/2] with sine x, for |x| <= 1, within 3e-7. Up to 1/2 it is a polynomial (fitted at Chebyshev
/// points), beyond that asin x = pi/2 - 2 asin sqrt((1 - x) / 2). The name asin would find xsimd's function for a
/// batch.
template <class F>
F arcsine(F x) {
  const F a = min(abs(x), F(1.0f));
  const Mask<F> large = a > F(0.5f);
  const F z = select(large, F(0.5f) * (F(1.0f) - a), a * a);
  const F s = select(large, sqrt(z), a);
  const F p = fma(z, fma(z, fma(z, fma(z, F(0.0382064655f), F(0.0264942702f)), F(0.0450107008f)), F(0.0749880895f)),
                  F(0.166666731f));
  const F angle = fma(s * z, p, s);
  const F result = select(large, fnma(F(2.0f), angle, F(0.5f * std::numbers::pi_v<float>)), angle);
  return select(x < F(0.0f), F(0.0f) - result, result);
}

/// The angle in [0, pi] with this sine and cosine.
template <class F>
F angle_of(F sin, F cos) {
  const F from_sin = arcsine(sin), pi(std::numbers::pi_v<float>);
  const F flat = select(cos < F(0.0f), pi - from_sin, from_sin);
  return select(sin < abs(cos), flat, F(0.5f) * pi - arcsine(cos));
}

/// A point on the unit sphere; pdf_w = 1 / (4 pi).
template <class F>
Vec3<F> uniform_sphere(F u, F v) {
  const F z = fma(F(-2.0f), u, F(1.0f));
  const F r = sqrt(fnma(z, z, F(1.0f)));
  const SinCos<F> turn = sincos_turns(v);
  return {r * turn.cos, r * turn.sin, z};
}

/// A direction about the unit normal n with pdf_w = cos(theta) / pi. Take the sphere that touches the surface from
/// above: the direction from the touching point to a uniform point of it is cosine-distributed. So n + uniform_sphere
/// needs no tangent frame. Lifting the sphere by a millionth gives its lowest point a direction too, and makes every
/// direction leave the surface.
template <class F>
Vec3<F> cosine_hemisphere(const Vec3<F>& n, F u, F v) {
  return normalize(fma(n, F(1.000001f), uniform_sphere(u, v)));
}

/// Right-handed axes whose z is a unit normal (Duff et al., "Building an orthonormal basis, revisited", JCGT 6(1),
/// 2017).
template <class F>
struct LocalFrame {
  Vec3<F> x, y, z;

  explicit LocalFrame(const Vec3<F>& normal) : z(normal) {
    const F sign = select(z.z < F(0.0f), F(-1.0f), F(1.0f));
    const F k = F(-1.0f) * reciprocal(sign + z.z);
    const F xy = z.x * z.y * k;
    x = {fma(sign * z.x, z.x * k, F(1.0f)), sign * xy, F(0.0f) - sign * z.x};
    y = {xy, fma(z.y, z.y * k, sign), F(0.0f) - z.y};
  }

  Vec3<F> to_local(const Vec3<F>& world) const { return {dot(x, world), dot(y, world), dot(z, world)}; }
  Vec3<F> to_world(const Vec3<F>& local) const { return fma(x, local.x, fma(y, local.y, z * local.z)); }
};

}  // namespace glimt
