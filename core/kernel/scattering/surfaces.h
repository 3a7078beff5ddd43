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
    } else if constexpr (features.tree) {
      return lookup(scene_.surfaces[column], at.row);
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
    find_row(at);
    at.point = fma(ray.direction, hit.t, ray.origin);
    at.normal = own_normal(at);
    const F cos = dot(at.normal, ray.direction);
    at.front = cos < F(0.0f);
    at.normal = at.normal * select(at.front, F(1.0f), F(-1.0f));
    at.cos_o = abs(cos);
    at.kind = as_int(value(Column::kind, at));
    if constexpr (features.tree) shade(at, ray.direction);
    return at;
  }

  // Smooth triangles are shaded with a normal that varies over them. Their own, `flat`, decides which directions are
  // on which side: a direction that a lobe leads to the wrong side is mirrored at the triangle, so all energy stays.

  /// Whether some triangles are smooth.
  bool has_smooth() const {
    if constexpr (features.tree) return scene_.tree && !scene_.tree->normals.empty();
    return false;
  }
  /// The lanes of a mask that are not of smooth triangles.
  M without_smooth(const M& mask, const At& at) const { return has_smooth() ? mask & !at.smooth : mask; }
  /// Cosine of a direction to the surface, not to the normal for shading.
  F flat_cos(const At& at, const V& w, F cos) const {
    return has_smooth() ? select(at.smooth, dot(at.flat, w), cos) : cos;
  }
  /// Puts a sample on the side that it is to be on. `needs_pdf`: with its density, for MIS.
  void keep_side(const At& at, const V& wo, ScatterSample<F>& s, bool needs_pdf = false) const {
    if (!has_smooth() || !any(at.smooth)) return;
    const F height = dot(s.direction, at.flat);
    const M wrong = at.smooth & ((s.crosses & (height > F(0.0f))) | ((!s.crosses) & (height < F(0.0f))));
    s.direction = select(wrong, mirrored(at, s.direction), s.direction);
    if (needs_pdf) s.pdf_w = select(at.smooth, folded_pdf_w(at, s.direction, wo), s.pdf_w);
  }
  /// The cosine of a direction to matt surfaces, its mirror image counted in.
  F folded_cos(const At& at, const V& wi) const {
    F sum(0.0f);
    for_unfolded(at, wi, [&](const M& mask, const V&, F cos) { sum = select(mask, sum + abs(cos), sum); });
    return sum;
  }
  /// BSDF |cos| over colour / pi, and the density, of a direction, its mirror image counted in.
  V folded_evaluate(const At& at, const V& wi, const V& wo) const {
    V sum = V::all(F(0.0f));
    for_unfolded(at, wi, [&](const M& mask, const V& w, F cos) {
      sum = select(mask, fma(evaluate(at, w, wo, cos, at.cos_o), abs(cos), sum), sum);
    });
    return sum;
  }
  F folded_pdf_w(const At& at, const V& wi, const V& wo) const {
    F sum(0.0f);
    for_unfolded(at, wi, [&](const M& mask, const V& w, F cos) {
      sum = select(mask, sum + pdf_w(at, w, wo, cos, at.cos_o), sum);
    });
    return sum;
  }

  /// The normal on the side that at.front names.
  V normal(const At& at) const { return own_normal(at) * select(at.front, F(1.0f), F(-1.0f)); }
  void look_up_kind(At& at) const { at.kind = as_int(value(Column::kind, at)); }
  /// The row of `at.surface`; before all else is asked of a surface that was not met.
  void find_row(At& at) const {
    at.row = at.surface;
    if constexpr (features.tree) {
      if (!scene_.tree) return;
      const M in_tree = is_in_tree(at);
      if (!any(in_tree)) return;
      const I part = lookup(scene_.tree->part.data(), place(at));
      at.row = select(in_tree, lookup(scene_.tree_rows.data(), part), at.surface);
    }
  }
  /// Its piece's row of the lamp table, or -1.
  I lamp_row(const At& at) const {
    const I row = as_int(value(Column::lamp, at));
    if constexpr (features.tree)
      if (!scene_.tree_lamps.empty()) return select(is_in_tree(at), lookup(scene_.tree_lamps.data(), place(at)), row);
    return row;
  }

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

  static V mirrored(const At& at, const V& w) {
    const F height = dot(w, at.flat);
    return fnma(at.flat, height + height, w);
  }

  /// f(mask, w, cosine) for the directions that become wi: itself and its mirror image, where the normal for shading
  /// has them on the side that wi is on.
  template <class Function>
  static void for_unfolded(const At& at, const V& wi, Function f) {
    const M above = dot(wi, at.flat) > F(0.0f);
    const auto consider = [&](const V& w) {
      const F cos = dot(w, at.normal);
      f((above & (cos > F(0.0f))) | ((!above) & (cos < F(0.0f))), w, cos);
    };
    consider(wi);
    consider(mirrored(at, wi));
  }

  /// The normal for shading of smooth triangles.
  void shade(At& at, const V& direction) const {
    if (!has_smooth()) return;
    at.smooth = no_lanes<F>();
    const M in_tree = is_in_tree(at);
    if (!any(in_tree)) return;
    V own = smooth_normal(place(at), at.point, at.smooth);
    at.smooth = at.smooth & in_tree;
    if (!any(at.smooth)) return;
    own = own * select(at.front, F(1.0f), F(-1.0f));
    const V wo = direction * F(-1.0f);
    // Lobes that depend on wo get a normal that looks towards it.
    const F least(1e-3f), cos = dot(own, wo);
    const M bent = (cos < least) & !is_matt(at);
    if (any(bent)) own = select(bent, normalize(fma(wo, least - cos, own)), own);
    at.flat = at.normal;
    at.normal = select(at.smooth, own, at.normal);
    at.cos_o = select(at.smooth, max(dot(own, wo), least), at.cos_o);
  }

  /// Index of the first corner of a triangle in the tree's packets; its others and their axes come every `width`.
  static I corner_index(const I& place) {
    constexpr auto width = static_cast<std::int32_t>(TreeNode::width);
    return (place >> std::countr_zero(TreeNode::width)) * I(9 * width) + (place & I(width - 1));
  }
  /// [corner]
  static std::array<V, 3> corners(const float* packets, const I& first) {
    constexpr auto width = static_cast<std::int32_t>(TreeNode::width);
    const auto value = [&](std::int32_t number) { return lookup(packets, first + I(number * width)); };
    return {V{value(0), value(1), value(2)}, V{value(3), value(4), value(5)}, V{value(6), value(7), value(8)}};
  }

  /// Between the normals at the corners, in the lanes of `smooth`, which it finds.
  [[gnu::noinline]] V smooth_normal(const I& place, const V& point, M& smooth) const {
    const I first = corner_index(place);
    const auto v = corners(scene_.tree->packets.front().corner[0][0].data(), first);
    const auto n = corners(scene_.tree->normals.front().corner[0][0].data(), first);
    const F unit(scene_.tree->unit), zero(0.0f), one(1.0f);
    const V e1 = (v[1] - v[0]) * unit, e2 = (v[2] - v[0]) * unit, p = (point - v[0]) * unit, across = cross(e1, e2);
    const F inverse = reciprocal(dot(across, across));
    const F b1 = min(max(dot(cross(p, e2), across) * inverse, zero), one);
    const F b2 = min(max(dot(cross(e1, p), across) * inverse, zero), one - b1);
    const V between = fma(n[2] - n[0], b2, fma(n[1] - n[0], b1, n[0]));
    const F square = dot(between, between);
    smooth = square > zero;
    return between * inverse_sqrt(select(smooth, square, one));
  }

  V own_normal(const At& at) const {
    const V n = vector(Column::normal_x, at);
    const F inverse_radius = value(Column::inverse_radius, at);
    const V own = select(inverse_radius > F(0.0f), (at.point - n) * inverse_radius, n);
    if constexpr (features.tree) {
      if (!scene_.tree) return own;
      const M in_tree = is_in_tree(at);
      if (any(in_tree)) return select(in_tree, triangle_normal(place(at)), own);
    }
    return own;
  }

  static M is_in_tree(const At& at) { return !less(at.surface, I(first_tree_surface)); }
  /// In the tree; 0 for surfaces that are in none.
  static I place(const At& at) { return select(is_in_tree(at), at.surface - I(first_tree_surface), I(0)); }

  /// Of the triangle in that place, to its front.
  [[gnu::noinline]] V triangle_normal(const I& place) const {
    const auto v = corners(scene_.tree->packets.front().corner[0][0].data(), corner_index(place));
    const F unit(scene_.tree->unit);  // so that products of small lengths do not vanish
    const V n = cross((v[1] - v[0]) * unit, (v[2] - v[0]) * unit);
    const F square = dot(n, n);
    return n * inverse_sqrt(select(square > F(0.0f), square, F(1.0f)));
  }

  static constexpr int small_stride = 32;  ///< stride of tables with up to 32 rows, so that columns have fixed places
  static_assert(small_table <= small_stride && small_stride == Table<Column>::padding);

  const CompiledScene& scene_;
  const float* first_column_;
};

}  // namespace glimt
