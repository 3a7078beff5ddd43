#pragma once

#include "kernel/geometry/intersect.h"
#include "kernel/lamps/sample_lamp.h"
#include "lamp/sphere_cone.h"
#include "math/sampler.h"

/// How light paths begin: on a lamp, towards the bounding sphere of a mirror or glass.
namespace glimt {

template <class F>
struct Emission {
  Vec3<F> origin, direction;
  Vec3<F> flux;    ///< W, divided by the light paths of a pass; 0 behind the lamp or where it is buried
  Int<F> surface;  ///< the surface that it starts on
  Int<F> target;   ///< a path that meets another surface first does not count
};

/// Whether lookup_small can hold the aims: one lamp has at most as many aims as there are surfaces.
template <Features features>
inline constexpr bool few_aims = (features.one_parallelogram) && (features.small_table);

/// Chooses a pair of a lamp and a target, in proportion to the estimated flux between them.
template <class F, Features features>
Int<F> choose_aim(const CompiledScene& scene, F u) {
  return choose_row<F, few_aims<features>>(scene.aims[AimColumn::alias_threshold], scene.aims[AimColumn::alias_other],
                                           scene.aims.rows(), u);
}

/// Whether no camera path can reach a point of a lamp: it is outside the room, or inside an opaque solid or sphere.
template <class F>
Mask<F> buried(const CompiledScene& scene, const Vec3<F>& point, const Int<F>& own_first, const Int<F>& own_last) {
  Mask<F> inside = no_lanes<F>();
  const auto other = [&](std::int32_t surface) {
    return less(Int<F>(surface), own_first) | less(own_last, Int<F>(surface));
  };
  if (scene.room_hides_lamps)
    for (const Slab& slab : scene.room)
      inside = inside | (abs(dot(broadcast<F>(slab.nx, slab.ny, slab.nz), point) - F(slab.middle)) >
                         F(slab.half * (1 + 0x1p-20f)));
  for (const SphereShape& sphere : scene.spheres) {
    const Vec3<F> way = point - broadcast<F>(sphere.cx, sphere.cy, sphere.cz);
    inside = inside | ((dot(way, way) < F(sphere.r2)) & other(sphere.surface));
  }
  for (const Solid& solid : scene.solids) {
    if (solid.glass) continue;
    Mask<F> behind = other(solid.first_surface);
    for (int i = solid.first; i < solid.last; ++i) {
      const SolidPlane& plane = scene.solid_planes[static_cast<std::size_t>(i)];
      behind = behind & (dot(broadcast<F>(plane.nx, plane.ny, plane.nz), point) < F(plane.d));
    }
    inside = inside | behind;
  }
  return inside;
}

/// Begins a light path of the pair in this row. The point is uniform by area. The direction is uniform in the cone of
/// the sphere around the target, or cosine-distributed where the point is inside that sphere.
template <class F, Features features>
Emission<F> emit(const CompiledScene& scene, const Int<F>& row, const Point2<F>& on_lamp, const Point2<F>& to_target) {
  const auto value = [&](AimColumn c) { return lookup_in<F, few_aims<features>>(scene.aims[c], row); };
  const LampRow<F, features.one_parallelogram> lamp{scene.lamps, as_int(value(AimColumn::lamp))};
  const LampPoint<F> from = lamp_point<features.one_parallelogram>(scene, lamp, on_lamp.u, on_lamp.v);
  const Vec3<F> center{value(AimColumn::center_x), value(AimColumn::center_y), value(AimColumn::center_z)};
  const SphereCone<F> cone = cone_of_sphere(center - from.point, value(AimColumn::radius));
  const Vec3<F> direction = select(cone.outside, cone.sample(to_target.u, to_target.v).direction,
                                   cosine_hemisphere(from.normal, to_target.u, to_target.v));
  // cos / pdf_w
  const F cos = max(dot(direction, from.normal), F(0.0f));
  const F over_pdf = select(cone.outside, cos * cone.solid_angle, F(std::numbers::pi_v<float>));
  const Int<F> first = as_int(lamp[LampColumn::first_surface]), last = as_int(lamp[LampColumn::last_surface]);
  const F kept = select(buried(scene, from.point, first, last), F(0.0f), over_pdf);
  const Vec3<F> weight{value(AimColumn::weight_r), value(AimColumn::weight_g), value(AimColumn::weight_b)};
  return {from.point, direction, weight * kept, first, as_int(value(AimColumn::target))};
}

}  // namespace glimt
