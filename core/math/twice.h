#pragma once

#include "math/lanes.h"

/// Two batches side by side as one lane type. An operation on it is two operations that do not wait for each other,
/// which hides latency. That pays where there are enough registers for both.
namespace glimt {

/// `V` is a batch of float, int32 or uint32.
template <class V>
struct Twice {
  V a, b;

  Twice() = default;
  Twice(V low, V high) : a(low), b(high) {}
  template <class T>
  requires(std::is_arithmetic_v<T> || std::is_enum_v<T>) Twice(T value)  // NOLINT: as implicit as a batch's
      : a(static_cast<typename V::value_type>(value)), b(a) {}

  static constexpr std::size_t size = 2 * V::size;
  static Twice load_unaligned(const auto* from) { return {V::load_unaligned(from), V::load_unaligned(from + V::size)}; }
  void store_unaligned(auto* to) const {
    a.store_unaligned(to);
    b.store_unaligned(to + V::size);
  }
  static Twice expand(Twice old, const auto& mask, const auto* from) {
    return {glimt::expand<V, NativeLanes>(old.a, mask.a, from),
            glimt::expand<V, NativeLanes>(old.b, mask.b, from + std::popcount(bits(mask.a)))};
  }
  void compress(const auto& mask, auto* to) const {
    glimt::compress<V, NativeLanes>(a, mask.a, to);
    glimt::compress<V, NativeLanes>(b, mask.b, to + std::popcount(bits(mask.a)));
  }

  friend Twice operator+(Twice x, Twice y) { return {x.a + y.a, x.b + y.b}; }
  friend Twice operator-(Twice x, Twice y) { return {x.a - y.a, x.b - y.b}; }
  friend Twice operator*(Twice x, Twice y) { return {x.a * y.a, x.b * y.b}; }
  friend Twice operator&(Twice x, Twice y) { return {x.a & y.a, x.b & y.b}; }
  friend Twice operator|(Twice x, Twice y) { return {x.a | y.a, x.b | y.b}; }
  friend Twice operator^(Twice x, Twice y) { return {x.a ^ y.a, x.b ^ y.b}; }
  friend Twice operator<<(Twice x, int bits) { return {x.a << bits, x.b << bits}; }
  friend Twice operator>>(Twice x, int bits) { return {x.a >> bits, x.b >> bits}; }
  Twice& operator^=(Twice y) { return *this = *this ^ y; }
};

template <class M>
struct TwiceMask {
  M a, b;

  TwiceMask() = default;
  TwiceMask(M low, M high) : a(low), b(high) {}

  friend TwiceMask operator&(TwiceMask x, TwiceMask y) { return {x.a & y.a, x.b & y.b}; }
  friend TwiceMask operator|(TwiceMask x, TwiceMask y) { return {x.a | y.a, x.b | y.b}; }
  friend TwiceMask operator!(TwiceMask x) { return {!x.a, !x.b}; }
};

template <class V>
struct LaneTypes<Twice<V>> {
  using Int = Twice<typename LaneTypes<V>::Int>;
  using Uint = Twice<typename LaneTypes<V>::Uint>;
  using Mask = TwiceMask<typename LaneTypes<V>::Mask>;
  static constexpr int width = 2 * LaneTypes<V>::width;
};

/// The lanes of the kernel: 32, 8 or 4. With the sixteen registers of AVX2, two batches gained nothing.
#ifdef __AVX512F__
using KernelLanes = Twice<NativeLanes>;
#else
using KernelLanes = NativeLanes;
#endif

/// Eight lanes on every processor, for work on one path.
#if defined(__AVX2__) && defined(__FMA__)
using EightLanes = OneRegisterOfEight;
#else
using EightLanes = Twice<NativeLanes>;
#endif

template <class V>
auto operator<(Twice<V> x, Twice<V> y) {
  return TwiceMask{x.a < y.a, x.b < y.b};
}
template <class V>
auto operator>(Twice<V> x, Twice<V> y) {
  return TwiceMask{x.a > y.a, x.b > y.b};
}
template <class V>
auto operator<=(Twice<V> x, Twice<V> y) {
  return TwiceMask{x.a <= y.a, x.b <= y.b};
}
template <class V>
auto operator>=(Twice<V> x, Twice<V> y) {
  return TwiceMask{x.a >= y.a, x.b >= y.b};
}
template <class V>
auto equal(Twice<V> x, Twice<V> y) {
  return TwiceMask{equal(x.a, y.a), equal(x.b, y.b)};
}
template <class V>
auto less(Twice<V> x, Twice<V> y) {
  return TwiceMask{less(x.a, y.a), less(x.b, y.b)};
}
template <class M>
bool any(TwiceMask<M> m) {
  return any(m.a) || any(m.b);
}
template <class M>
std::uint32_t bits(TwiceMask<M> m) {
  return bits(m.a) | bits(m.b) << M::size;
}
template <class M, class V>
Twice<V> select(TwiceMask<M> m, Twice<V> x, Twice<V> y) {
  return {select(m.a, x.a, y.a), select(m.b, x.b, y.b)};
}
template <class V>
Twice<V> fma(Twice<V> x, Twice<V> y, Twice<V> z) {
  return {fma(x.a, y.a, z.a), fma(x.b, y.b, z.b)};
}
template <class V>
Twice<V> fnma(Twice<V> x, Twice<V> y, Twice<V> z) {
  return {fnma(x.a, y.a, z.a), fnma(x.b, y.b, z.b)};
}
template <class V>
Twice<V> min(Twice<V> x, Twice<V> y) {
  return {min(x.a, y.a), min(x.b, y.b)};
}
template <class V>
Twice<V> max(Twice<V> x, Twice<V> y) {
  return {max(x.a, y.a), max(x.b, y.b)};
}
template <class V>
Twice<V> abs(Twice<V> x) {
  return {abs(x.a), abs(x.b)};
}
template <class V>
Twice<V> reciprocal(Twice<V> x) {
  return {reciprocal(x.a), reciprocal(x.b)};
}
template <class V>
Twice<V> inverse_sqrt(Twice<V> x) {
  return {inverse_sqrt(x.a), inverse_sqrt(x.b)};
}
template <class V>
Twice<V> positive_sqrt(Twice<V> x) {
  return {positive_sqrt(x.a), positive_sqrt(x.b)};
}
template <class V>
Twice<V> sqrt(Twice<V> x) {
  return {sqrt(x.a), sqrt(x.b)};
}
template <class V>
Twice<V> reverse_bits(Twice<V> x) {
  return {reverse_bits(x.a), reverse_bits(x.b)};
}
template <class V>
auto to_float(Twice<V> x) {
  return Twice{to_float(x.a), to_float(x.b)};
}
template <class V>
auto to_int(Twice<V> x) {
  return Twice{to_int(x.a), to_int(x.b)};
}
template <class V>
auto as_int(Twice<V> x) {
  return Twice{as_int(x.a), as_int(x.b)};
}
template <class V>
auto as_uint(Twice<V> x) {
  return Twice{as_uint(x.a), as_uint(x.b)};
}
template <class V>
auto lookup(const std::int32_t* table, Twice<V> index) {
  return Twice{lookup(table, index.a), lookup(table, index.b)};
}
template <class V>
auto lookup(const float* table, Twice<V> index) {
  return Twice{lookup(table, index.a), lookup(table, index.b)};
}
template <class V>
auto lookup_small(const float* table, Twice<V> index) {
  return Twice{lookup_small(table, index.a), lookup_small(table, index.b)};
}

}  // namespace glimt
