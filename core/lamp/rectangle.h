#pragma once

#include <numbers>

#include "lamp/flat.h"
#include "math/warp.h"

namespace glimt {

enum class RectangleColumn { length_1 = static_cast<int>(FlatColumn::count), length_2, count };

/// How a point in front of a rectangle sees it, with the names of Urena, Fajardo and King, "An area-preserving
/// parametrization for spherical rectangles" (EGSR 2013). The local frame has z along the lamp's normal.
template <class F>
struct RectangleView {
  F x0, x1, y0, y1, z0;  ///< edges of the rectangle, metres; z0 < 0 in front of it
  F b0, b1;              ///< z of the normals of the planes through y0 and y1
  F start;               ///< pi - k
  F solid_angle;
  Mask<F> small;  ///< the solid angle is below small_solid_angle: sampled by area
};

template <class F, bool one>
RectangleView<F> view_rectangle(const LampRow<F, one>& lamp, const Vec3<F>& from) {
  const Vec3<F> d = lamp.vector(FlatColumn::corner_x) - from;
  const F l1 = lamp[RectangleColumn::length_1], l2 = lamp[RectangleColumn::length_2];
  RectangleView<F> r;
  r.x0 = dot(d, lamp.vector(FlatColumn::edge_1_x)) * reciprocal(l1);
  r.y0 = dot(d, lamp.vector(FlatColumn::edge_2_x)) * reciprocal(l2);
  r.x1 = r.x0 + l1;
  r.y1 = r.y0 + l2;
  r.z0 = min(dot(d, lamp.vector(FlatColumn::normal_x)), F(0.0f));
  const F z2 = max(r.z0 * r.z0, F(1e-30f));
  const auto normal_z = [&](F edge) { return edge * inverse_sqrt(fma(edge, edge, z2)); };
  r.b0 = F(0.0f) - normal_z(r.y0);
  r.b1 = normal_z(r.y1);
  const F n1 = normal_z(r.x1), n3 = F(0.0f) - normal_z(r.x0);
  // The paper's angles are pi/2 more than these, so here no 2 pi is subtracted from the sum.
  const F g0 = arcsine(r.b0 * n1), g1 = arcsine(n1 * r.b1), g2 = arcsine(r.b1 * n3), g3 = arcsine(n3 * r.b0);
  r.start = g2 + g3;
  r.solid_angle = g0 + g1 + r.start;
  r.small = r.solid_angle < F(small_solid_angle);
  return r;
}

/// A parallelogram with right angles, sampled by solid angle.
struct RectangleLamp : FlatLamp {
  static constexpr bool by_area = false;

  double area() const { return parallelogram_area(); }
  LampBody body() const { return {{corner, corner + edge_1, corner + edge_1 + edge_2, corner + edge_2}, 0, normal}; }
  void lower(const LampRowWriter& row) const {
    FlatLamp::lower(row);
    row.set(RectangleColumn::length_1, length(edge_1));
    row.set(RectangleColumn::length_2, length(edge_2));
  }

  template <class F, bool one>
  static LampPoint<F> point(const LampRow<F, one>& lamp, F u, F v) {
    return at(lamp, u, v);
  }

  /// A point uniform in the rectangle's solid angle; uniform by area where that is small.
  template <class F, bool one>
  static SeenLamp<F> sample(const LampRow<F, one>& lamp, const Vec3<F>& from, F u, F v) {
    const RectangleView<F> r = view_rectangle(lamp, from);
    const F l1 = lamp[RectangleColumn::length_1], l2 = lamp[RectangleColumn::length_2];
    // x: the paper's f_u is -(cos(a) b0 + b1) / sin(a) with a = pi - a_u; here without that division.
    const F a = fnma(u, r.solid_angle, r.start);
    const SinCos<F> turned = sincos_turns(fma(a, F(0.5f * std::numbers::inv_pi_v<float>), F(0.5f)));  // of a + pi
    const F top = fma(turned.cos, r.b0, F(0.0f) - r.b1);
    const F z2 = r.z0 * r.z0;
    const F square = fnma(turned.sin * turned.sin, z2 * reciprocal(fma(r.y0, r.y0, max(z2, F(1e-30f)))), top * top);
    const F slope = turned.sin * inverse_sqrt(max(square, F(1e-30f)));
    const F x = min(max(select(top < F(0.0f), F(0.0f) - slope, slope) * r.z0, r.x0), r.x1);
    // y
    const F d2 = fma(x, x, z2);
    const F h0 = r.y0 * inverse_sqrt(max(fma(r.y0, r.y0, d2), F(1e-30f)));
    const F h1 = r.y1 * inverse_sqrt(max(fma(r.y1, r.y1, d2), F(1e-30f)));
    const F h = fma(v, h1 - h0, h0);
    const F rest = max(fnma(h, h, F(1.0f)), F(1e-12f));
    const F y = min(max(h * sqrt(d2 * reciprocal(rest)), r.y0), r.y1);

    const F s = select(r.small, u, (x - r.x0) * reciprocal(l1));
    const F t = select(r.small, v, (y - r.y0) * reciprocal(l2));
    SeenLamp<F> seen = see_point(from, at(lamp, s, t));
    const F by_area = seen.inverse_pdf * (l1 * l2);
    seen.inverse_pdf = select(r.small, by_area, select(by_area > F(0.0f), r.solid_angle, F(0.0f)));
    return seen;
  }

  /// 1 / (pdf_w inverse_choice) of a point at this distance, at which the lamp sees `from` under cos_lamp.
  template <class F, bool one>
  static F inverse_pdf(const LampRow<F, one>& lamp, const Vec3<F>& from, F distance, F cos_lamp) {
    const RectangleView<F> r = view_rectangle(lamp, from);
    const F area = lamp[RectangleColumn::length_1] * lamp[RectangleColumn::length_2];
    return select(r.small, cos_lamp * reciprocal(distance * distance) * area, r.solid_angle);
  }
};

}  // namespace glimt
