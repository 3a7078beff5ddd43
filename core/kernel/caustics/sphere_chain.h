#pragma once

#include <array>

#include "math/warp.h"

/// Specular chains from a point x over one sphere to a point y, both outside it: reflection off its outside, and
/// refraction into it and out again. They lie in the plane of x, y and the centre, so a chain has one unknown, the
/// angle of incidence theta. Let a = radius / distance of an end to the centre, and sin(alpha) = a sin(theta). Seen
/// from the centre, a ray from that end meets the sphere at the angle phi = theta - alpha from the end. With
/// sin(theta_t) = sin(theta) / n, the chord inside spans pi - 2 theta_t. Only sines and cosines of these angles are
/// needed. They are algebraic, and the forms below do not cancel where an end is close to the sphere.
namespace glimt {

/// An end of a chain.
template <class F>
struct ChainEnd {
  F a;             ///< radius / distance to the centre
  F one_minus_a2;  ///< positive only for a point outside
  F distance;      ///< to the centre, metres
};

template <class F>
ChainEnd<F> chain_end(F distance, F radius) {
  const F inverse = reciprocal(distance);
  return {radius * inverse, (distance - radius) * (distance + radius) * (inverse * inverse), distance};
}

/// The ray from an end to the sphere.
template <class F>
struct ChainLeg {
  F cos_end;                  ///< cos(alpha), with alpha the angle at the end between the ray and the centre
  F cos_phi, sin_phi_over_b;  ///< cos(phi), and sin(phi) / b with b = sin(theta)
  F slope;                    ///< d phi / d theta
  F length;                   ///< metres
};

template <class F>
ChainLeg<F> chain_leg(const ChainEnd<F>& end, F b, F cos_theta) {
  const F cos_end = positive_sqrt(fma(end.a * end.a, cos_theta * cos_theta, end.one_minus_a2));
  // Equal to cos(alpha) - a cos(theta), because cos^2(alpha) - a^2 cos^2(theta) = 1 - a^2.
  const F length = end.one_minus_a2 * reciprocal(fma(end.a, cos_theta, cos_end));
  return {cos_end, fma(cos_theta, cos_end, end.a * (b * b)), length, length * reciprocal(cos_end),
          length * end.distance};
}

/// Area at y, at right angles to the ray there, per solid angle at x, m^2/sr: distance_x^2 distance_y^2 cos(alpha_x)
/// cos(alpha_y) |d Phi / db| sin(Phi) / b / radius^2, where Phi is the angle at the centre from x to y. A ray turned by
/// d alpha about x moves by distance_y cos(alpha_y) d Phi at y. A ray turned by d psi about the axis moves by
/// distance_y sin(Phi) d psi. The solid angle is sin(alpha_x) d alpha d psi, with distance_x sin(alpha_x) = radius b.
template <class F>
F tube_area(const ChainEnd<F>& x, const ChainEnd<F>& y, const ChainLeg<F>& at_x, const ChainLeg<F>& at_y,
            F phi_slope_by_b, F sin_phi_over_b) {
  const F scale = y.distance * reciprocal(x.a);
  return scale * scale * (at_x.cos_end * at_y.cos_end) * abs(phi_slope_by_b * sin_phi_over_b);
}

/// The plane of a chain. Its vectors are unit directions from the centre.
template <class F>
struct ChainPlane {
  Vec3<F> to_x, to_y;
  Vec3<F> across_x, across_y;  ///< at right angles to to_x and to_y, each on the side of the other
  Vec3<F> middle, sideways;    ///< bisector of to_x and to_y; at right angles to it, on the side of y
  F cos_half, sin_half;        ///< cosine and sine of half the angle between to_x and to_y
};

template <class F>
Vec3<F> any_perpendicular(const Vec3<F>& v) {
  const F zero(0.0f);
  return normalize(select(abs(v.x) > abs(v.y), Vec3<F>{v.z, zero, zero - v.x}, Vec3<F>{zero, v.z, zero - v.y}));
}

template <class F>
ChainPlane<F> chain_plane(const Vec3<F>& to_x, const Vec3<F>& to_y) {
  const F least(1e-13f);  // smaller squares of differences of unit vectors are rounding errors
  const Vec3<F> sum = to_x + to_y, difference = to_y - to_x;
  const F sum2 = dot(sum, sum), difference2 = dot(difference, difference);
  const F inverse_sum = inverse_sqrt(max(sum2, least)), inverse_difference = inverse_sqrt(max(difference2, least));
  const F c = F(0.5f) * sum2 * inverse_sum, s = F(0.5f) * difference2 * inverse_difference;
  // The longer of the two has all its digits. The shorter is made perpendicular to it.
  const Mask<F> near = c > s;
  const Vec3<F> sure = select(near, sum * inverse_sum, difference * inverse_difference);
  const Vec3<F> unsure = select(near, difference * inverse_difference, sum * inverse_sum);
  const Vec3<F> rest = fnma(sure, dot(sure, unsure), unsure);
  const F rest2 = dot(rest, rest);
  const Vec3<F> other = select(rest2 > F(0.25f), rest * inverse_sqrt(max(rest2, F(0.25f))), any_perpendicular(sure));
  const Vec3<F> middle = select(near, sure, other), sideways = select(near, other, sure);
  const Vec3<F> up = middle * s, along = sideways * c;
  return {to_x, to_y, up + along, up - along, middle, sideways, c, s};
}

/// A chain over the sphere. Where `exists` is false, the others may hold anything.
template <class F>
struct SphereChain {
  Mask<F> exists;
  Vec3<F> from_x, from_y;      ///< unit, from the ends to the sphere
  F x_length, y_length;        ///< metres
  Vec3<F> x_normal, y_normal;  ///< outward normals where these rays meet the sphere
  F cos_theta;                 ///< cosine between the rays outside and the normals
  F tube;                      ///< see tube_area
};

/// The rays of a reflection with this angle of incidence.
template <class F>
struct ReflectedRay {
  ChainLeg<F> x, y;
  F tube;
};

template <class F>
ReflectedRay<F> reflected_ray(const ChainEnd<F>& x, const ChainEnd<F>& y, F b, F cos_theta) {
  const ChainLeg<F> at_x = chain_leg(x, b, cos_theta), at_y = chain_leg(y, b, cos_theta);
  const F slope = (at_x.slope + at_y.slope) * reciprocal(cos_theta);
  const F sin_over_b = fma(at_x.sin_phi_over_b, at_y.cos_phi, at_x.cos_phi * at_y.sin_phi_over_b);
  return {at_x, at_y, tube_area(x, y, at_x, at_y, slope, sin_over_b)};
}

/// The reflection of x to y off the outside, which is Alhazen's problem. Let the reflecting point be at the angle tau
/// from the bisector towards y, and u = sin(tau). Equal angles to the normal mean 2 u - (a_x + a_y) cos(Phi/2) u /
/// sqrt(1 - u^2) = (a_y - a_x) sin(Phi/2). The left side is odd, and concave for u > 0. So Newton's method from u = 0
/// rises to the smaller of its roots, the one that both ends see.
template <class F>
SphereChain<F> reflected_chain(const ChainPlane<F>& plane, const ChainEnd<F>& x, const ChainEnd<F>& y) {
  constexpr int steps = 8;
  const F zero(0.0f), one(1.0f);
  const F c = plane.cos_half, s = plane.sin_half;
  const F x_gap = x.one_minus_a2 * reciprocal(one + x.a), y_gap = y.one_minus_a2 * reciprocal(one + y.a);  // 1 - a
  const F k = (x.a + y.a) * c;
  const F slope = fma(x.a + y.a, s * s * reciprocal(one + c), x_gap + y_gap);  // 2 - k
  const F target = (x_gap - y_gap) * s;
  F u(0.0f), cos_tau(1.0f);
  for (int i = 0; i < steps; ++i) {
    const F inverse = reciprocal(cos_tau);
    const F excess = u * u * inverse * reciprocal(one + cos_tau);  // 1 / cos(tau) - 1
    const F missing = fnma(u, fnma(k, excess, slope), target);
    const F rise = fnma(k * excess, fma(inverse, inverse + one, one), slope);
    u = fma(missing, reciprocal(max(rise, F(1e-6f) * slope)), u);
    u = min(max(u, zero - s), s);
    cos_tau = sqrt(fnma(u, u, one));
  }
  // phi at the farther end, where an error of phi matters less; the other end has the same theta. The way to the
  // sphere, divided by the distance, is sin(phi) across the normal and cos(phi) - a along it.
  const Mask<F> x_is_farther = x_gap > y_gap;
  const F towards_y = select(x_is_farther, u, zero - u);
  const F cos_phi = fnma(s, towards_y, c * cos_tau), sin_phi = fma(c, towards_y, s * cos_tau);
  const F along = fnma(sin_phi * sin_phi, reciprocal(one + cos_phi), select(x_is_farther, x_gap, y_gap));
  const F inverse_way = inverse_sqrt(fma(sin_phi, sin_phi, along * along));
  const F b = sin_phi * inverse_way, cos_theta = along * inverse_way;
  const ReflectedRay<F> ray = reflected_ray(x, y, b, cos_theta);
  const Vec3<F> normal = fma(plane.middle, cos_tau, plane.sideways * u);
  return {Mask<F>((x.one_minus_a2 > zero) & (y.one_minus_a2 > zero) & (cos_theta > zero)),
          fma(plane.across_x, x.a * b, plane.to_x * (zero - ray.x.cos_end)),
          fma(plane.across_y, y.a * b, plane.to_y * (zero - ray.y.cos_end)),
          ray.x.length,
          ray.y.length,
          normal,
          normal,
          cos_theta,
          ray.tube};
}

/// A sphere of relative index n, described by omega, the larger of theta and theta_t.
template <class F>
struct SphereLens {
  F outside, inside;  ///< sin(theta) / sin(omega) and sin(theta_t) / sin(omega)
};

template <class F>
SphereLens<F> sphere_lens(F n) {
  return {min(n, F(1.0f)), min(reciprocal(n), F(1.0f))};
}

/// The rays of a refraction in and out with this omega. It turns by Phi = pi + turn about the centre.
template <class F>
struct RefractedRay {
  ChainLeg<F> x, y;
  F b, cos_theta;               ///< sine and cosine of theta
  F cos_turn, sin_turn_over_w;  ///< cos(turn) and sin(turn) / sin(omega)
  F slope;                      ///< d turn / d omega
  F tube;
};

template <class F>
RefractedRay<F> refracted_ray(const SphereLens<F>& lens, const ChainEnd<F>& x, const ChainEnd<F>& y, F sin_omega,
                              F cos_omega) {
  const F one(1.0f), two(2.0f);
  // For the angle whose sine is ratio * sin(omega): its cosine, and its derivative by omega.
  const auto cosine = [&](F ratio) {
    return sqrt(fma(ratio * ratio, cos_omega * cos_omega, (one - ratio) * (one + ratio)));
  };
  const auto rate = [&](F ratio, F cos) {
    return select(ratio < one, ratio * cos_omega * reciprocal(max(cos, F(1e-18f))), one);
  };
  const F b = lens.outside * sin_omega, cos_theta = cosine(lens.outside);
  const F sin_t = lens.inside * sin_omega, cos_t = cosine(lens.inside);
  const ChainLeg<F> at_x = chain_leg(x, b, cos_theta), at_y = chain_leg(y, b, cos_theta);
  // turn = phi_x + phi_y - 2 theta_t
  const F sin_sum_over_b = fma(at_x.sin_phi_over_b, at_y.cos_phi, at_x.cos_phi * at_y.sin_phi_over_b);
  const F cos_sum = fnma(at_x.sin_phi_over_b * at_y.sin_phi_over_b, b * b, at_x.cos_phi * at_y.cos_phi);
  const F sin_2t_over_w = two * lens.inside * cos_t, cos_2t = fnma(two * sin_t, sin_t, one);
  const F cos_turn = fma(cos_sum, cos_2t, sin_sum_over_b * b * (sin_2t_over_w * sin_omega));
  const F sin_turn_over_w = fnma(cos_sum, sin_2t_over_w, lens.outside * sin_sum_over_b * cos_2t);
  const F slope = fnma(two, rate(lens.inside, cos_t), rate(lens.outside, cos_theta) * (at_x.slope + at_y.slope));
  const F inverse = reciprocal(lens.outside);
  return {at_x,     at_y,
          b,        cos_theta,
          cos_turn, sin_turn_over_w,
          slope,    tube_area(x, y, at_x, at_y, slope * (inverse * reciprocal(cos_omega)), sin_turn_over_w * inverse)};
}

/// Sine and cosine of omega from u = tan(omega / 2), of which they are rational functions.
template <class F>
SinCos<F> of_half_tangent(F u) {
  const F inverse = reciprocal(fma(u, u, F(1.0f)));
  return {(u + u) * inverse, (F(1.0f) - u) * (F(1.0f) + u) * inverse};
}

/// cos(omega) at the fold, where `turn` is least. turn is 0 at omega = 0, and falls from there if d turn / d omega < 0.
/// For n > 1 that derivative is, in q = cos(omega), 2 minus concave rising functions s q / sqrt(1 - s^2 + s^2 q^2). So
/// turn is convex in omega and has at most one fold, and Newton's method from q = 0 rises to it. The result is 1 where
/// turn only rises, and 0 for n <= 1, where it only falls.
template <class F>
F fold_cosine(const SphereLens<F>& lens, const ChainEnd<F>& x, const ChainEnd<F>& y) {
  constexpr int steps = 6;
  const F one(1.0f), two(2.0f);
  const F lens_rest = (one - lens.inside) * (one + lens.inside);
  F q(0.0f);
  for (int i = 0; i < steps; ++i) {
    const auto inverse = [&](F s, F rest) { return inverse_sqrt(max(fma(s * s, q * q, rest), F(1e-18f))); };
    const F i_x = inverse(x.a, x.one_minus_a2), i_y = inverse(y.a, y.one_minus_a2),
            i_t = inverse(lens.inside, lens_rest);
    const F gained = q * fma(x.a, i_x, fma(y.a, i_y, two * lens.inside * i_t));
    const F rate = fma(x.a * x.one_minus_a2, i_x * i_x * i_x,
                       fma(y.a * y.one_minus_a2, i_y * i_y * i_y, two * lens.inside * lens_rest * (i_t * i_t * i_t)));
    q = min(fma(two - gained, reciprocal(rate), q), one);
  }
  const Mask<F> falls = x.a + y.a + two * lens.inside > two;
  return select(lens.inside < one, select(falls, q, one), F(0.0f));
}

/// All refractions of x to y in and out of a sphere of relative index `n`. Let Phi be the angle between x and y and
/// delta = pi - Phi. Then turn is -delta, or +delta for a ray that passes on the other side. Before the fold there may
/// be one root for -delta, after it one for each. Newton's method works on tan((turn - target) / 2), which is convex
/// where turn is and needs no angle, and stays inside its bracket. Of the hardest pairs of ends, fewer than one root in
/// 2000 is short of the accuracy of floats after five steps.
template <class F>
std::array<SphereChain<F>, 3> refracted_chains(const ChainPlane<F>& plane, const ChainEnd<F>& x, const ChainEnd<F>& y,
                                               F n) {
  constexpr int steps = 5;
  const F zero(0.0f), one(1.0f), two(2.0f);
  const SphereLens<F> lens = sphere_lens(n);
  const F fold_cos = fold_cosine(lens, x, y), fold_sin = sqrt(fnma(fold_cos, fold_cos, one));
  const F fold_u = fold_sin * reciprocal(one + fold_cos);
  const RefractedRay<F> fold = refracted_ray(lens, x, y, fold_sin, fold_cos);
  const RefractedRay<F> edge = refracted_ray(lens, x, y, one, zero);
  const F fold_turn_sin = fold.sin_turn_over_w * fold_sin, edge_turn_sin = edge.sin_turn_over_w;
  const F sin_delta = two * plane.cos_half * plane.sin_half;
  const F cos_delta = (plane.sin_half - plane.cos_half) * (plane.sin_half + plane.cos_half);

  const auto angle = [&](F sin, F cos) {  // in [-pi, pi], by the half angle
    const F half_cos = sqrt(max(F(0.5f) * (one + cos), F(0.25f)));
    const F half =
        arcsine(select(cos > zero, F(0.5f) * sin * reciprocal(half_cos), sqrt(max(F(0.5f) * (one - cos), zero))));
    return two * select(sin < zero, zero - abs(half), half);
  };
  const F delta = angle(sin_delta, cos_delta);
  const F fold_turn = angle(fold_turn_sin, fold.cos_turn), edge_turn = angle(edge_turn_sin, edge.cos_turn);
  const Mask<F> outside = (x.one_minus_a2 > zero) & (y.one_minus_a2 > zero);
  std::array<SphereChain<F>, 3> chains{};
  for (std::size_t k = 0; k < chains.size(); ++k) {
    const bool falling = k == 0;
    const F side(k == 2 ? 1.0f : -1.0f);
    const F sin_target = side * sin_delta, target = side * delta;
    const auto sin_above = [&](F sin_turn, F cos_turn) { return sin_turn * cos_delta - cos_turn * sin_target; };
    SphereChain<F>& chain = chains[k];
    chain.exists = outside & (sin_above(fold_turn_sin, fold.cos_turn) <= zero);
    if (falling) {
      chain.exists = chain.exists & (fold_sin > zero);
    } else {
      // At the edge, turn may be more than pi above -delta, and it may be below +delta.
      const Mask<F> above = sin_above(edge_turn_sin, edge.cos_turn) >= zero;
      const Mask<F> turns = edge_turn_sin >= zero;
      chain.exists = chain.exists & (k == 1 ? Mask<F>(turns | above) : Mask<F>(turns & above));
    }
    if (!any(chain.exists)) continue;

    const F span = falling ? zero - fold_turn : edge_turn - fold_turn;
    const F share = min(max((target - fold_turn) * reciprocal(max(span, F(1e-20f))), zero), one);
    F low = falling ? zero : fold_u, high = falling ? fold_u : one;
    const F way = sqrt(share);  // exact for a parabola about the fold
    F u = falling ? fnma(fold_u, way, fold_u) : fma(one - fold_u, way, fold_u);
    for (int i = 0; i < steps; ++i) {
      const SinCos<F> omega = of_half_tangent(u);
      const RefractedRay<F> ray = refracted_ray(lens, x, y, omega.sin, omega.cos);
      const F above = sin_above(ray.sin_turn_over_w * omega.sin, ray.cos_turn);
      const Mask<F> below_root = falling ? above > zero : above < zero;
      low = select(below_root, u, low);
      high = select(below_root, high, u);
      const F step = F(-0.5f) * above * reciprocal(ray.slope);
      const F next = (u + step) * reciprocal(fnma(u, step, one));
      u = select((next >= low) & (next <= high), next, F(0.5f) * (low + high));
    }
    const SinCos<F> omega = of_half_tangent(u);
    const RefractedRay<F> ray = refracted_ray(lens, x, y, omega.sin, omega.cos);
    const F b = (zero - side) * ray.b;  // +delta: on the other side
    chain.from_x = fma(plane.across_x, x.a * b, plane.to_x * (zero - ray.x.cos_end));
    chain.from_y = fma(plane.across_y, y.a * b, plane.to_y * (zero - ray.y.cos_end));
    chain.x_length = ray.x.length;
    chain.y_length = ray.y.length;
    chain.x_normal = fma(plane.across_x, b * ray.x.sin_phi_over_b, plane.to_x * ray.x.cos_phi);
    chain.y_normal = fma(plane.across_y, b * ray.y.sin_phi_over_b, plane.to_y * ray.y.cos_phi);
    chain.cos_theta = ray.cos_theta;
    chain.tube = ray.tube;
  }
  return chains;
}

}  // namespace glimt
