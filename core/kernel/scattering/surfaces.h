#pragma once

#include "kernel/geometry/intersect.h"
#include "material/lobes.h"
#include "math/sampler.h"
#include "math/warp.h"

/// Surfaces where camera paths and light paths meet them. Estimators know no materials. They ask a surface for its
/// colour, and for sample, evaluate and pdf_w of its BSDF without the colour.
namespace glimt {

/// The largest survival probability of Russian roulette, so that paths trapped in glass end; see compile_warnings.cpp.
inline constexpr float largest_survival = 0.99f;

/// The surface table and the lobes in it.
template <class F, Features features>
class Surfaces {
  using I = Int<F>;
  using M = Mask<F>;
  using V = Vec3<F>;
  using At = Interaction<F>;

 public:
  explicit Surfaces(const CompiledScene& scene) : scene_(scene), first_column_(scene.surfaces[Column{}]) {}

  F value(Column column, const At& at) const {
    if constexpr (features.small_table) {
      return lookup_small(first_column_ + static_cast<std::ptrdiff_t>(column) * small_stride, at.surface);
    } else {
      return lookup(scene_.surfaces[column], at.surface);
    }
  }
  V vector(Column first, const At& at) const {
    const int c = static_cast<int>(first);
    return {value(first, at), value(static_cast<Column>(c + 1), at), value(static_cast<Column>(c + 2), at)};
  }

  At meet(const Ray<F>& ray, const Hit<F>& hit) const {
    At at;
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

  /// The normal on the side that at.front names.
  V normal(const At& at) const { return own_normal(at) * select(at.front, F(1.0f), F(-1.0f)); }
  void look_up_kind(At& at) const { at.kind = as_int(value(Column::kind, at)); }

  static M is_matt(const At& at) { return less(at.kind, I(first_kind(LobeClass::delta))); }
  static M is_glossy(const At& at) {
    return less(at.kind, I(first_kind(LobeClass::none))) & !less(at.kind, I(first_kind(LobeClass::glossy)));
  }
  static M is_lamp(const At& at) { return !less(at.kind, I(first_kind(LobeClass::none))); }
  /// Whether the surface is flat, not a sphere.
  M is_flat(const At& at) const { return !(value(Column::inverse_radius, at) > F(0.0f)); }
  /// Whether light passes through the surface.
  static M transmits(const At& at) {
    M found = no_lanes<F>();
    for_each_lobe([&]<class L>() {
      if constexpr ((lobe_bit<L> & transmitting_lobes) != 0) found = found | equal(at.kind, I(lobe_kind<L>));
    });
    return found;
  }
  /// Whether a matt surface is equally bright in all directions.
  M is_even(const At& at) const {
    return has_rough_matt() ? equal(at.kind, I(lobe_kind<LambertianLobe>)) : all_lanes<F>();
  }

  static constexpr bool may_be_glossy() { return (features.lobes & lobes_of(LobeClass::glossy)) != 0; }
  bool has_glossy() const { return may_be_glossy() && (scene_.lobes & lobes_of(LobeClass::glossy)) != 0; }
  /// Whether some matt surface is not Lambertian.
  bool has_rough_matt() const {
    constexpr LobeSet rough = lobes_of(LobeClass::cosine) & ~lobe_bit<LambertianLobe>;
    return (features.lobes & rough) != 0 && (scene_.lobes & rough) != 0;
  }
  /// Whether some surface is glass.
  bool has_glass() const { return scene_.has_glass; }

  /// The factor of all light that the surface scatters.
  V colour(const At& at) const { return vector(Column::reflectance_r, at); }

  /// Samples the direction in which a path from wo goes on. `lobe` is a third random number for lobes that need one.
  /// Lanes at lamps go straight on; the caller ends them.
  ScatterSample<F> sample(const At& at, const V& wo, const Point2<F>& uv, F lobe) const {
    ScatterSample<F> s{wo * F(-1.0f), V::all(F(1.0f)), F(0.0f), no_lanes<F>(), F(1.0f), F(1.0f)};
    const M matt = is_matt(at);
    if (any(matt)) {
      const V wi = cosine_hemisphere(at.normal, uv.u, uv.v);
      const F cos_i = dot(wi, at.normal);
      s.direction = select(matt, wi, s.direction);
      s.pdf_w = cos_i * F(std::numbers::inv_pi_v<float>);
      if (has_rough_matt()) s.weight = evaluate_matt(at, wi, wo, cos_i, at.cos_o);
    }
    for_each_lobe([&]<class L>() {
      if constexpr (L::lobe_class == LobeClass::delta) {
        if (!has<L>()) return;
        const M mask = equal(at.kind, I(lobe_kind<L>));
        if (any(mask)) take<L>(s, mask, L::sample(Row<L>{*this, at}, wo, uv.u, uv.v, lobe));
      }
    });
    if (has_glossy() && any(is_glossy(at))) sample_glossy(at, wo, uv, lobe, s);
    return s;
  }

  /// The BSDF divided by colour / pi, for light from wi and radiance towards wo. Meaningless for delta lobes. Cosines
  /// are to at.normal.
  V evaluate(const At& at, const V& wi, const V& wo, F cos_i, F cos_o) const {
    V f = evaluate_matt(at, wi, wo, cos_i, cos_o);
    if (has_glossy() && any(is_glossy(at))) evaluate_glossy(at, wi, wo, cos_i, cos_o, f);
    return f;
  }
  /// The same where every lane that counts is at a matt surface.
  V evaluate_matt(const At& at, const V& wi, const V& wo, F cos_i, F cos_o) const {
    V f = V::all(F(1.0f));
    for_each_lobe([&]<class L>() {
      if constexpr (L::lobe_class == LobeClass::cosine && !std::is_same_v<L, LambertianLobe>) {
        if (!has<L>()) return;
        const M mask = equal(at.kind, I(lobe_kind<L>));
        f = select(mask, L::evaluate(Row<L>{*this, at}, wi, wo, cos_i, cos_o), f);
      }
    });
    return f;
  }

  /// The pdf with which sample() chooses wi, 1/sr. Meaningless for delta lobes.
  F pdf_w(const At& at, const V& wi, const V& wo, F cos_i, F cos_o) const {
    F pdf = cos_i * F(std::numbers::inv_pi_v<float>);
    if (has_glossy() && any(is_glossy(at))) pdf_w_glossy(at, wi, wo, cos_i, cos_o, pdf);
    return pdf;
  }

 private:
  /// A lobe's view of the surface table: its own columns by number.
  template <class L>
  struct Row {
    const Surfaces& surfaces;
    const At& at;

    F operator()(int column) const { return surfaces.value(lobe_column(first_column<L>() + column), at); }
    V vector(int first) const { return surfaces.vector(lobe_column(first_column<L>() + first), at); }
    /// Index behind the surface's front divided by the index before it.
    F eta() const { return surfaces.value(Column::eta, at); }
  };

  /// Whether some surface of the scene has the lobe.
  template <class L>
  bool has() const {
    return (features.lobes & lobe_bit<L>) != 0 && (scene_.lobes & lobe_bit<L>) != 0;
  }

  /// Takes from `other` what the lobe may change of a sample.
  template <class L>
  static void take(ScatterSample<F>& s, const M& mask, const ScatterSample<F>& other) {
    s.direction = select(mask, other.direction, s.direction);
    if constexpr (L::weighs) s.weight = select(mask, other.weight, s.weight);
    if constexpr (L::lobe_class == LobeClass::glossy) s.pdf_w = select(mask, other.pdf_w, s.pdf_w);
    if constexpr (L::transmits) {
      s.crosses = s.crosses | (mask & other.crosses);
      s.eta2 = select(mask, other.eta2, s.eta2);
      s.inverse_eta2 = select(mask, other.inverse_eta2, s.inverse_eta2);
    }
  }

  /// Calls f.template operator()<L>(mask) for each glossy lobe and the lanes that have it.
  template <class Function>
  void for_glossy(const At& at, Function f) const {
    for_each_lobe([&]<class L>() {
      if constexpr (L::lobe_class == LobeClass::glossy) {
        if (!has<L>()) return;
        const M mask = equal(at.kind, I(lobe_kind<L>));
        if (any(mask)) f.template operator()<L>(mask);
      }
    });
  }

  // Not inlined: the compiler would need minutes for a function with several copies of these.
  [[gnu::noinline]] void sample_glossy(const At& at, const V& wo, const Point2<F>& uv, const F& lobe,
                                       ScatterSample<F>& s) const {
    for_glossy(at, [&]<class L>(const M& mask) {
      take<L>(s, mask, L::sample(Row<L>{*this, at}, wo, uv.u, uv.v, lobe));
    });
  }
  [[gnu::noinline]] void evaluate_glossy(const At& at, const V& wi, const V& wo, const F& cos_i, const F& cos_o,
                                         V& f) const {
    for_glossy(at, [&]<class L>(const M& mask) {
      f = select(mask, L::evaluate(Row<L>{*this, at}, wi, wo, cos_i, cos_o), f);
    });
  }
  [[gnu::noinline]] void pdf_w_glossy(const At& at, const V& wi, const V& wo, const F& cos_i, const F& cos_o,
                                      F& pdf) const {
    for_glossy(at, [&]<class L>(const M& mask) {
      pdf = select(mask, L::pdf_w(Row<L>{*this, at}, wi, wo, cos_i, cos_o), pdf);
    });
  }

  V own_normal(const At& at) const {
    const V n = vector(Column::normal_x, at);
    const F inverse_radius = value(Column::inverse_radius, at);
    return select(inverse_radius > F(0.0f), (at.point - n) * inverse_radius, n);
  }

  static constexpr int small_stride = 32;  ///< stride of tables with up to 32 rows, so that columns have fixed places
  static_assert(small_table <= small_stride && small_stride == Table<Column>::padding);

  const CompiledScene& scene_;
  const float* first_column_;
};

}  // namespace glimt
