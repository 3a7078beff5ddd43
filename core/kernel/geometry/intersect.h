#pragma once

#include <array>
#include <bit>
#include <limits>

#include "kernel/entry/features.h"
#include "kernel/geometry/tree_walk.h"
#include "math/vec.h"

/// Rays against the compiled scene. Nothing here uses an epsilon; a ray never hits again what it leaves, because
///  - of a pair of room planes it takes the one it moves towards;
///  - opaque spheres and solids are hit from outside only, by rays that move towards them;
///  - a polygon or triangle is not tested against rays that start on it, in a tree too;
///  - inside the glass that a ray starts on, only the far side is looked for.
namespace glimt {

/// A ray in compiled space; `direction` is of unit length.
template <class F>
struct Ray {
  Vec3<F> origin, direction;
  Int<F> from;  ///< the surface it starts on, or -1
};

template <class F>
struct Hit {
  F t;             ///< metres along the ray; infinite without a hit
  Int<F> surface;  ///< 0 without a hit
};

namespace detail {

template <class F>
void take(Hit<F>& hit, const Mask<F>& closer, F t, std::int32_t surface) {
  hit.t = select(closer, t, hit.t);
  hit.surface = select(closer, Int<F>(surface), hit.surface);
}

/// Where a line meets a sphere, from the point nearest to the centre, which stays exact for far and small spheres
/// (Haines et al., "Precision improvements for ray/sphere intersection", Ray Tracing Gems, 2019, ch. 7).
template <class F>
struct SphereRoots {
  F middle;  ///< t of the point nearest to the centre
  F square;  ///< of half the chord; negative where the line misses
};

template <class F>
SphereRoots<F> sphere_roots(const SphereShape& s, const Ray<F>& ray) {
  const Vec3<F> to_centre = broadcast<F>(s.cx, s.cy, s.cz) - ray.origin;
  const F middle = dot(to_centre, ray.direction);
  const Vec3<F> miss = fnma(ray.direction, middle, to_centre);
  const F square = fnma(miss.x, miss.x, fnma(miss.y, miss.y, fnma(miss.z, miss.z, F(s.r2))));
  return {middle, square};
}

/// t where a ray from inside leaves a slab; a little below 0 where rounding has put the origin outside.
template <class F>
F slab_exit(const Slab& slab, const Ray<F>& ray, Mask<F>& towards_hi) {
  const Vec3<F> n = broadcast<F>(slab.nx, slab.ny, slab.nz);
  const F approach = dot(n, ray.direction);
  towards_hi = approach > F(0.0f);
  const F inverse = reciprocal(approach);
  const F from_middle = fma(n.x, ray.origin.x, fma(n.y, ray.origin.y, fma(n.z, ray.origin.z, F(-slab.middle))));
  return fnma(inverse, from_middle, abs(inverse) * F(slab.half));
}

/// The first root of a glass sphere after the point where the ray starts; NaN or not positive where there is none.
template <class F>
F glass_sphere_t(const SphereShape& s, const Ray<F>& ray) {
  const SphereRoots<F> roots = sphere_roots(s, ray);
  const F half_chord = positive_sqrt(roots.square);
  const F near = roots.middle - half_chord;
  // A chord from the surface: its start is the root 0, so the other is twice the middle.
  return select(equal(ray.from, Int<F>(s.surface)), roots.middle + roots.middle,
                select(near > F(0.0f), near, roots.middle + half_chord));
}

/// Where a ray enters and leaves a convex solid, and through which planes.
template <class F>
struct SolidSpan {
  F near_t, far_t;
  Int<F> near_surface, far_surface;
};

template <class F>
SolidSpan<F> solid_span(const CompiledScene& scene, const Solid& solid, const Ray<F>& ray) {
  constexpr float inf = std::numeric_limits<float>::infinity();
  SolidSpan<F> span{F(-inf), F(inf), Int<F>(0), Int<F>(0)};
  for (int i = solid.first; i < solid.last; ++i) {
    const SolidPlane& plane = scene.solid_planes[static_cast<std::size_t>(i)];
    const Vec3<F> n = broadcast<F>(plane.nx, plane.ny, plane.nz);
    const F approach = dot(n, ray.direction);
    const F t = (F(plane.d) - dot(n, ray.origin)) * reciprocal(approach);
    const Mask<F> enters = approach < F(0.0f);
    const Mask<F> later = enters & (t > span.near_t);
    const Mask<F> sooner = (t < span.far_t) & !enters;
    span.near_t = select(later, t, span.near_t);
    span.near_surface = select(later, Int<F>(plane.surface), span.near_surface);
    span.far_t = select(sooner, t, span.far_t);
    span.far_surface = select(sooner, Int<F>(plane.surface), span.far_surface);
  }
  return span;
}

/// A ray that starts on a convex glass solid is inside it when the plane it starts on is one it enters through.
template <class F>
Mask<F> starts_inside(const CompiledScene& scene, const Solid& solid, const Ray<F>& ray, const SolidSpan<F>& span,
                      Mask<F>& starts_on) {
  starts_on = !(less(ray.from, Int<F>(solid.first_surface)) | less(Int<F>(solid.last_surface), ray.from));
  Mask<F> inward = no_lanes<F>();
  for (int i = solid.first; i < solid.last; ++i) {
    const SolidPlane& plane = scene.solid_planes[static_cast<std::size_t>(i)];
    const F approach = dot(broadcast<F>(plane.nx, plane.ny, plane.nz), ray.direction);
    inward = inward | (equal(ray.from, Int<F>(plane.surface)) & (approach < F(0.0f)));
  }
  return inward | ((span.near_t <= F(0.0f)) & (span.far_t > F(0.0f)) & !starts_on);
}

template <class F>
F polygon_t(const CompiledScene& scene, const PolygonShape& polygon, const Ray<F>& ray, Mask<F>& inside) {
  const Vec3<F> n = broadcast<F>(polygon.nx, polygon.ny, polygon.nz);
  const F t = (F(polygon.d) - dot(n, ray.origin)) * reciprocal(dot(n, ray.direction));
  const Vec3<F> p = fma(ray.direction, t, ray.origin);
  inside = (t >= F(0.0f)) & !equal(ray.from, Int<F>(polygon.surface));
  for (int i = polygon.first_bound; i < polygon.last_bound; ++i) {
    const PolygonBound& bound = scene.polygon_bounds[static_cast<std::size_t>(i)];
    const F s = dot(broadcast<F>(bound.bx, bound.by, bound.bz), p);
    inside = inside & (s >= F(bound.lo)) & (s <= F(bound.hi));
  }
  return t;
}

/// Moeller and Trumbore, "Fast, minimum storage ray/triangle intersection" (1997).
template <class F>
F triangle_t(const TriangleShape& triangle, const Ray<F>& ray, Mask<F>& inside) {
  const Vec3<F> e1 = broadcast<F>(triangle.e1[0], triangle.e1[1], triangle.e1[2]);
  const Vec3<F> e2 = broadcast<F>(triangle.e2[0], triangle.e2[1], triangle.e2[2]);
  const Vec3<F> p = cross(ray.direction, e2);
  const F inverse = reciprocal(dot(e1, p));
  const Vec3<F> s = ray.origin - broadcast<F>(triangle.v[0], triangle.v[1], triangle.v[2]);
  const F u = dot(s, p) * inverse;
  const Vec3<F> q = cross(s, e1);
  const F v = dot(ray.direction, q) * inverse;
  const F t = dot(e2, q) * inverse;
  inside = (u >= F(0.0f)) & (v >= F(0.0f)) & (u + v <= F(1.0f)) & (t >= F(0.0f)) &
           !equal(ray.from, Int<F>(triangle.surface));
  return t;
}

/// The rays of all lanes, one by one.
template <class F>
class RayList {
  static constexpr auto lanes = static_cast<std::size_t>(lane_count<F>);

 public:
  explicit RayList(const Ray<F>& ray) {
    const std::array<const Vec3<F>*, 2> vectors{&ray.origin, &ray.direction};
    for (std::size_t k = 0; k < 2; ++k) {
      store(vectors[k]->x, parts_[k][0].data());
      store(vectors[k]->y, parts_[k][1].data());
      store(vectors[k]->z, parts_[k][2].data());
    }
    store(ray.from, from_.data());
  }

  TreeRay operator[](std::size_t i) const {
    return {{parts_[0][0][i], parts_[0][1][i], parts_[0][2][i]},
            {parts_[1][0][i], parts_[1][1][i], parts_[1][2][i]},
            from_[i] - first_tree_surface};
  }

 private:
  std::array<std::array<std::array<float, lanes>, 3>, 2> parts_;  ///< [origin or direction][axis][lane]
  std::array<std::int32_t, lanes> from_;
};

/// f(lane) for each lane in the mask.
template <class F, class Function>
void for_lanes(const Mask<F>& mask, Function f) {
  for (std::uint32_t lanes = bits(mask); lanes != 0; lanes &= lanes - 1)
    f(static_cast<std::size_t>(std::countr_zero(lanes)));
}

/// Takes what the rays in the mask meet in the tree before `hit`.
template <class F>
[[gnu::noinline]] void take_from_tree(const TriangleTree& tree, const Ray<F>& ray, const Mask<F>& asked, Hit<F>& hit) {
  const RayList<F> rays(ray);
  std::array<float, lane_count<F>> t;
  std::array<std::int32_t, lane_count<F>> surface;
  store(hit.t, t.data());
  store(hit.surface, surface.data());
  for_lanes<F>(asked, [&](std::size_t i) {
    const TreeHit found = first_in_tree(tree, rays[i], t[i]);
    if (found.place < 0) return;
    t[i] = found.t;
    surface[i] = first_tree_surface + found.place;
  });
  hit = {load<F>(t.data()), load<Int<F>>(surface.data())};
}

/// Which rays in the mask meet a triangle of the tree before `distance` whose surface is not from `first` to `last`.
template <class F>
[[gnu::noinline]] Mask<F> hidden_by_tree(const TriangleTree& tree, const Ray<F>& ray, const Mask<F>& asked,
                                         const F& distance, const Int<F>& first, const Int<F>& last) {
  const RayList<F> rays(ray);
  std::array<float, lane_count<F>> far, hidden{};
  std::array<std::int32_t, lane_count<F>> low, high;
  store(distance, far.data()), store(first, low.data()), store(last, high.data());
  for_lanes<F>(asked, [&](std::size_t i) {
    const bool found = hidden_in_tree(tree, rays[i], far[i], low[i] - first_tree_surface, high[i] - first_tree_surface);
    hidden[i] = found ? 1.0f : 0.0f;
  });
  return load<F>(hidden.data()) > F(0.0f);
}

}  // namespace detail

/// The first surface along each ray; of a tree, along those that are asked for.
template <class F, Features features>
Hit<F> closest_hit(const CompiledScene& scene, const Ray<F>& ray, const Mask<F>& asked = all_lanes<F>()) {
  using namespace detail;
  constexpr float inf = std::numeric_limits<float>::infinity();
  Hit<F> hit{F(inf), Int<F>(0)};
  for (const Slab& slab : scene.room) {
    Mask<F> towards_hi;
    const F t = slab_exit(slab, ray, towards_hi);
    const Mask<F> closer = t < hit.t;
    hit.t = select(closer, t, hit.t);
    hit.surface = select(closer, select(towards_hi, Int<F>(slab.surface_hi), Int<F>(slab.surface_lo)), hit.surface);
  }
  for (const PolygonShape& polygon : scene.polygons) {
    Mask<F> inside;
    const F t = polygon_t(scene, polygon, ray, inside);
    take(hit, inside & (t < hit.t), t, polygon.surface);
  }
  for (const Solid& solid : scene.solids) {
    const SolidSpan<F> span = solid_span(scene, solid, ray);
    const Mask<F> crosses = span.near_t <= span.far_t;
    Mask<F> enters = crosses & (span.near_t > F(0.0f)) & (span.near_t < hit.t);
    if (features.rare_shapes && solid.glass) {
      Mask<F> starts_on;
      const Mask<F> inside = starts_inside(scene, solid, ray, span, starts_on);
      const Mask<F> leaves = inside & (span.far_t < hit.t);
      enters = enters & !inside & !starts_on;
      hit.t = select(leaves, max(span.far_t, F(0.0f)), hit.t);
      hit.surface = select(leaves, span.far_surface, hit.surface);
    }
    hit.t = select(enters, span.near_t, hit.t);
    hit.surface = select(enters, span.near_surface, hit.surface);
  }
  for (const SphereShape& sphere : scene.spheres) {
    const SphereRoots<F> roots = sphere_roots(sphere, ray);
    const F t = roots.middle - positive_sqrt(roots.square);
    // Moving towards the centre, so t is negative only where rounding has put the origin inside: then the hit is here.
    take(hit, (roots.middle > F(0.0f)) & (t < hit.t), t, sphere.surface);
  }
  for (const SphereShape& sphere : scene.glass_spheres) {
    const F t = glass_sphere_t(sphere, ray);
    take(hit, (t > F(0.0f)) & (t < hit.t), t, sphere.surface);
  }
  if (!features.rare_shapes) return hit;
  for (const TriangleShape& triangle : scene.triangles) {
    Mask<F> inside;
    const F t = triangle_t(triangle, ray, inside);
    take(hit, inside & (t < hit.t), t, triangle.surface);
  }
  for (const SphereShape& sphere : scene.shells) {
    const SphereRoots<F> roots = sphere_roots(sphere, ray);
    const F t = max(roots.middle + sqrt(roots.square), F(0.0f));
    take(hit, t < hit.t, t, sphere.surface);
  }
  if constexpr (features.tree)
    if (scene.tree) take_from_tree(*scene.tree, ray, asked, hit);
  return hit;
}

/// Whether something lies between a ray's origin and the point of a lamp at `distance`. The
/// surfaces from `first` to `last` are the lamp's own and do not count, nor do others of a convex solid that has them.
/// `to_any`: the point is anywhere, so the lamps count too. A tree is asked for the rays `asked` alone.
template <class F, Features features, bool to_any = false>
Mask<F> occluded(const CompiledScene& scene, const Ray<F>& ray, F distance, Int<F> first, Int<F> last,
                 const Mask<F>& asked = all_lanes<F>()) {
  using namespace detail;
  Mask<F> hidden = no_lanes<F>();
  // A single piece of a lamp need not be tested at all, which spares the others the question whose they are.
  const bool one = !to_any && (features.one_parallelogram || scene.lamps.rows() == 1);
  const auto only = one ? std::bit_cast<std::int32_t>(scene.lamps[LampColumn::first_surface][0]) : -1;
  const auto hide_range = [&](const Mask<F>& blocks, std::int32_t lowest, std::int32_t highest) {
    if (one) {
      hidden = hidden | blocks;
    } else {
      hidden = hidden | (blocks & (less(Int<F>(highest), first) | less(last, Int<F>(lowest))));
    }
  };
  const auto hide = [&](const Mask<F>& blocks, std::int32_t surface) { hide_range(blocks, surface, surface); };
  for (const PolygonShape& polygon : scene.polygons) {
    if (polygon.surface == only) continue;
    Mask<F> inside;
    const F t = polygon_t(scene, polygon, ray, inside);
    hide(inside & (t < distance), polygon.surface);
  }
  for (const Solid& solid : scene.solids) {
    if (solid.first_surface == only) continue;
    const SolidSpan<F> span = solid_span(scene, solid, ray);
    Mask<F> crosses = (span.near_t <= span.far_t) & (span.near_t > F(0.0f)) & (span.near_t < distance);
    if (features.rare_shapes && solid.glass) {
      Mask<F> starts_on;
      const Mask<F> inside = starts_inside(scene, solid, ray, span, starts_on);
      crosses = (crosses & !inside & !starts_on) | (inside & (span.far_t < distance));
    }
    hide_range(crosses, solid.first_surface, solid.last_surface);
  }
  for (const SphereShape& sphere : scene.spheres) {
    if (sphere.surface == only) continue;
    const SphereRoots<F> roots = sphere_roots(sphere, ray);
    const F beyond = max(roots.middle - distance, F(0.0f));  // middle - half chord < distance, without the root
    hide((roots.middle > F(0.0f)) & (beyond * beyond < roots.square), sphere.surface);
  }
  for (const SphereShape& sphere : scene.glass_spheres) {
    const F t = glass_sphere_t(sphere, ray);
    hide((t > F(0.0f)) & (t < distance), sphere.surface);
  }
  if (!features.rare_shapes) return hidden;
  for (const TriangleShape& triangle : scene.triangles) {
    if (triangle.surface == only) continue;
    Mask<F> inside;
    const F t = triangle_t(triangle, ray, inside);
    hide(inside & (t < distance), triangle.surface);
  }
  if (scene.room_hides_lamps) {
    for (const Slab& slab : scene.room) {
      Mask<F> towards_hi;
      const Mask<F> beyond = slab_exit(slab, ray, towards_hi) < distance * F(1 - 0x1p-16f);
      hide(beyond & towards_hi, slab.surface_hi);
      hide(beyond & !towards_hi, slab.surface_lo);
    }
  }
  for (const SphereShape& sphere : scene.shells) {
    const SphereRoots<F> roots = sphere_roots(sphere, ray);
    hide(roots.middle + sqrt(roots.square) < distance * F(1 - 0x1p-16f), sphere.surface);
  }
  if constexpr (features.tree)
    if (scene.tree) hidden = hidden | hidden_by_tree<F>(*scene.tree, ray, asked & !hidden, distance, first, last);
  return hidden;
}

}  // namespace glimt
