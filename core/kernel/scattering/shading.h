#pragma once

#include <algorithm>

#include "kernel/geometry/intersect.h"
#include "kernel/scattering/bsdf.h"

/// Surfaces where paths meet them, for paths from the camera and from lamps alike.
namespace glimt {

/// What a hit point looks like.
template <class F>
struct Shading {
  Vec3<F> point;
  Vec3<F> normal;  ///< unit, to the side the ray comes from
  F cos_o;         ///< of the ray's way back to the normal
  Mask<F> front;   ///< the side of the surface's own normal
  Int<F> surface;
  Int<F> kind;
};

/// What roulette leaves at most, so that light trapped in glass ends; see compile_warnings.cpp.
inline constexpr float largest_survival = 0.99f;

/// Where a path goes on from glass.
template <class F>
struct GlassScatter {
  Vec3<F> direction;
  Mask<F> enters;  ///< it was refracted, not reflected
  F eta2;          ///< square of the index behind the surface over the index before it
  F inverse_eta2;
};

/// The surface table and the BSDFs in it.
template <class F, Features features>
class Surfaces {
  using M = Mask<F>;
  using V = Vec3<F>;

 public:
  explicit Surfaces(const CompiledScene& scene) : scene_(scene), first_column_(scene.surfaces[Column{}]) {}

  F value(Column column, const Shading<F>& at) const {
    if constexpr (features.small_table) {
      return lookup_small(first_column_ + static_cast<std::ptrdiff_t>(column) * small_stride, at.surface);
    } else {
      return lookup(scene_.surfaces[column], at.surface);
    }
  }
  V vector(Column first, const Shading<F>& at) const {
    const int c = static_cast<int>(first);
    return {value(first, at), value(static_cast<Column>(c + 1), at), value(static_cast<Column>(c + 2), at)};
  }
  /// A plane or triangle, not a sphere.
  M is_flat(const Shading<F>& at) const { return !(value(Column::inverse_radius, at) > F(0.0f)); }
  V reflectance(const Shading<F>& at) const { return vector(Column::reflectance_r, at); }

  Shading<F> shade(const Ray<F>& ray, const Hit<F>& hit) const {
    Shading<F> at;
    at.surface = hit.surface;
    at.point = fma(ray.direction, hit.t, ray.origin);
    at.normal = own_normal(at);
    const F cos = dot(at.normal, ray.direction);
    at.front = cos < F(0.0f);
    at.normal = at.normal * select(at.front, F(1.0f), F(-1.0f));
    at.cos_o = abs(cos);
    at.kind = as_int(value(Column::kind, at));
    return at;
  }

  /// To the side that `at` says.
  V normal(const Shading<F>& at) const { return own_normal(at) * select(at.front, F(1.0f), F(-1.0f)); }

  bool has_oren_nayar() const { return features.rare ? scene_.has_oren_nayar : features.oren_nayar; }
  bool has_eon() const { return features.rare && scene_.has_eon; }
  /// Whether some diffuse surface is not Lambertian.
  bool has_rough() const { return has_oren_nayar() || has_eon(); }

  OrenNayarFactors<F> oren_nayar(const Shading<F>& at) const {
    return {value(Column::oren_nayar_a, at), value(Column::oren_nayar_b, at),
            value(Column::oren_nayar_report, at) > F(0.5f)};
  }

  /// The BRDF over rho / pi.
  V diffuse_factor(const Shading<F>& at, const V& wi, const V& wo, F cos_i) const {
    return diffuse_factor(at, wi, wo, cos_i, at.cos_o);
  }
  V diffuse_factor(const Shading<F>& at, const V& wi, const V& wo, F cos_i, F cos_o) const {
    const V rough = V::all(oren_nayar_factor(oren_nayar(at), wi, wo, cos_i, cos_o));
    if (!has_eon()) return rough;
    const EonFactors<F> eon{value(Column::oren_nayar_a, at), value(Column::oren_nayar_b, at),
                            vector(Column::eon_multiple_r, at)};
    return select(value(Column::eon, at) > F(0.5f), eon_factor(eon, wi, wo, cos_i, cos_o), rough);
  }

  /// A hollow mirror multiplies what the length is off at every hit.
  V mirrored(const V& direction, const Shading<F>& at) const {
    return normalize(reflect(direction, at.normal, at.cos_o));
  }

  /// Reflection or refraction, chosen by Fresnel with the number u, so that neither has a weight.
  GlassScatter<F> scatter_glass(const V& direction, const Shading<F>& at, F u) const {
    const F ratio = value(Column::eta, at);
    const F inverse = reciprocal(ratio);
    const F eta = select(at.front, ratio, inverse);
    const F inverse_eta = select(at.front, inverse, ratio);
    const Dielectric<F> interface = fresnel(at.cos_o, eta, inverse_eta, value(Column::schlick, at) > F(0.5f));
    const M reflected = u < interface.reflected;
    const V back = reflect(direction, at.normal, at.cos_o);
    const V through = refract(direction, at.normal, at.cos_o, interface.cos_t, inverse_eta);
    // Many in a row would let the length drift.
    return {normalize(select(reflected, back, through)), !reflected, eta * eta, inverse_eta * inverse_eta};
  }

 private:
  V own_normal(const Shading<F>& at) const {
    const V n = vector(Column::normal_x, at);
    const F inverse_radius = value(Column::inverse_radius, at);
    return select(inverse_radius > F(0.0f), (at.point - n) * inverse_radius, n);
  }

  static constexpr int small_stride = 32;  ///< of tables with up to 32 rows, so that columns are at fixed places

  const CompiledScene& scene_;
  const float* first_column_;
};

/// The settings that the kernel may be compiled for; numbers among them are read at run time.
inline constexpr Settings usual_settings{};

template <Features features>
const Settings& settings_of(const CompiledScene& scene) {
  return features.rare ? scene.settings : usual_settings;
}

/// Whether `usual_settings` are the scene's, but for those that are read at run time.
inline bool has_usual_settings(const Settings& s) {
  const Settings& usual = usual_settings;
  return s.light_sampling == usual.light_sampling && s.mis == usual.mis && s.sampler == usual.sampler &&
         s.max_depth == usual.max_depth;
}

/// f(std::integral_constant<Features, features>{}) with what the scene needs.
template <class Function>
void with_features(const CompiledScene& scene, Function f) {
  const bool rare = scene.has_glow || !scene.triangles.empty() || !scene.shells.empty() || scene.room_hides_lamps ||
                    scene.has_eon || scene.cutaway || !has_usual_settings(scene.settings) ||
                    std::any_of(scene.solids.begin(), scene.solids.end(), [](const Solid& s) { return s.glass; });
  const bool one = scene.lamps.rows() == 1 && scene.has_lamp_shape[static_cast<std::size_t>(LampShape::parallelogram)];
  const bool caustics =
      scene.light_paths > 0 || !scene.chain_spheres.empty() || scene.settings.caustics != usual_settings.caustics;
  const auto usual = [&]<bool oren_nayar>() {
    if (caustics) {
      f(std::integral_constant<Features, Features{true, true, oren_nayar, true, false}>{});
    } else {
      f(std::integral_constant<Features, Features{true, true, oren_nayar, false, false}>{});
    }
  };
  if (rare || !one || scene.surfaces.rows() > small_table) {
    f(std::integral_constant<Features, Features{false, false, true, true, true}>{});
  } else if (scene.has_oren_nayar) {
    usual.template operator()<true>();
  } else {
    usual.template operator()<false>();
  }
}

}  // namespace glimt
