#pragma once

#include "lamp/lamp_row.h"
#include "lamp/sphere_cone.h"

namespace glimt {

enum class SphereColumn { center_x, center_y, center_z, radius, count };

/// What spherical lamps have in common. They shine outwards.
struct RoundLamp {
  glm::dvec3 center;  ///< compiled space
  double radius;      ///< metres

  double area() const { return 4 * std::numbers::pi * radius * radius; }
  LampBody body() const { return {{center}, radius, {}}; }
  void lower(const LampRowWriter& row) const {
    row.set3(SphereColumn::center_x, center);
    row.set(SphereColumn::radius, radius);
  }

  template <class F, bool one>
  static LampPoint<F> point(const LampRow<F, one>& lamp, F u, F v) {
    const Vec3<F> normal = uniform_sphere(u, v);
    return {fma(normal, lamp[SphereColumn::radius], lamp.vector(SphereColumn::center_x)), normal};
  }
};

/// A sphere sampled by solid angle.
struct SphereLamp : RoundLamp {
  static constexpr bool by_area = false;

  /// A direction uniform in the cone: pdf_w = 1 / (2 pi (1 - cos(theta_max))).
  template <class F, bool one>
  static SeenLamp<F> sample(const LampRow<F, one>& lamp, const Vec3<F>& from, F u, F v) {
    const SphereCone<F> cone = cone_of_sphere(lamp.vector(SphereColumn::center_x) - from, lamp[SphereColumn::radius]);
    const auto [direction, distance] = cone.sample(u, v);
    return {direction, distance, select(cone.outside, cone.solid_angle, F(0.0f))};
  }

  /// 1 / (pdf_w inverse_choice).
  template <class F, bool one>
  static F inverse_pdf(const LampRow<F, one>& lamp, const Vec3<F>& from, F /*distance*/, F /*cos_lamp*/) {
    const Vec3<F> to_centre = lamp.vector(SphereColumn::center_x) - from;
    const F radius = lamp[SphereColumn::radius];
    const F sin2 = min(radius * radius * reciprocal(dot(to_centre, to_centre)), F(1.0f));
    return F(2.0f * std::numbers::pi_v<float>) * cone_one_minus_cos(sin2);
  }
};

/// A sphere sampled by area. At least half of the points are on its far side.
struct SphereByAreaLamp : RoundLamp {
  static constexpr bool by_area = true;
};

}  // namespace glimt
