#pragma once

#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <xsimd/xsimd.hpp>

/// Lanes: the kernel is written once for a type F, either float or a SIMD batch of floats with one path per lane. This
/// is the only file that names xsimd. The functions below mean the same for every F, and a lane computes the same value
/// at every width. All are exact (IEEE) or bit-wise, except quotients and roots with AVX-512, where exact ones are
/// slow. A mask of a batch never converts to bool: use any() or bits().
namespace glimt {

template <class F>
struct LaneTypes;

template <>
struct LaneTypes<float> {
  using Int = std::int32_t;
  using Uint = std::uint32_t;
  using Mask = bool;
  static constexpr int width = 1;
};

template <class A>
struct LaneTypes<xsimd::batch<float, A>> {
  using Int = xsimd::batch<std::int32_t, A>;
  using Uint = xsimd::batch<std::uint32_t, A>;
  using Mask = xsimd::batch_bool<float, A>;
  static constexpr int width = static_cast<int>(xsimd::batch<float, A>::size);
};

template <class F>
using Int = typename LaneTypes<F>::Int;
template <class F>
using Uint = typename LaneTypes<F>::Uint;
template <class F>
using Mask = typename LaneTypes<F>::Mask;
template <class F>
inline constexpr int lane_count = LaneTypes<F>::width;

using NativeLanes = xsimd::batch<float>;
#if defined(__AVX2__) && defined(__FMA__)
using OneRegisterOfEight = xsimd::batch<float, xsimd::fma3<xsimd::avx2>>;
#endif

// One lane.

inline bool any(bool m) { return m; }
inline std::uint32_t bits(bool m) { return m ? 1u : 0u; }
inline float select(bool m, float a, float b) { return m ? a : b; }
inline std::int32_t select(bool m, std::int32_t a, std::int32_t b) { return m ? a : b; }
inline std::uint32_t select(bool m, std::uint32_t a, std::uint32_t b) { return m ? a : b; }
inline float fma(float a, float b, float c) { return std::fma(a, b, c); }
inline float fnma(float a, float b, float c) { return std::fma(-a, b, c); }
inline float abs(float a) { return std::abs(a); }
inline float min(float a, float b) { return a < b ? a : b; }
inline float max(float a, float b) { return a > b ? a : b; }
inline bool equal(std::int32_t a, std::int32_t b) { return a == b; }
inline bool less(std::int32_t a, std::int32_t b) { return a < b; }
inline float to_float(std::int32_t a) { return static_cast<float>(a); }
inline std::int32_t to_int(float a) { return static_cast<std::int32_t>(a); }
inline std::int32_t as_int(float a) { return std::bit_cast<std::int32_t>(a); }
inline std::int32_t as_int(std::uint32_t a) { return static_cast<std::int32_t>(a); }
inline std::uint32_t as_uint(std::int32_t a) { return static_cast<std::uint32_t>(a); }
/// Bit 0 becomes bit 31.
inline std::uint32_t reverse_bits(std::uint32_t a) {
  a = (a >> 1 & 0x55555555u) | (a & 0x55555555u) << 1;
  a = (a >> 2 & 0x33333333u) | (a & 0x33333333u) << 2;
  a = (a >> 4 & 0x0f0f0f0fu) | (a & 0x0f0f0f0fu) << 4;
  return __builtin_bswap32(a);
}

// Quotients and roots, within 1 ulp. With AVX-512 they take one Newton step from the processor's 14-bit estimates,
// which are the same in one lane and in many. Elsewhere they are exact.

/// 1 / a, also of zeros and infinities.
inline float reciprocal(float a) {
#ifdef __AVX512DQ__
  const __m128 v = _mm_set_ss(a);
  const float estimate = _mm_cvtss_f32(_mm_rcp14_ss(v, v));
  if (estimate == 0 || std::isinf(estimate)) return estimate;
  return fma(fma(-a, estimate, 1), estimate, estimate);
#else
  return 1 / a;
#endif
}

/// 1 / sqrt(a) of a positive, finite number.
inline float inverse_sqrt(float a) {
#ifdef __AVX512DQ__
  const __m128 v = _mm_set_ss(a);
  const float estimate = _mm_cvtss_f32(_mm_rsqrt14_ss(v, v));
  return fma(fma(-a * estimate, estimate, 1), 0.5f * estimate, estimate);
#else
  return 1 / std::sqrt(a);
#endif
}

/// Square root of a positive, finite number. A negative number gives NaN, 0 gives NaN or 0.
inline float positive_sqrt(float a) {
#ifdef __AVX512DQ__
  const __m128 v = _mm_set_ss(a);
  const float estimate = _mm_cvtss_f32(_mm_rsqrt14_ss(v, v));
  const float root = a * estimate;
  return fma(fma(-root, root, a), 0.5f * estimate, root);
#else
  return std::sqrt(a);
#endif
}

/// Square root of a finite number >= 0.
inline float sqrt(float a) { return a > 0 ? positive_sqrt(a) : 0; }

// Many lanes.

template <class A>
bool any(xsimd::batch_bool<float, A> m) {
  return xsimd::any(m);
}

/// Bit i is lane i.
template <class A>
std::uint32_t bits(xsimd::batch_bool<float, A> m) {
  using Register = typename xsimd::batch_bool<float, A>::register_type;
  if constexpr (std::is_integral_v<Register>) {
    return static_cast<std::uint32_t>(m.data);
#ifdef __AVX__
  } else if constexpr (std::is_same_v<Register, __m256>) {
    return static_cast<std::uint32_t>(_mm256_movemask_ps(m.data));
#endif
  } else {
    std::array<bool, xsimd::batch_bool<float, A>::size> lane;
    m.store_unaligned(lane.data());
    std::uint32_t result = 0;
    for (std::size_t i = 0; i < lane.size(); ++i) result |= std::uint32_t{lane[i]} << i;
    return result;
  }
}

/// The same lanes as a mask over another element type of the same size.
template <class To, class From, class A>
xsimd::batch_bool<To, A> mask_cast(xsimd::batch_bool<From, A> m) {
  return std::bit_cast<typename xsimd::batch_bool<To, A>::register_type>(m.data);
}

template <class A>
xsimd::batch<float, A> select(xsimd::batch_bool<float, A> m, xsimd::batch<float, A> a, xsimd::batch<float, A> b) {
  return xsimd::select(m, a, b);
}
template <class A>
xsimd::batch<std::int32_t, A> select(xsimd::batch_bool<float, A> m, xsimd::batch<std::int32_t, A> a,
                                     xsimd::batch<std::int32_t, A> b) {
  return xsimd::select(mask_cast<std::int32_t>(m), a, b);
}
template <class A>
xsimd::batch<std::uint32_t, A> select(xsimd::batch_bool<float, A> m, xsimd::batch<std::uint32_t, A> a,
                                      xsimd::batch<std::uint32_t, A> b) {
  return xsimd::select(mask_cast<std::uint32_t>(m), a, b);
}

template <class A>
xsimd::batch<float, A> fma(xsimd::batch<float, A> a, xsimd::batch<float, A> b, xsimd::batch<float, A> c) {
#ifdef __AVX512F__
  // xsimd 8.1 has no fused product for these registers.
  if constexpr (std::is_same_v<typename xsimd::batch<float, A>::register_type, __m512>)
    return xsimd::batch<float, A>(_mm512_fmadd_ps(a.data, b.data, c.data));
#endif
  return xsimd::fma(a, b, c);
}
/// c - a b
template <class A>
xsimd::batch<float, A> fnma(xsimd::batch<float, A> a, xsimd::batch<float, A> b, xsimd::batch<float, A> c) {
#ifdef __AVX512F__
  if constexpr (std::is_same_v<typename xsimd::batch<float, A>::register_type, __m512>)
    return xsimd::batch<float, A>(_mm512_fnmadd_ps(a.data, b.data, c.data));
#endif
  return xsimd::fnma(a, b, c);
}
template <class A>
xsimd::batch<float, A> reciprocal(xsimd::batch<float, A> a) {
#ifdef __AVX512DQ__
  if constexpr (std::is_same_v<typename xsimd::batch<float, A>::register_type, __m512>) {
    const __m512 estimate = _mm512_rcp14_ps(a.data);
    const __m512 error = _mm512_fnmadd_ps(a.data, estimate, _mm512_set1_ps(1.0f));
    // NaN or -inf where the estimate is 0 or infinite
    const __mmask16 finite =
        _mm512_cmp_ps_mask(error, _mm512_set1_ps(-std::numeric_limits<float>::infinity()), _CMP_GT_OQ);
    return xsimd::batch<float, A>(_mm512_mask_fmadd_ps(estimate, finite, error, estimate));
  }
#endif
  return xsimd::batch<float, A>(1.0f) / a;
}
template <class A>
xsimd::batch<float, A> inverse_sqrt(xsimd::batch<float, A> a) {
#ifdef __AVX512DQ__
  if constexpr (std::is_same_v<typename xsimd::batch<float, A>::register_type, __m512>) {
    const __m512 estimate = _mm512_rsqrt14_ps(a.data);
    const __m512 error = _mm512_fnmadd_ps(_mm512_mul_ps(a.data, estimate), estimate, _mm512_set1_ps(1.0f));
    return xsimd::batch<float, A>(_mm512_fmadd_ps(error, _mm512_mul_ps(_mm512_set1_ps(0.5f), estimate), estimate));
  }
#endif
  return xsimd::batch<float, A>(1.0f) / xsimd::sqrt(a);
}
template <class A>
xsimd::batch<float, A> positive_sqrt(xsimd::batch<float, A> a) {
#ifdef __AVX512DQ__
  if constexpr (std::is_same_v<typename xsimd::batch<float, A>::register_type, __m512>) {
    const __m512 estimate = _mm512_rsqrt14_ps(a.data);
    const __m512 root = _mm512_mul_ps(a.data, estimate);
    const __m512 error = _mm512_fnmadd_ps(root, root, a.data);
    return xsimd::batch<float, A>(_mm512_fmadd_ps(error, _mm512_mul_ps(_mm512_set1_ps(0.5f), estimate), root));
  }
#endif
  return xsimd::sqrt(a);
}
template <class A>
xsimd::batch<float, A> sqrt(xsimd::batch<float, A> a) {
  using F = xsimd::batch<float, A>;
  return select(a > F(0.0f), positive_sqrt(a), F(0.0f));
}
template <class A>
xsimd::batch<float, A> abs(xsimd::batch<float, A> a) {
  return xsimd::abs(a);
}
template <class A>
xsimd::batch<float, A> min(xsimd::batch<float, A> a, xsimd::batch<float, A> b) {
  return xsimd::min(a, b);
}
template <class A>
xsimd::batch<float, A> max(xsimd::batch<float, A> a, xsimd::batch<float, A> b) {
  return xsimd::max(a, b);
}
template <class A>
xsimd::batch_bool<float, A> equal(xsimd::batch<std::int32_t, A> a, xsimd::batch<std::int32_t, A> b) {
  return mask_cast<float>(a == b);
}
template <class A>
xsimd::batch_bool<float, A> less(xsimd::batch<std::int32_t, A> a, xsimd::batch<std::int32_t, A> b) {
  return mask_cast<float>(a < b);
}
template <class A>
xsimd::batch<float, A> to_float(xsimd::batch<std::int32_t, A> a) {
  return xsimd::to_float(a);
}
/// Towards zero.
template <class A>
xsimd::batch<std::int32_t, A> to_int(xsimd::batch<float, A> a) {
  return xsimd::to_int(a);
}
/// The same bits.
template <class A>
xsimd::batch<std::int32_t, A> as_int(xsimd::batch<float, A> a) {
  return xsimd::bitwise_cast<xsimd::batch<std::int32_t, A>>(a);
}
template <class A>
xsimd::batch<std::int32_t, A> as_int(xsimd::batch<std::uint32_t, A> a) {
  return xsimd::bitwise_cast<xsimd::batch<std::int32_t, A>>(a);
}

template <class A>
xsimd::batch<std::uint32_t, A> as_uint(xsimd::batch<std::int32_t, A> a) {
  return xsimd::bitwise_cast<xsimd::batch<std::uint32_t, A>>(a);
}

template <class A>
xsimd::batch<std::uint32_t, A> reverse_bits(xsimd::batch<std::uint32_t, A> a) {
  using U = xsimd::batch<std::uint32_t, A>;
#if defined(__AVX512BW__) && defined(__GFNI__)
  if constexpr (std::is_same_v<typename U::register_type, __m512i>) {
    // Reverses the bits of every byte, then the bytes of every word.
    const __m512i bytes = _mm512_gf2p8affine_epi64_epi8(a.data, _mm512_set1_epi64(0x8040201008040201), 0);
    const __m512i order = _mm512_set_epi8(12, 13, 14, 15, 8, 9, 10, 11, 4, 5, 6, 7, 0, 1, 2, 3,  //
                                          12, 13, 14, 15, 8, 9, 10, 11, 4, 5, 6, 7, 0, 1, 2, 3,  //
                                          12, 13, 14, 15, 8, 9, 10, 11, 4, 5, 6, 7, 0, 1, 2, 3,  //
                                          12, 13, 14, 15, 8, 9, 10, 11, 4, 5, 6, 7, 0, 1, 2, 3);
    return U(_mm512_shuffle_epi8(bytes, order));
  }
#endif
  a = ((a >> 1) & U(0x55555555u)) | ((a & U(0x55555555u)) << 1);
  a = ((a >> 2) & U(0x33333333u)) | ((a & U(0x33333333u)) << 2);
  a = ((a >> 4) & U(0x0f0f0f0fu)) | ((a & U(0x0f0f0f0fu)) << 4);
  a = ((a >> 8) & U(0x00ff00ffu)) | ((a & U(0x00ff00ffu)) << 8);
  return (a >> 16) | (a << 16);
}

/// A mask with no lane, and one with all lanes.
template <class F>
Mask<F> no_lanes() {
  return F(1.0f) < F(0.0f);
}
template <class F>
Mask<F> all_lanes() {
  return F(0.0f) < F(1.0f);
}

/// Loads consecutive elements, one per lane; `V` is a lane type of float, int32 or uint32.
template <class V, class T>
V load(const T* from) {
  if constexpr (std::is_arithmetic_v<V>) {
    return *from;
  } else {
    return V::load_unaligned(from);
  }
}

template <class V, class T>
void store(V value, T* to) {
  if constexpr (std::is_arithmetic_v<V>) {
    *to = value;
  } else {
    value.store_unaligned(to);
  }
}

/// 0, 1, 2, ...
template <class F>
Int<F> lane_numbers() {
  static constexpr auto numbers = [] {
    std::array<std::int32_t, lane_count<F>> n{};
    for (std::size_t i = 0; i < n.size(); ++i) n[i] = static_cast<std::int32_t>(i);
    return n;
  }();
  return load<Int<F>>(numbers.data());
}

/// table[index] in every lane.
inline float lookup(const float* table, std::int32_t index) { return table[index]; }
inline std::int32_t lookup(const std::int32_t* table, std::int32_t index) { return table[index]; }

template <class A>
xsimd::batch<float, A> lookup(const float* table, xsimd::batch<std::int32_t, A> index) {
  return xsimd::batch<float, A>::gather(table, index);
}
template <class A>
xsimd::batch<std::int32_t, A> lookup(const std::int32_t* table, xsimd::batch<std::int32_t, A> index) {
  return xsimd::batch<std::int32_t, A>::gather(table, index);
}

/// Tables with at most this many entries are looked up by permuting registers, which is faster than a gather.
inline constexpr int small_table = 16;

/// The same for 0 <= index < small_table. The table is 64-byte aligned and has small_table entries.
inline float lookup_small(const float* table, std::int32_t index) { return table[index]; }

template <class A>
xsimd::batch<float, A> lookup_small(const float* table, xsimd::batch<std::int32_t, A> index) {
  using F = xsimd::batch<float, A>;
  using Register [[maybe_unused]] = typename F::register_type;
#ifdef __AVX512F__
  if constexpr (std::is_same_v<Register, __m512>) return F(_mm512_permutexvar_ps(index.data, _mm512_load_ps(table)));
#endif
#ifdef __AVX2__
  if constexpr (std::is_same_v<Register, __m256>) {
    const __m256 low = _mm256_permutevar8x32_ps(_mm256_load_ps(table), index.data);
    const __m256 high = _mm256_permutevar8x32_ps(_mm256_load_ps(table + 8), index.data);
    // Bit 3 of the index chooses the register. blendv reads the sign bit.
    return F(_mm256_blendv_ps(low, high, _mm256_castsi256_ps(_mm256_slli_epi32(index.data, 28))));
  }
#endif
  return lookup(table, index);
}

namespace detail {

/// For each 8-bit mask, the numbers of its lanes in order.
inline constexpr auto lane_order = [] {
  std::array<std::array<std::uint8_t, 8>, 256> order{};
  for (unsigned mask = 0; mask < 256; ++mask)
    for (unsigned lane = 0, place = 0; lane < 8; ++lane)
      if (mask >> lane & 1) order[mask][place++] = static_cast<std::uint8_t>(lane);
  return order;
}();

/// For each 8-bit mask and lane, the number of lower lanes in the mask.
inline constexpr auto lane_rank = [] {
  std::array<std::array<std::uint8_t, 8>, 256> rank{};
  for (unsigned mask = 0; mask < 256; ++mask)
    for (unsigned lane = 0; lane < 8; ++lane)
      rank[mask][lane] = static_cast<std::uint8_t>(std::popcount(mask & ((1u << lane) - 1)));
  return rank;
}();

}  // namespace detail

/// Lanes in the mask take the elements of `from` one after the other, in lane order. The others keep their value.
/// `from` must have one readable element for every lane.
template <class V, class F, class T>
V expand(V old, Mask<F> mask, const T* from) {
  static_assert(sizeof(T) == 4);
  if constexpr (std::is_arithmetic_v<V>) {
    return mask ? *from : old;
  } else if constexpr (requires { V::expand(old, mask, from); }) {
    return V::expand(old, mask, from);
  } else {
    using Register [[maybe_unused]] = typename F::register_type;
#ifdef __AVX512F__
    if constexpr (std::is_same_v<Register, __m512>) {
      return V(std::bit_cast<typename V::register_type>(_mm512_mask_expand_ps(
          std::bit_cast<__m512>(old.data), mask.data, _mm512_loadu_ps(reinterpret_cast<const float*>(from)))));
    }
#endif
#ifdef __AVX2__
    if constexpr (std::is_same_v<Register, __m256>) {
      const auto& rank = detail::lane_rank[bits(mask)];
      const __m256i index = _mm256_cvtepu8_epi32(_mm_loadl_epi64(reinterpret_cast<const __m128i*>(rank.data())));
      const __m256 taken = _mm256_permutevar8x32_ps(_mm256_loadu_ps(reinterpret_cast<const float*>(from)), index);
      return V(std::bit_cast<typename V::register_type>(
          _mm256_blendv_ps(std::bit_cast<__m256>(old.data), taken, mask.data)));
    }
#endif
    std::array<T, F::size> lane;
    old.store_unaligned(lane.data());
    for (std::uint32_t m = bits(mask); m != 0; m &= m - 1)
      lane[static_cast<std::size_t>(std::countr_zero(m))] = *from++;
    return V::load_unaligned(lane.data());
  }
}

/// Writes the lanes in the mask to `to` one after the other, in lane order. It may overwrite one element for every
/// lane.
template <class V, class F, class T>
void compress(V value, Mask<F> mask, T* to) {
  static_assert(sizeof(T) == 4);
  if constexpr (std::is_arithmetic_v<V>) {
    if (mask) *to = value;
  } else if constexpr (requires { value.compress(mask, to); }) {
    value.compress(mask, to);
  } else {
    using Register [[maybe_unused]] = typename F::register_type;
#ifdef __AVX512F__
    if constexpr (std::is_same_v<Register, __m512>) {
      // Compresses in a register, because some processors are slow at compressing to memory.
      _mm512_storeu_ps(to, _mm512_maskz_compress_ps(mask.data, std::bit_cast<__m512>(value.data)));
      return;
    }
#endif
#ifdef __AVX2__
    if constexpr (std::is_same_v<Register, __m256>) {
      const auto& order = detail::lane_order[bits(mask)];
      const __m256i index = _mm256_cvtepu8_epi32(_mm_loadl_epi64(reinterpret_cast<const __m128i*>(order.data())));
      _mm256_storeu_ps(reinterpret_cast<float*>(to),
                       _mm256_permutevar8x32_ps(std::bit_cast<__m256>(value.data), index));
      return;
    }
#endif
    std::array<T, F::size> lane;
    value.store_unaligned(lane.data());
    for (std::uint32_t m = bits(mask); m != 0; m &= m - 1) *to++ = lane[static_cast<std::size_t>(std::countr_zero(m))];
  }
}

}  // namespace glimt
