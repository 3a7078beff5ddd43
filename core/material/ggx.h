#pragma once

#include <numbers>

#include "math/vec.h"
#include "math/warp.h"
#include "scene/material.h"

/// The GGX distribution of microfacet normals, isotropic (Walter, Marschner, Li and Torrance, "Microfacet models for
/// refraction through rough surfaces", EGSR 2007), with Smith's height-correlated masking and shadowing (Heitz,
/// "Understanding the masking-shadowing function in microfacet-based BRDFs", JCGT 3(2), 2014). Directions are in the
/// surface's frame: z is its normal, cosines are their z.
namespace glimt {

/// Below this alpha a surface counts as smooth: the slopes of its facets are below a thousandth.
inline constexpr double smallest_alpha = 1e-3;

inline constexpr Parameter<double> ggx_roughness{
    .key = "roughness",
    .doc = "of the surface, from smooth to roughest; facets have slopes of about its square",
    .max = 1,
    .stored = "ggx roughness"};
inline double ggx_alpha(double roughness) { return roughness * roughness; }

template <class F>
struct Ggx {
  F alpha;  ///< width of the distribution of slopes

  /// sqrt(cos^2 + alpha^2 sin^2): the part of every masking term that depends on the roughness.
  F projected(F cos) const {
    const F cos2 = cos * cos;
    return sqrt(fma(alpha * alpha, max(F(1.0f) - cos2, F(0.0f)), cos2));
  }

  /// D, the density of microfacets with normal m per area of the surface, 1/sr (Walter et al., eq. 33). The sine of m
  /// comes from x and y, so it keeps its digits near the normal.
  F density(const Vec3<F>& m) const {
    const F alpha2 = alpha * alpha;
    const F t = fma(m.z * m.z, alpha2, fma(m.x, m.x, m.y * m.y));
    return alpha2 * reciprocal(max(F(std::numbers::pi_v<float>) * t * t, F(1e-30f)));
  }

  /// The pdf of the normals visible from wo, divided by 2 wo.m: D G1(wo) / (2 cos_o).
  F visible_density(const Vec3<F>& m, F cos_o) const { return density(m) * reciprocal(cos_o + projected(cos_o)); }

  /// Samples a normal visible from wo, in proportion to its projected area (Heitz, "Sampling the GGX distribution of
  /// visible normals", JCGT 7(4), 2018), by a spherical cap (Dupuy and Benyoub, "Sampling visible GGX normals with
  /// spherical caps", CGF 42(8), 2023).
  Vec3<F> visible_normal(const Vec3<F>& wo, F u, F v) const {
    const Vec3<F> stretched = normalize(Vec3<F>{wo.x * alpha, wo.y * alpha, wo.z});
    const F z = fma(F(1.0f) - v, F(1.0f) + stretched.z, F(0.0f) - stretched.z);
    const F sin = sqrt(max(fnma(z, z, F(1.0f)), F(0.0f)));
    const SinCos<F> turn = sincos_turns(u);
    const Vec3<F> half{fma(sin, turn.cos, stretched.x), fma(sin, turn.sin, stretched.y), z + stretched.z};
    return normalize(Vec3<F>{half.x * alpha, half.y * alpha, max(half.z, F(1e-7f))});
  }

  /// G2 / (4 cos_i cos_o), with both cosines positive.
  F visibility(F cos_i, F cos_o) const {
    return F(0.5f) * reciprocal(max(fma(cos_i, projected(cos_o), cos_o * projected(cos_i)), F(1e-20f)));
  }

  /// G2 / G1(wo): the weight of a sample of visible normals.
  F unmasked(F cos_i, F cos_o) const {
    const F of_o = projected(cos_o);
    return cos_i * (cos_o + of_o) * reciprocal(max(fma(cos_i, of_o, cos_o * projected(cos_i)), F(1e-20f)));
  }
};

}  // namespace glimt
