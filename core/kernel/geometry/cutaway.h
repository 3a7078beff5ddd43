#pragma once

#include "kernel/geometry/intersect.h"

/// A cutaway: camera rays, and no others, begin where they enter the room and look through flat surfaces that turn
/// their back to the camera. The room's walls are seen from inside whatever their front, glass from both sides. Spheres
/// and convex solids have no back outside them; a ray that begins in one looks through it.
namespace glimt {

/// Where rays from the eye enter the room; infinite where they do not.
template <class F>
F room_entry(const CompiledScene& scene, const Ray<F>& ray) {
  constexpr float inf = std::numeric_limits<float>::infinity(), along = 1e-20f;
  F entry(0.0f), leave(inf);
  for (const Slab& slab : scene.room) {
    const Vec3<F> n = broadcast<F>(slab.nx, slab.ny, slab.nz);
    const F approach = dot(n, ray.direction);
    // Finite for rays along the slab, so that those beside it leave before they enter.
    const F inverse = reciprocal(select(abs(approach) < F(along), F(along), approach));
    const F middle = (F(slab.middle) - dot(n, ray.origin)) * inverse, half = abs(inverse) * F(slab.half);
    entry = select(middle - half > entry, middle - half, entry);
    leave = select(middle + half < leave, middle + half, leave);
  }
  for (const SphereShape& sphere : scene.shells) {
    const detail::SphereRoots<F> roots = detail::sphere_roots(sphere, ray);
    const F half = positive_sqrt(roots.square);
    entry = select(roots.middle - half > entry, roots.middle - half, entry);
    leave = select(roots.square < F(0.0f), F(-1.0f), min(leave, roots.middle + half));
  }
  return select(entry < leave, entry, F(inf));
}

/// The first surface along each ray that the camera sees, for the rays `from_eye`, which start on no surface; for the
/// others the first.
template <class F, Features features, class Surfaces>
[[gnu::noinline]] Hit<F> cutaway_hit(const CompiledScene& scene, const Surfaces& surfaces, const Ray<F>& ray,
                                     const Mask<F>& from_eye) {
  constexpr float inf = std::numeric_limits<float>::infinity();
  F start = select(from_eye, room_entry(scene, ray), F(0.0f));
  const Mask<F> passes = from_eye & !(start < F(inf));
  start = select(passes, F(0.0f), start);
  Ray<F> rest{fma(ray.direction, start, ray.origin), ray.direction, ray.from};
  Hit<F> hit{};
  // Each surface is looked through once.
  const auto triangles = static_cast<int>(features.tree && scene.tree ? scene.tree->triangles : 0);
  for (int passed = 0; passed <= scene.surfaces.rows() + triangles; ++passed) {
    hit = closest_hit<F, features>(scene, rest);
    const auto at = surfaces.meet(rest, hit);
    const Mask<F> flat = surfaces.is_flat(at);
    const Mask<F> wall = less(at.surface, Int<F>(scene.room_surfaces));
    const Mask<F> met = from_eye & !passes & (hit.t < F(inf)) & !surfaces.transmits(at);
    const Mask<F> back = met & ((flat & !at.front & !wall) | ((hit.t < F(0.0f)) & !flat));
    if (!any(back)) break;
    // A sphere is met by rays towards its centre: past that, it is left behind.
    const F to_centre = dot(surfaces.vector(Column::normal_x, at) - rest.origin, rest.direction);
    const F step = select(back, select(flat, hit.t, to_centre + to_centre), F(0.0f));
    start = start + step;
    rest.origin = fma(rest.direction, step, rest.origin);
    rest.from = select(back & flat, at.surface, rest.from);
  }
  hit.t = select(passes, F(inf), hit.t + start);
  return hit;
}

/// The first surface along each ray of a path, whose first ray is the camera's; of a tree, along those asked for.
template <class F, Features features, class Surfaces>
Hit<F> path_hit(const CompiledScene& scene, const Surfaces& surfaces, const Ray<F>& ray, const Mask<F>& from_eye,
                const Mask<F>& asked = all_lanes<F>()) {
  if constexpr (features.rare_shapes)
    if (scene.cutaway) return cutaway_hit<F, features>(scene, surfaces, ray, from_eye);
  return closest_hit<F, features>(scene, ray, asked);
}

}  // namespace glimt
