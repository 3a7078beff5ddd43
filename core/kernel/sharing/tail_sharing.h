#pragma once

#include <array>
#include <bit>
#include <vector>

#include "kernel/geometry/squares.h"
#include "kernel/scattering/surfaces.h"
#include "kernel/transport/path_sums.h"

/// The four pixels of a square share the ends of their paths (Bekaert, Sbert and Halton, "Accelerating path tracing by
/// re-using paths", 2002). A path has a first diffuse surface x. If it then meets a matt surface y that is equally
/// bright in all directions, it has a tail: the radiance that leaves y. The tail that one pixel found is offered to the
/// x of the others. Its weight at each x is the balance heuristic over all x that could have found y. So three
/// visibility rays give a pixel four tails. The weights of a tail add up to 1 over the square: sharing never makes it
/// brighter.
namespace glimt {

/// The first diffuse surface of a path, kept until the path has met the next surface.
template <class F>
struct FirstDiffuse {
  Ray<F> ray;  ///< to the next surface
  Mask<F> front;
  Int<F> of_class;     ///< only surfaces of the same class share
  Vec3<F> throughput;  ///< includes the reflectance, but not the rest of a rough surface's BRDF
  Vec3<F> wo;          ///< for rough surfaces only
};

/// What is known of each path of a block, by the path's place.
struct TailTable {
  enum Number : std::size_t { x_point, x_throughput = 3, y_point = 6, x_wo = 9, number_count = 12 };
  enum Integer : std::size_t { x_class, x_side, y_side, integer_count };
  static constexpr std::int32_t none = -1;  ///< value of integers where there is no such surface

  std::array<std::vector<float>, number_count> numbers;
  std::array<std::vector<std::int32_t>, integer_count> integers;

  /// Begins with this many paths of which nothing is known. Keeps its memory.
  void begin(int places) {
    for (auto& column : numbers) column.resize(static_cast<std::size_t>(places));
    for (auto& column : integers) column.assign(static_cast<std::size_t>(places), none);
  }
};

template <class F, Features features>
class TailSharing {
  using I = Int<F>;
  using M = Mask<F>;
  using V = Vec3<F>;
  using T = TailTable;
  using Sums = PathSums<F>;

 public:
  TailSharing(const CompiledScene& scene, TailTable& table) : scene_(scene), surfaces_(scene), table_(table) {}

  /// Records, for the paths in the mask, x and the surface after it, which is their y where `is_y`.
  void add(const FirstDiffuse<F>& x, const Interaction<F>& y, const M& is_y, const I& place, const M& mask) {
    const auto next = static_cast<std::size_t>(count_);
    const auto keep = [&](const V& v, std::size_t c) {
      compress<F, F>(v.x, mask, &numbers_[c][next]);
      compress<F, F>(v.y, mask, &numbers_[c + 1][next]);
      compress<F, F>(v.z, mask, &numbers_[c + 2][next]);
    };
    keep(x.ray.origin, T::x_point);
    keep(x.throughput, T::x_throughput);
    keep(y.point, T::y_point);
    if (surfaces_.has_rough_matt()) keep(x.wo, T::x_wo);
    compress<I, F>(x.of_class, mask, &integers_[T::x_class][next]);
    compress<I, F>(side(x.ray.from, x.front), mask, &integers_[T::x_side][next]);
    compress<I, F>(select(is_y, side(y.surface, y.front), I(T::none)), mask, &integers_[T::y_side][next]);
    compress<I, F>(place, mask, &place_[next]);
    count_ += std::popcount(bits(mask));
    if (count_ >= capacity) flush();
  }

  /// Adds to the paths' own sums their shares of the tails in their squares.
  void share(const Squares<F>& squares, Sums& sums) {
    flush();
    for (int first = 0; first < squares.plane; first += lane_count<F>) share_squares(first, squares.plane, sums);
  }

 private:
  static constexpr std::size_t members = Squares<F>::members;

  /// A number for a surface and one side of it.
  static I side(const I& surface, const M& front) { return surface + surface + select(front, I(1), I(0)); }

  void flush() {
    const auto count = static_cast<std::size_t>(count_);
    const auto move = [&](const auto& from, auto& to) {
      for (std::size_t i = 0; i < count; ++i) to[static_cast<std::size_t>(place_[i])] = from[i];
    };
    for (std::size_t c = 0; c < (surfaces_.has_rough_matt() ? T::number_count : T::x_wo); ++c)
      move(numbers_[c], table_.numbers[c]);
    for (std::size_t c = 0; c < T::integer_count; ++c) move(integers_[c], table_.integers[c]);
    count_ = 0;
  }

  V vector(T::Number first, int place) const {
    const auto number = [&](std::size_t c) { return load<F>(table_.numbers[c].data() + place); };
    return {number(first), number(first + 1), number(first + 2)};
  }
  I integer(T::Integer column, int place) const { return load<I>(table_.integers[column].data() + place); }

  /// A surface that was recorded; any surface where there is none.
  Interaction<F> surface(T::Number point, T::Integer column, int place) const {
    const I side = integer(column, place), known = select(less(side, I(0)), I(0), side);
    Interaction<F> at;
    at.point = vector(point, place);
    at.surface = known >> 1;
    at.front = equal(known & I(1), I(1));
    surfaces_.find_row(at);
    at.normal = surfaces_.normal(at);
    return at;
  }

  /// Shares all tails of as many squares as there are lanes.
  void share_squares(int first, int plane, Sums& sums) const {
    const auto place = [&](std::size_t member) { return first + static_cast<int>(member) * plane; };
    std::array<Interaction<F>, members> x;
    std::array<V, members> got;
    for (std::size_t k = 0; k < members; ++k) {
      x[k] = surface(T::x_point, T::x_side, place(k));
      if (surfaces_.has_rough_matt()) {
        surfaces_.look_up_kind(x[k]);
        x[k].cos_o = dot(vector(T::x_wo, place(k)), x[k].normal);
      }
      got[k] = V::all(F(0.0f));
    }
    for (std::size_t j = 0; j < members; ++j) {
      const M tailed = less(I(T::none), integer(T::y_side, place(j)));
      if (!any(tailed)) continue;
      const Interaction<F> y = surface(T::y_point, T::y_side, place(j));
      const I of_class = integer(T::x_class, place(j));
      std::array<F, members> pdf_a;  // pdf with which x would have found y, times pi
      std::array<V, members> way;
      F sum(0.0f);
      for (std::size_t k = 0; k < members; ++k) {
        const V between = y.point - x[k].point;
        const F inverse = inverse_sqrt(max(dot(between, between), F(1e-30f)));
        way[k] = between * inverse;
        const F cos_x = dot(way[k], x[k].normal), cos_y = dot(way[k] * F(-1.0f), y.normal);
        M finds = tailed;
        if (k != j) {
          finds = finds & equal(integer(T::x_class, place(k)), of_class) & (cos_x > F(0.0f)) & (cos_y > F(0.0f));
          const Ray<F> ray{x[k].point, way[k], x[k].surface};
          finds = finds & !occluded<F, features, true>(scene_, ray, reciprocal(inverse), y.surface, y.surface, finds);
        }
        pdf_a[k] = select(finds, max(cos_x * cos_y, F(1e-20f)) * (inverse * inverse), F(0.0f));
        sum = sum + pdf_a[k];
      }
      const V tail = sums.load(Sums::tail, place(j)) * reciprocal(sum);
      for (std::size_t k = 0; k < members; ++k) {
        V light = tail * pdf_a[k];
        if (k == j) light = light + sums.load(Sums::alone, place(j));
        if (surfaces_.has_rough_matt())
          light = light * surfaces_.evaluate_matt(x[k], way[k], vector(T::x_wo, place(k)), dot(way[k], x[k].normal),
                                                  x[k].cos_o);
        // Other lanes may hold NaN.
        got[k] = got[k] + select(pdf_a[k] > F(0.0f), light, V::all(F(0.0f)));
      }
    }
    for (std::size_t k = 0; k < members; ++k)
      sums.store_own(fma(vector(T::x_throughput, place(k)), got[k], sums.load(Sums::own, place(k))), place(k));
  }

  static constexpr int capacity = 128;
  template <class Element>
  using Waiting = std::array<Element, capacity + 2 * lane_count<F>>;

  const CompiledScene& scene_;
  Surfaces<F, features> surfaces_;
  TailTable& table_;
  int count_ = 0;  ///< paths that are not in the table yet
  std::array<Waiting<float>, T::number_count> numbers_;
  std::array<Waiting<std::int32_t>, T::integer_count> integers_;
  Waiting<std::int32_t> place_;
};

}  // namespace glimt
