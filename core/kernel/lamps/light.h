#pragma once

#include <numbers>

#include "compile/compiled_scene.h"
#include "math/sampler.h"
#include "math/warp.h"

namespace glimt {

/// A direction in which a lamp may be seen.
template <class F>
struct LampSample {
  Vec3<F> direction;                   ///< unit, from the shaded point
  F distance;                          ///< metres
  Vec3<F> weight;                      ///< times `inverse_pdf`: radiance over pdf_w, the choice of the lamp counted in
  F inverse_pdf;                       ///< 0 where the lamp shows its back
  F inverse_choice;                    ///< 1 / pdf_w = inverse_pdf * inverse_choice
  Int<F> first_surface, last_surface;  ///< the lamp's own, which cannot hide it
};

/// Which row of the lamp table is looked at in each lane. With a single row every lane has the same, and nothing is
/// looked up.
template <class F, bool one>
struct LampRow {
  const CompiledScene& scene;
  Int<F> row;

  F operator[](LampColumn column) const {
    const float* values = scene.lamps[column];
    if constexpr (one) {
      return F(values[0]);
    } else {
      return lookup(values, row);
    }
  }
  Vec3<F> vector(LampColumn first) const {
    const int c = static_cast<int>(first);
    return {(*this)[first], (*this)[static_cast<LampColumn>(c + 1)], (*this)[static_cast<LampColumn>(c + 2)]};
  }
};

/// table[index]; `few`: no more entries than lookup_small can hold.
template <class F, bool few>
F lookup_in(const float* table, const Int<F>& index) {
  if constexpr (few) return lookup_small(table, index);
  return lookup(table, index);
}

/// A row of a table of `count`, by the alias method.
template <class F, bool few = false>
Int<F> choose_row(const float* alias_threshold, const float* alias_other, int count, F u) {
  const F place = u * F(static_cast<float>(count));
  const F last(static_cast<float>(count - 1));
  const Int<F> entry = to_int(min(place, last));
  const F rest = place - to_float(entry);
  const Mask<F> keep = rest < lookup_in<F, few>(alias_threshold, entry);
  return select(keep, entry, as_int(lookup_in<F, few>(alias_other, entry)));
}

/// A lamp in proportion to its power.
template <class F>
Int<F> choose_lamp(const CompiledScene& scene, F u) {
  return choose_row(scene.lamps[LampColumn::alias_threshold], scene.lamps[LampColumn::alias_other], scene.lamps.rows(),
                    u);
}

template <class F>
struct SurfacePoint {
  Vec3<F> point, normal;
};

/// A point of a flat lamp, uniform by area.
template <class F, bool one>
SurfacePoint<F> flat_lamp_point(const LampRow<F, one>& lamp, F u, F v, bool triangles) {
  F a = u, b = v;
  if (triangles) {
    // The square folded on its diagonal is the triangle.
    const Int<F> shape = as_int(lamp[LampColumn::shape]);
    const Mask<F> fold = equal(shape, Int<F>(static_cast<int>(LampShape::triangle))) & (a + b > F(1.0f));
    a = select(fold, F(1.0f) - a, a);
    b = select(fold, F(1.0f) - b, b);
  }
  return {fma(lamp.vector(LampColumn::e1_x), a, fma(lamp.vector(LampColumn::e2_x), b, lamp.vector(LampColumn::p_x))),
          lamp.vector(LampColumn::normal_x)};
}

/// A point of a spherical lamp, uniform by area.
template <class F, bool one>
SurfacePoint<F> sphere_lamp_point(const LampRow<F, one>& lamp, F u, F v) {
  const Vec3<F> normal = uniform_sphere(u, v);
  return {fma(normal, lamp[LampColumn::e1_x], lamp.vector(LampColumn::p_x)), normal};
}

/// A point of any lamp, uniform by area.
template <class F, bool one>
SurfacePoint<F> lamp_point(const LampRow<F, one>& lamp, F u, F v) {
  const auto has = [&](LampShape s) { return lamp.scene.has_lamp_shape[static_cast<std::size_t>(s)]; };
  const SurfacePoint<F> flat = flat_lamp_point(lamp, u, v, has(LampShape::triangle));
  if (!has(LampShape::sphere) && !has(LampShape::sphere_by_area)) return flat;
  const SurfacePoint<F> round = sphere_lamp_point(lamp, u, v);
  const Int<F> shape = as_int(lamp[LampColumn::shape]);
  const Mask<F> sphere = equal(shape, Int<F>(static_cast<int>(LampShape::sphere))) |
                         equal(shape, Int<F>(static_cast<int>(LampShape::sphere_by_area)));
  return {select(sphere, round.point, flat.point), select(sphere, round.normal, flat.normal)};
}

/// Over inverse_choice, the 1 / pdf_a of these points: lamps that light sampling chooses points of by solid angle have
/// only their choice in inverse_choice.
template <class F, bool one>
F area_left_out(const LampRow<F, one>& lamp) {
  const auto has = [&](LampShape s) { return lamp.scene.has_lamp_shape[static_cast<std::size_t>(s)]; };
  const auto is = [&](LampShape s) {
    return equal(as_int(lamp[LampColumn::shape]), Int<F>(static_cast<std::int32_t>(s)));
  };
  F area(1.0f);
  if (has(LampShape::rectangle))
    area = select(is(LampShape::rectangle), lamp[LampColumn::length_1] * lamp[LampColumn::length_2], area);
  if (has(LampShape::sphere)) {
    const F radius = lamp[LampColumn::e1_x];
    area = select(is(LampShape::sphere), F(4 * std::numbers::pi_v<float>) * (radius * radius), area);
  }
  return area;
}

/// How `from` sees a point that is uniform by area (the report's eq. 15): pdf_w = distance^2 / (area cos).
template <class F, bool one>
LampSample<F> see_point(const LampRow<F, one>& lamp, const Vec3<F>& from, const SurfacePoint<F>& at) {
  const Vec3<F> way = at.point - from;
  const F distance2 = dot(way, way);
  const F inverse = inverse_sqrt(distance2);
  const Vec3<F> direction = way * inverse;
  const F minus_cos_lamp = dot(direction, at.normal);
  const F inverse_pdf = max(F(0.0f) - minus_cos_lamp, F(0.0f)) * (inverse * inverse);
  return {direction,
          distance2 * inverse,
          lamp.vector(LampColumn::weight_r),
          inverse_pdf,
          lamp[LampColumn::inverse_choice],
          Int<F>(0),
          Int<F>(0)};
}

/// A point of a flat lamp, uniform by area.
template <class F, bool one>
LampSample<F> sample_flat_lamp(const LampRow<F, one>& lamp, const Vec3<F>& from, F u, F v, bool triangles) {
  return see_point(lamp, from, flat_lamp_point(lamp, u, v, triangles));
}

/// How a point in front of a rectangle sees it: Urena, Fajardo and King, "An area-preserving parametrization for
/// spherical rectangles" (EGSR 2013), whose names these are. The local frame has z along the lamp's normal.
template <class F>
struct RectangleView {
  F x0, x1, y0, y1, z0;  ///< edges of the rectangle, metres; z0 < 0 in front of it
  F b0, b1;              ///< z of the normals of the planes through y0 and y1
  F start;               ///< pi - k
  F solid_angle;
  Mask<F> small;  ///< too small for its solid angle to be a sum of angles without loss: sampled by area
};

template <class F, bool one>
RectangleView<F> view_rectangle(const LampRow<F, one>& lamp, const Vec3<F>& from) {
  const Vec3<F> d = lamp.vector(LampColumn::p_x) - from;
  const F l1 = lamp[LampColumn::length_1], l2 = lamp[LampColumn::length_2];
  RectangleView<F> r;
  r.x0 = dot(d, lamp.vector(LampColumn::e1_x)) * reciprocal(l1);
  r.y0 = dot(d, lamp.vector(LampColumn::e2_x)) * reciprocal(l2);
  r.x1 = r.x0 + l1;
  r.y1 = r.y0 + l2;
  r.z0 = min(dot(d, lamp.vector(LampColumn::normal_x)), F(0.0f));
  const F z2 = max(r.z0 * r.z0, F(1e-30f));
  const auto normal_z = [&](F edge) { return edge * inverse_sqrt(fma(edge, edge, z2)); };
  r.b0 = F(0.0f) - normal_z(r.y0);
  r.b1 = normal_z(r.y1);
  const F n1 = normal_z(r.x1), n3 = F(0.0f) - normal_z(r.x0);
  // The paper's angles are pi/2 + these, so that their sum needs no 2 pi taken off.
  const F g0 = arcsine(r.b0 * n1), g1 = arcsine(n1 * r.b1), g2 = arcsine(r.b1 * n3), g3 = arcsine(n3 * r.b0);
  r.start = g2 + g3;
  r.solid_angle = g0 + g1 + r.start;
  r.small = r.solid_angle < F(0.02f);
  return r;
}

/// A point of a rectangle, uniform in the solid angle it is seen under; by area where that is small.
template <class F, bool one>
LampSample<F> sample_rectangle(const LampRow<F, one>& lamp, const Vec3<F>& from, F u, F v) {
  const RectangleView<F> r = view_rectangle(lamp, from);
  const F l1 = lamp[LampColumn::length_1], l2 = lamp[LampColumn::length_2];
  // x: the paper's f_u is minus (cos(a) b0 + b1) / sin(a) with a = pi - a_u, multiplied out.
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
  LampSample<F> sample = sample_flat_lamp(lamp, from, s, t, false);
  const F area = l1 * l2;
  const F by_area = sample.inverse_pdf * area;
  sample.inverse_pdf = select(r.small, by_area, select(by_area > F(0.0f), r.solid_angle, F(0.0f)));
  return sample;
}

/// 1 - cos of half the angle that the cone of a sphere has; without cancellation for small spheres.
template <class F>
F cone_one_minus_cos(F sin2) {
  return sin2 * reciprocal(F(1.0f) + sqrt(F(1.0f) - sin2));
}

/// The cone in which a sphere is seen.
template <class F>
struct SphereCone {
  Vec3<F> axis;        ///< unit, to the centre
  F distance, radius;  ///< to the centre, metres; NaN at the centre
  F one_minus_cos_max;
  F solid_angle;
  Mask<F> outside;  ///< the sphere is seen from outside

  /// A direction, and the distance to the sphere along it.
  struct Sample {
    Vec3<F> direction;
    F distance;
  };

  /// Uniform by solid angle.
  Sample sample(F u, F v) const {
    const F one_minus_cos = u * one_minus_cos_max;
    const F cos = F(1.0f) - one_minus_cos;
    const F sin2 = one_minus_cos * (F(1.0f) + cos);
    const F sin = sqrt(sin2);
    const Frame<F> frame(axis);
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

/// A direction to a spherical lamp, uniform by solid angle: pdf_w = 1 / (2 pi (1 - cos(theta_max))).
template <class F, bool one>
LampSample<F> sample_sphere_lamp(const LampRow<F, one>& lamp, const Vec3<F>& from, F u, F v) {
  const SphereCone<F> cone = cone_of_sphere(lamp.vector(LampColumn::p_x) - from, lamp[LampColumn::e1_x]);
  const auto [direction, distance] = cone.sample(u, v);
  return {direction,
          distance,
          lamp.vector(LampColumn::weight_r),
          select(cone.outside, cone.solid_angle, F(0.0f)),
          lamp[LampColumn::inverse_choice],
          Int<F>(0),
          Int<F>(0)};
}

/// A point of a sphere, uniform by area: half of them are on its far side.
template <class F, bool one>
LampSample<F> sample_sphere_by_area(const LampRow<F, one>& lamp, const Vec3<F>& from, F u, F v) {
  return see_point(lamp, from, sphere_lamp_point(lamp, u, v));
}

/// The table's row decides how the lamp is sampled.
template <class F, bool one>
LampSample<F> sample_row(const LampRow<F, one>& lamp, const Vec3<F>& from, F u, F v) {
  const auto has = [&](LampShape s) { return lamp.scene.has_lamp_shape[static_cast<std::size_t>(s)]; };
  const Int<F> shape = as_int(lamp[LampColumn::shape]);
  LampSample<F> sample{};
  bool first = true;
  const auto take = [&](const LampSample<F>& other, const Mask<F>& mask) {
    sample.direction = first ? other.direction : select(mask, other.direction, sample.direction);
    sample.distance = first ? other.distance : select(mask, other.distance, sample.distance);
    sample.inverse_pdf = first ? other.inverse_pdf : select(mask, other.inverse_pdf, sample.inverse_pdf);
    first = false;
  };
  const auto is = [&](LampShape s) { return equal(shape, Int<F>(static_cast<int>(s))); };
  if (has(LampShape::parallelogram) || has(LampShape::triangle)) {
    const bool triangles = has(LampShape::triangle);
    take(sample_flat_lamp(lamp, from, u, v, triangles), is(LampShape::parallelogram) | is(LampShape::triangle));
  }
  if (has(LampShape::rectangle)) take(sample_rectangle(lamp, from, u, v), is(LampShape::rectangle));
  if (has(LampShape::sphere)) take(sample_sphere_lamp(lamp, from, u, v), is(LampShape::sphere));
  if (has(LampShape::sphere_by_area)) take(sample_sphere_by_area(lamp, from, u, v), is(LampShape::sphere_by_area));
  sample.weight = lamp.vector(LampColumn::weight_r);
  sample.inverse_choice = lamp[LampColumn::inverse_choice];
  sample.first_surface = as_int(lamp[LampColumn::first_surface]);
  sample.last_surface = as_int(lamp[LampColumn::last_surface]);
  return sample;
}

/// 1 / pdf_w with which light sampling from `from` chooses a point that it can choose: one of the lamp piece in `row`,
/// at that distance, seen by the lamp at that cosine.
template <class F>
F lamp_inverse_pdf(const CompiledScene& scene, const Int<F>& row, const Vec3<F>& from, F distance, F cos_lamp) {
  const LampRow<F, false> lamp{scene, row};
  const auto has = [&](LampShape s) { return scene.has_lamp_shape[static_cast<std::size_t>(s)]; };
  const Int<F> shape = as_int(lamp[LampColumn::shape]);
  F inverse_pdf = cos_lamp * reciprocal(distance * distance);  // by area
  if (has(LampShape::rectangle)) {
    const RectangleView<F> r = view_rectangle(lamp, from);
    const F area = lamp[LampColumn::length_1] * lamp[LampColumn::length_2];
    inverse_pdf = select(equal(shape, Int<F>(static_cast<int>(LampShape::rectangle))),
                         select(r.small, inverse_pdf * area, r.solid_angle), inverse_pdf);
  }
  if (has(LampShape::sphere)) {
    const Vec3<F> to_centre = lamp.vector(LampColumn::p_x) - from;
    const F radius = lamp[LampColumn::e1_x];
    const F sin2 = min(radius * radius * reciprocal(dot(to_centre, to_centre)), F(1.0f));
    inverse_pdf = select(equal(shape, Int<F>(static_cast<int>(LampShape::sphere))),
                         F(2.0f * std::numbers::pi_v<float>) * cone_one_minus_cos(sin2), inverse_pdf);
  }
  return inverse_pdf * lamp[LampColumn::inverse_choice];
}

/// A direction towards a lamp. `choice` is used only where there are several; `one_parallelogram`: it is the only lamp,
/// sampled by area.
template <class F, bool one_parallelogram>
LampSample<F> sample_lamp(const CompiledScene& scene, const Vec3<F>& from, F choice, F u, F v) {
  const LampRow<F, true> first{scene, Int<F>(0)};
  if constexpr (one_parallelogram) return sample_flat_lamp(first, from, u, v, false);
  if (scene.lamps.rows() == 1) return sample_row(first, from, u, v);
  return sample_row(LampRow<F, false>{scene, choose_lamp(scene, choice)}, from, u, v);
}

}  // namespace glimt
