#pragma once

#include <numbers>

#include "math/sampler.h"
#include "math/warp.h"
#include "scene/compiled_scene.h"

namespace glimt {

/// A direction in which a lamp may be seen.
template <class F>
struct LampSample {
  Vec3<F> direction;                   ///< unit, from the shaded point
  F distance;                          ///< metres
  Vec3<F> weight;                      ///< times `inverse_pdf`: radiance over pdf_w, the choice of the lamp counted in
  F inverse_pdf;                       ///< 0 where the lamp shows its back
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

/// A lamp chosen in proportion to its power by the alias method.
template <class F>
Int<F> choose_lamp(const CompiledScene& scene, F u) {
  const int count = scene.lamps.rows();
  const F place = u * F(static_cast<float>(count));
  const F last(static_cast<float>(count - 1));
  const Int<F> entry = to_int(min(place, last));
  const F rest = place - to_float(entry);
  const Mask<F> keep = rest < lookup(scene.lamps[LampColumn::alias_threshold], entry);
  return select(keep, entry, as_int(lookup(scene.lamps[LampColumn::alias_other], entry)));
}

/// A point of a flat lamp, uniform by area (the report's eq. 15): pdf_w = distance^2 / (area cos).
template <class F, bool one>
LampSample<F> sample_flat_lamp(const LampRow<F, one>& lamp, const Vec3<F>& from, F u, F v, bool triangles) {
  F a = u, b = v;
  if (triangles) {
    // The square folded on its diagonal is the triangle.
    const Int<F> shape = as_int(lamp[LampColumn::shape]);
    const Mask<F> fold = equal(shape, Int<F>(static_cast<int>(LampShape::triangle))) & (a + b > F(1.0f));
    a = select(fold, F(1.0f) - a, a);
    b = select(fold, F(1.0f) - b, b);
  }
  const Vec3<F> p =
      fma(lamp.vector(LampColumn::e1_x), a, fma(lamp.vector(LampColumn::e2_x), b, lamp.vector(LampColumn::p_x)));
  const Vec3<F> way = p - from;
  const F distance2 = dot(way, way);
  const F inverse = inverse_sqrt(distance2);
  const Vec3<F> direction = way * inverse;
  const F minus_cos_lamp = dot(direction, lamp.vector(LampColumn::normal_x));
  const F inverse_pdf = max(F(0.0f) - minus_cos_lamp, F(0.0f)) * (inverse * inverse);
  return {direction, distance2 * inverse, lamp.vector(LampColumn::weight_r), inverse_pdf, Int<F>(0), Int<F>(0)};
}

/// A direction in the cone in which a sphere is seen, uniform by solid angle: pdf_w = 1 / (2 pi (1 - cos(theta_max))).
template <class F, bool one>
LampSample<F> sample_sphere_lamp(const LampRow<F, one>& lamp, const Vec3<F>& from, F u, F v) {
  const Vec3<F> to_centre = lamp.vector(LampColumn::p_x) - from;
  const F radius = lamp[LampColumn::e1_x];
  const F d2 = dot(to_centre, to_centre);
  const F inverse_d = inverse_sqrt(d2);
  const F d = d2 * inverse_d;
  const Vec3<F> axis = to_centre * inverse_d;
  const F sin_max = radius * inverse_d;
  const F sin2_max = min(sin_max * sin_max, F(1.0f));
  // 1 - cos without cancellation for small lamps.
  const F one_minus_cos_max = sin2_max * reciprocal(F(1.0f) + sqrt(F(1.0f) - sin2_max));
  const F one_minus_cos = u * one_minus_cos_max;
  const F cos = F(1.0f) - one_minus_cos;
  const F sin2 = one_minus_cos * (F(1.0f) + cos);
  const F sin = sqrt(sin2);
  // A frame about the axis (Duff et al., "Building an orthonormal basis, revisited", JCGT 2017).
  const F sign = select(axis.z < F(0.0f), F(-1.0f), F(1.0f));
  const F k = F(-1.0f) * reciprocal(sign + axis.z);
  const F xy = axis.x * axis.y * k;
  const Vec3<F> t1{fma(sign * axis.x, axis.x * k, F(1.0f)), sign * xy, F(0.0f) - sign * axis.x};
  const Vec3<F> t2{xy, fma(axis.y, axis.y * k, sign), F(0.0f) - axis.y};
  const SinCos<F> turn = sincos_turns(v);
  const Vec3<F> direction = fma(t1, sin * turn.cos, fma(t2, sin * turn.sin, axis * cos));
  const F half_chord = sqrt(radius * radius - d2 * sin2);
  const F inverse_pdf = select(d > radius, F(2.0f * std::numbers::pi_v<float>) * one_minus_cos_max, F(0.0f));
  const F distance = max(fma(d, cos, F(0.0f) - half_chord), F(0.0f));
  return {direction, distance, lamp.vector(LampColumn::weight_r), inverse_pdf, Int<F>(0), Int<F>(0)};
}

/// The table's row decides how the lamp is sampled.
template <class F, bool one>
LampSample<F> sample_row(const LampRow<F, one>& lamp, const Vec3<F>& from, F u, F v) {
  const auto has = [&](LampShape s) { return lamp.scene.has_lamp_shape[static_cast<std::size_t>(s)]; };
  const bool flat = has(LampShape::parallelogram) || has(LampShape::triangle);
  LampSample<F> sample =
      flat ? sample_flat_lamp(lamp, from, u, v, has(LampShape::triangle)) : sample_sphere_lamp(lamp, from, u, v);
  if (flat && has(LampShape::sphere)) {
    const LampSample<F> on_sphere = sample_sphere_lamp(lamp, from, u, v);
    const Mask<F> sphere = equal(as_int(lamp[LampColumn::shape]), Int<F>(static_cast<int>(LampShape::sphere)));
    sample.direction = select(sphere, on_sphere.direction, sample.direction);
    sample.distance = select(sphere, on_sphere.distance, sample.distance);
    sample.inverse_pdf = select(sphere, on_sphere.inverse_pdf, sample.inverse_pdf);
  }
  sample.first_surface = as_int(lamp[LampColumn::first_surface]);
  sample.last_surface = as_int(lamp[LampColumn::last_surface]);
  return sample;
}

/// A direction towards a lamp. `choice` is used only where there are several; `one_rectangle`: the only lamp is a
/// parallelogram.
template <class F, bool one_rectangle>
LampSample<F> sample_lamp(const CompiledScene& scene, const Vec3<F>& from, F choice, F u, F v) {
  if constexpr (one_rectangle) return sample_flat_lamp(LampRow<F, true>{scene, Int<F>(0)}, from, u, v, false);
  if (scene.lamps.rows() == 1) return sample_row(LampRow<F, true>{scene, Int<F>(0)}, from, u, v);
  return sample_row(LampRow<F, false>{scene, choose_lamp(scene, choice)}, from, u, v);
}

}  // namespace glimt
