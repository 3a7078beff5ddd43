#pragma once

#include "compile/compiled_scene.h"
#include "lamp/list.h"
#include "math/alias.h"

/// Points of lamps, for next-event estimation, connections and light paths.
namespace glimt {

/// A direction in which a lamp may be seen.
template <class F>
struct LampSample {
  Vec3<F> direction;                   ///< unit, from the shaded point
  F distance;                          ///< metres
  Vec3<F> weight;                      ///< weight * inverse_pdf = radiance / pdf_w, with the choice of the lamp
  F inverse_pdf;                       ///< 0 where the lamp shows its back
  F inverse_choice;                    ///< 1 / pdf_w = inverse_pdf * inverse_choice
  Int<F> first_surface, last_surface;  ///< the lamp's own surfaces, which cannot hide it
};

/// Chooses a lamp in proportion to its power.
template <class F>
Int<F> choose_lamp(const CompiledScene& scene, F u) {
  return choose_row(scene.lamps[LampColumn::alias_threshold], scene.lamps[LampColumn::alias_other], scene.lamps.rows(),
                    u);
}

template <class Shape, class F, bool one>
Mask<F> has_shape(const LampRow<F, one>& lamp) {
  return equal(as_int(lamp[LampColumn::shape]), Int<F>(lamp_shape_number<Shape>));
}

/// A point of the row's lamp, uniform by area. `only_by_area`: the lamp is one that light sampling samples by area.
/// `one_parallelogram`: the only lamp is a parallelogram sampled by area.
template <bool one_parallelogram = false, class F, bool one>
LampPoint<F> lamp_point(const CompiledScene& scene, const LampRow<F, one>& lamp, F u, F v, bool only_by_area = false) {
  if constexpr (one_parallelogram) return ParallelogramLamp::point(lamp, u, v);
  LampPoint<F> at{};
  bool first = true;
  for_each_lamp_shape([&]<class Shape>() {
    if (!scene.has_lamp<Shape>() || (only_by_area && !Shape::by_area)) return;
    const LampPoint<F> own = Shape::point(lamp, u, v);
    const Mask<F> mask = has_shape<Shape>(lamp);
    at.point = first ? own.point : select(mask, own.point, at.point);
    at.normal = first ? own.normal : select(mask, own.normal, at.normal);
    first = false;
  });
  return at;
}

/// How `from` sees a point of the row's lamp; the lamp's shape chooses the point.
template <class F, bool one>
SeenLamp<F> see_lamp(const CompiledScene& scene, const LampRow<F, one>& lamp, const Vec3<F>& from, F u, F v) {
  SeenLamp<F> seen{};
  bool first = true;
  for_each_lamp_shape([&]<class Shape>() { first = first && !(Shape::by_area && scene.has_lamp<Shape>()); });
  if (!first) seen = see_point(from, lamp_point(scene, lamp, u, v, true));
  for_each_lamp_shape([&]<class Shape>() {
    if constexpr (!Shape::by_area) {
      if (!scene.has_lamp<Shape>()) return;
      const SeenLamp<F> own = Shape::sample(lamp, from, u, v);
      const Mask<F> mask = has_shape<Shape>(lamp);
      seen.direction = first ? own.direction : select(mask, own.direction, seen.direction);
      seen.distance = first ? own.distance : select(mask, own.distance, seen.distance);
      seen.inverse_pdf = first ? own.inverse_pdf : select(mask, own.inverse_pdf, seen.inverse_pdf);
      first = false;
    }
  });
  return seen;
}

template <class F, bool one>
LampSample<F> sample_row(const CompiledScene& scene, const LampRow<F, one>& lamp, const Vec3<F>& from, F u, F v) {
  const SeenLamp<F> seen = see_lamp(scene, lamp, from, u, v);
  return {seen.direction,
          seen.distance,
          lamp.vector(LampColumn::weight_r),
          seen.inverse_pdf,
          lamp[LampColumn::inverse_choice],
          as_int(lamp[LampColumn::first_surface]),
          as_int(lamp[LampColumn::last_surface])};
}

/// A direction towards a lamp. `choice` is used only if there are several lamps. `one_parallelogram`: the only lamp is
/// a parallelogram sampled by area.
template <class F, bool one_parallelogram>
LampSample<F> sample_lamp(const CompiledScene& scene, const Vec3<F>& from, F choice, F u, F v) {
  const LampRow<F, true> first{scene.lamps, Int<F>(0)};
  if constexpr (one_parallelogram) {
    const SeenLamp<F> seen = see_point(from, lamp_point<true>(scene, first, u, v));
    return {seen.direction,
            seen.distance,
            first.vector(LampColumn::weight_r),
            seen.inverse_pdf,
            first[LampColumn::inverse_choice],
            Int<F>(0),
            Int<F>(0)};
  }
  if (scene.lamps.rows() == 1) return sample_row(scene, first, from, u, v);
  return sample_row(scene, LampRow<F, false>{scene.lamps, choose_lamp(scene, choice)}, from, u, v);
}

/// 1 / pdf_w of light sampling from `from` for a point of the lamp in `row` at this distance, at which the lamp sees
/// `from` under cos_lamp.
template <class F>
F lamp_inverse_pdf(const CompiledScene& scene, const Int<F>& row, const Vec3<F>& from, F distance, F cos_lamp) {
  const LampRow<F, false> lamp{scene.lamps, row};
  F inverse_pdf = cos_lamp * reciprocal(distance * distance);  // by area
  for_each_lamp_shape([&]<class Shape>() {
    if constexpr (!Shape::by_area) {
      if (scene.has_lamp<Shape>())
        inverse_pdf = select(has_shape<Shape>(lamp), Shape::inverse_pdf(lamp, from, distance, cos_lamp), inverse_pdf);
    }
  });
  return inverse_pdf * lamp[LampColumn::inverse_choice];
}

}  // namespace glimt
