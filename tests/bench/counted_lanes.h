#pragma once

#include <array>
#include <cstdint>

#include "kernel/transport/path.h"

/// Lanes that count the operations on them. The kernel for Counted<V> computes the same as for V, bit for bit, so the
/// counts are those of the real kernel. V = float counts what the paths need, V = NativeLanes what is executed. Masks
/// are not counted. Only one thread may count at a time.
namespace glimt {

enum class Operation {
  add,
  multiply,
  fma,
  quotient,  ///< a reciprocal, by whatever instructions
  root,      ///< a square root or its reciprocal
  min_max,   ///< also absolute values
  compare,
  select,   ///< also the refilling of free lanes
  convert,  ///< between integers and floats
  lookup,   ///< in a table, and loads and stores
  integer,  ///< sums, products, shifts, bits
  count
};

inline constexpr auto operation_kinds = static_cast<std::size_t>(Operation::count);
inline constexpr std::array<const char*, operation_kinds> operation_names{
    "add", "multiply", "fma", "quotient", "root", "min_max", "compare", "select", "convert", "lookup", "integer"};
inline std::array<std::uint64_t, operation_kinds> operation_counts{};

/// `V`: float, int32, uint32 or a batch of them.
template <class V>
struct Counted {
  V v;

  Counted() = default;
  template <class T>
  requires(std::is_arithmetic_v<T> || std::is_enum_v<T>) Counted(T value)
      : v(static_cast<T>(value)) {}  // NOLINT: as implicit as that of the lanes it stands for

  struct register_type {};  ///< none that lanes.h has instructions for
  static constexpr std::size_t size = [] {
    if constexpr (std::is_arithmetic_v<V>) {
      return 1;
    } else {
      return V::size;
    }
  }();

  static Counted load_unaligned(const auto* from) { return counted(Operation::lookup, load<V>(from)); }
  void store_unaligned(auto* to) const {
    ++operation_counts[static_cast<std::size_t>(Operation::lookup)];
    store(v, to);
  }
};

template <class V>
Counted<V> counted(Operation operation, V value) {
  ++operation_counts[static_cast<std::size_t>(operation)];
  Counted<V> result;
  result.v = value;
  return result;
}
template <class M>
M counted_mask(Operation operation, M mask) {
  ++operation_counts[static_cast<std::size_t>(operation)];
  return mask;
}

template <class V>
struct LaneTypes<Counted<V>> {
  using Int = Counted<typename LaneTypes<V>::Int>;
  using Uint = Counted<typename LaneTypes<V>::Uint>;
  using Mask = typename LaneTypes<V>::Mask;
  static constexpr int width = LaneTypes<V>::width;
};

namespace detail {

template <class V>
struct IsFloat : std::is_same<V, float> {};
template <class A>
struct IsFloat<xsimd::batch<float, A>> : std::true_type {};

/// The operation `o` if V is floating-point, else an integer operation.
template <class V>
constexpr Operation arithmetic(Operation o) {
  return IsFloat<V>::value ? o : Operation::integer;
}

}  // namespace detail

template <class V>
Counted<V> operator+(Counted<V> a, Counted<V> b) {
  return counted<V>(detail::arithmetic<V>(Operation::add), a.v + b.v);
}
template <class V>
Counted<V> operator-(Counted<V> a, Counted<V> b) {
  return counted<V>(detail::arithmetic<V>(Operation::add), a.v - b.v);
}
template <class V>
Counted<V> operator*(Counted<V> a, Counted<V> b) {
  return counted<V>(detail::arithmetic<V>(Operation::multiply), a.v * b.v);
}
template <class V>
Counted<V> operator^(Counted<V> a, Counted<V> b) {
  return counted<V>(Operation::integer, a.v ^ b.v);
}
template <class V>
Counted<V> operator&(Counted<V> a, Counted<V> b) {
  return counted<V>(Operation::integer, a.v & b.v);
}
template <class V>
Counted<V> operator|(Counted<V> a, Counted<V> b) {
  return counted<V>(Operation::integer, a.v | b.v);
}
template <class V>
Counted<V>& operator^=(Counted<V>& a, Counted<V> b) {
  return a = a ^ b;
}
template <class V>
Counted<V> reverse_bits(Counted<V> a) {
  return counted<V>(Operation::integer, reverse_bits(a.v));
}
template <class V>
Counted<V> operator<<(Counted<V> a, int bits) {
  return counted<V>(Operation::integer, a.v << bits);
}
template <class V>
Counted<V> operator>>(Counted<V> a, int bits) {
  return counted<V>(Operation::integer, a.v >> bits);
}
template <class V>
auto operator<(Counted<V> a, Counted<V> b) {
  return counted_mask(Operation::compare, a.v < b.v);
}
template <class V>
auto operator>(Counted<V> a, Counted<V> b) {
  return counted_mask(Operation::compare, a.v > b.v);
}
template <class V>
auto operator<=(Counted<V> a, Counted<V> b) {
  return counted_mask(Operation::compare, a.v <= b.v);
}
template <class V>
auto operator>=(Counted<V> a, Counted<V> b) {
  return counted_mask(Operation::compare, a.v >= b.v);
}
template <class V>
auto equal(Counted<V> a, Counted<V> b) {
  return counted_mask(Operation::compare, equal(a.v, b.v));
}
template <class V>
auto less(Counted<V> a, Counted<V> b) {
  return counted_mask(Operation::compare, less(a.v, b.v));
}
template <class M, class V>
Counted<V> select(const M& mask, Counted<V> a, Counted<V> b) {
  return counted<V>(Operation::select, select(mask, a.v, b.v));
}
template <class V>
Counted<V> fma(Counted<V> a, Counted<V> b, Counted<V> c) {
  return counted<V>(Operation::fma, fma(a.v, b.v, c.v));
}
template <class V>
Counted<V> fnma(Counted<V> a, Counted<V> b, Counted<V> c) {
  return counted<V>(Operation::fma, fnma(a.v, b.v, c.v));
}
template <class V>
Counted<V> reciprocal(Counted<V> a) {
  return counted<V>(Operation::quotient, reciprocal(a.v));
}
template <class V>
Counted<V> inverse_sqrt(Counted<V> a) {
  return counted<V>(Operation::root, inverse_sqrt(a.v));
}
template <class V>
Counted<V> positive_sqrt(Counted<V> a) {
  return counted<V>(Operation::root, positive_sqrt(a.v));
}
template <class V>
Counted<V> sqrt(Counted<V> a) {
  return counted<V>(Operation::root, sqrt(a.v));
}
template <class V>
Counted<V> abs(Counted<V> a) {
  return counted<V>(Operation::min_max, abs(a.v));
}
template <class V>
Counted<V> min(Counted<V> a, Counted<V> b) {
  return counted<V>(Operation::min_max, min(a.v, b.v));
}
template <class V>
Counted<V> max(Counted<V> a, Counted<V> b) {
  return counted<V>(Operation::min_max, max(a.v, b.v));
}
template <class V>
auto to_float(Counted<V> a) {
  return counted(Operation::convert, to_float(a.v));
}
template <class V>
auto to_int(Counted<V> a) {
  return counted(Operation::convert, to_int(a.v));
}
template <class V>
auto lookup(const float* table, Counted<V> index) {
  return counted(Operation::lookup, lookup(table, index.v));
}
template <class V>
auto lookup(const std::int32_t* table, Counted<V> index) {
  return counted(Operation::lookup, lookup(table, index.v));
}
template <class V>
auto lookup_small(const float* table, Counted<V> index) {
  return counted(Operation::lookup, lookup_small(table, index.v));
}
/// The same bits read as another type, which costs nothing.
template <class V>
auto as_int(Counted<V> a) {
  Counted<decltype(as_int(a.v))> result;
  result.v = as_int(a.v);
  return result;
}
template <class V>
auto as_uint(Counted<V> a) {
  Counted<decltype(as_uint(a.v))> result;
  result.v = as_uint(a.v);
  return result;
}

}  // namespace glimt
