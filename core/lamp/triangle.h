#pragma once

#include "lamp/flat.h"
#include "math/warp.h"

namespace glimt {

/// A triangle sampled by area.
struct TriangleLamp : FlatLamp {
  static constexpr bool by_area = true;

  double area() const { return parallelogram_area() / 2; }
  LampBody body() const { return {{corner, corner + edge_1, corner + edge_2}, 0, normal}; }

  template <class F, bool one>
  static LampPoint<F> point(const LampRow<F, one>& lamp, F u, F v) {
    const auto [a, b] = folded(u, v);
    return at(lamp, a, b);
  }

  template <class F>
  struct Place {
    F a, b;  ///< along the edges, a + b <= 1
  };
  /// Folds the unit square on its diagonal into the triangle.
  template <class F>
  static Place<F> folded(F u, F v) {
    F a = u, b = v;
    const Mask<F> fold = a + b > F(1.0f);
    a = select(fold, F(1.0f) - a, a);
    b = select(fold, F(1.0f) - b, b);
    return {a, b};
  }
};

/// How a point sees a triangle: C. Peters, "BRDF importance sampling for polygonal lights" (ACM Trans. Graph. 40(4),
/// 2021), section 4. The solid angle is 2 atan2(volume, moved + kept). Sampling cuts the triangle in two through the
/// corner `middle`.
template <class F>
struct TriangleView {
  Vec3<F> first, middle, last;  ///< unit vectors to the corners
  F volume;                     ///< volume of their parallelepiped
  F moved;                      ///< sum of the cosines of the angles between `last` and the others
  F kept;                       ///< 1 + cosine of the angle between the others
  F half_angle;                 ///< half of the solid angle, sr
  F height;                     ///< height of the point above the triangle's plane, metres; 0 behind it
  Mask<F> small;                ///< sampled by area
};

template <class F, bool one>
TriangleView<F> view_triangle(const LampRow<F, one>& lamp, const Vec3<F>& from) {
  const Vec3<F> way = lamp.vector(FlatColumn::corner_x) - from;
  TriangleView<F> t;
  t.first = normalize(way + lamp.vector(FlatColumn::edge_1_x));
  t.middle = normalize(way);
  t.last = normalize(way + lamp.vector(FlatColumn::edge_2_x));
  t.volume = abs(dot(t.first, cross(t.middle, t.last)));
  t.moved = dot(t.first, t.last) + dot(t.middle, t.last);
  t.kept = F(1.0f) + dot(t.first, t.middle);
  const F rest = t.moved + t.kept;
  const F over_length = inverse_sqrt(max(fma(rest, rest, t.volume * t.volume), F(1e-30f)));
  t.half_angle = angle_of(t.volume * over_length, rest * over_length);
  t.height = max(F(0.0f) - dot(way, lamp.vector(FlatColumn::normal_x)), F(0.0f));
  t.small = t.half_angle < F(0.5f * small_solid_angle);
  return t;
}

/// A triangle sampled by solid angle.
struct TriangleBySolidAngleLamp : TriangleLamp {
  static constexpr bool by_area = false;

  /// A point uniform in the triangle's solid angle; uniform by area where that is small.
  template <class F, bool one>
  static SeenLamp<F> sample(const LampRow<F, one>& lamp, const Vec3<F>& from, F u, F v) {
    const TriangleView<F> t = view_triangle(lamp, from);
    // Moves the corner `last` along its edge until the triangle has the share u of the solid angle.
    const auto [sin, cos] = sincos_turns(t.half_angle * u * F(0.5f * std::numbers::inv_pi_v<float>));
    const Vec3<F> half = fma(t.first, fnma(t.moved, sin, t.volume * cos), t.last * (t.kept * sin));
    const Vec3<F> corner = fma(half, F(2.0f) * dot(t.first, half) * reciprocal(dot(half, half)), t.first * F(-1.0f));
    // On the arc from `middle` to that corner, the cosine to `middle` is uniform.
    const F cos_end = dot(t.middle, corner);
    const F cos_here = fma(cos_end - F(1.0f), v, F(1.0f));
    const F square = fnma(cos_end, cos_end, F(1.0f));
    const F along =
        select(square > F(0.0f),
               sqrt(max(fnma(cos_here, cos_here, F(1.0f)), F(0.0f)) * reciprocal(max(square, F(1e-30f)))), v);
    const Vec3<F> direction = fma(corner, along, t.middle * fnma(along, cos_end, cos_here));
    // Where the direction meets the plane (Moeller and Trumbore 1997), clamped so that rounding cannot leave the lamp.
    const Vec3<F> e1 = lamp.vector(FlatColumn::edge_1_x), e2 = lamp.vector(FlatColumn::edge_2_x);
    const Vec3<F> way = from - lamp.vector(FlatColumn::corner_x), p = cross(direction, e2);
    const F over = reciprocal(dot(e1, p));
    const Place<F> by_area = folded(u, v);
    const F a = min(max(dot(way, p) * over, F(0.0f)), F(1.0f));
    const F b = min(max(dot(direction, cross(way, e1)) * over, F(0.0f)), F(1.0f) - a);
    SeenLamp<F> seen = see_point(from, at(lamp, select(t.small, by_area.a, a), select(t.small, by_area.b, b)));
    seen.inverse_pdf = select(t.small, seen.inverse_pdf * lamp[LampColumn::area_factor],
                              select(t.height > F(0.0f), F(2.0f) * t.half_angle, F(0.0f)));
    return seen;
  }

  /// 1 / (pdf_w inverse_choice) of a point at this distance, at which the lamp sees `from` under cos_lamp.
  template <class F, bool one>
  static F inverse_pdf(const LampRow<F, one>& lamp, const Vec3<F>& from, F distance, F cos_lamp) {
    const TriangleView<F> t = view_triangle(lamp, from);
    return select(t.small, cos_lamp * reciprocal(distance * distance) * lamp[LampColumn::area_factor],
                  F(2.0f) * t.half_angle);
  }
};

}  // namespace glimt
