#pragma once

#include "math/twice.h"

/// Random numbers are a pure function of (seed, pixel, sample, dimension). There is no state, so a path is the same in
/// every thread, block and lane.
namespace glimt {

/// A bijection of 32-bit words in which every input bit flips every output bit with probability near 1/2 (lowbias32 of
/// C. Wellons, "Prospecting for hash functions", 2018).
template <class U>
U mix(U x) {
  x ^= x >> 16;
  x = x * U(0x7feb352du);
  x ^= x >> 15;
  x = x * U(0x846ca68bu);
  x ^= x >> 16;
  return x;
}

/// What makes the random numbers of a path differ from all others. It has two words, because with 32 bits the paths of
/// a large image would repeat. Paths that share a sequence share a and b; `index` is the path's place in the sequence.
template <class F>
struct PathKey {
  Uint<F> a, b;
  Uint<F> index;
};

/// The key of one sample of a pixel.
template <class F>
PathKey<F> path_key(std::uint32_t seed, Uint<F> pixel, Uint<F> sample) {
  using U = Uint<F>;
  const U p = mix(pixel + U(mix(seed + 0x68bc21ebu)));
  const U s = mix(sample + U(mix(seed + 0x02e5be93u)));
  return {mix(p ^ (s * U(0x9e3779b1u))), mix(s + p * U(0x85ebca77u)), sample};
}

/// The key of the sequence from which the samples of a pixel take their numbers. Each half of the film has its own
/// sequence, so that the halves are independent: sample 2k + h is number k of half h.
template <class F>
PathKey<F> sequence_key(std::uint32_t seed, Uint<F> pixel, Uint<F> sample) {
  using U = Uint<F>;
  const PathKey<F> half = path_key<F>(seed + 0x3c6ef372u, pixel, U(sample & U(1u)));
  return {half.a, half.b, U(sample >> 1)};
}

/// What a random number is used for. Camera dimensions come first. Then each surface hit has its own block, where the
/// shadow rays take the last places, three each.
enum class Dimension : std::uint32_t { pixel_x, pixel_y, camera_count };
enum class HitDimension : std::uint32_t { direction_u, direction_v, roulette, lamp, lamp_u, lamp_v };
inline constexpr std::uint32_t shadow_dimensions = 3;  ///< which lamp, u and v on it

/// Number of dimensions in the block of a hit.
constexpr std::uint32_t hit_dimensions(int shadow_rays) {
  return static_cast<std::uint32_t>(HitDimension::lamp) + shadow_dimensions * static_cast<std::uint32_t>(shadow_rays);
}

inline constexpr std::uint32_t dimension_stride = 0x9e3779b9u;  ///< odd, near 2^32 / golden ratio

/// The key whose dimension 0 is dimension `count` of this key. So the dimensions of a hit are constants.
template <class F>
PathKey<F> skip_dimensions(const PathKey<F>& key, std::uint32_t count) {
  return {key.a + Uint<F>(count * dimension_stride), key.b, key.index};
}

/// A number in [0, 1), a multiple of 2^-24.
template <class F>
F unit_float(Uint<F> x) {
  return to_float(as_int(x >> 8)) * F(0x1p-24f);
}

/// 32 random bits of a dimension.
template <class F>
Uint<F> random_bits(const PathKey<F>& key, std::uint32_t dimension) {
  using U = Uint<F>;
  U x = key.a + U(dimension * dimension_stride);
  x ^= x >> 16;
  x = x * U(0x7feb352du);
  x ^= key.b;
  x ^= x >> 15;
  x = x * U(0x846ca68bu);
  x ^= x >> 16;
  return x;
}

/// A uniform number in [0, 1), independent of all others.
template <class F>
F uniform(const PathKey<F>& key, std::uint32_t dimension) {
  return unit_float<F>(random_bits<F>(key, dimension));
}

/// A point of the unit square.
template <class F>
struct Point2 {
  F u, v;
};

/// Owen's nested scrambling of the bits of x, lowest first: whether a bit flips depends on the bits below (Laine and
/// Karras 2011; constants of N. Vegdahl as in Burley, "Practical hash-based Owen scrambling", JCGT 9(4), 2020).
template <class U>
U scramble_from_lowest(U x, U seed) {
  x ^= x * U(0x3d20adeau);
  x = x + seed;
  x = x * ((seed >> 16) | U(1u));
  x ^= x * U(0x05526c56u);
  x ^= x * U(0x53a22864u);
  return x;
}

/// The first two dimensions of Sobol's sequence at `index`, Owen-scrambled. The seed also shuffles the order of points
/// in every aligned block of 2^k, so that pairs with different seeds can be used together (Burley 2020).
template <class F>
Point2<F> sobol_pair(Uint<F> index, Uint<F> seed) {
  using U = Uint<F>;
  const U shuffled = reverse_bits(scramble_from_lowest(reverse_bits(index), seed));
  // Sobol's second generator matrix is Pascal's triangle modulo 2, the fifth Kronecker power of (1 1; 0 1). Here the
  // highest digit is in bit 0.
  U second = shuffled;
  second ^= (second >> 1) & U(0x55555555u);
  second ^= (second >> 2) & U(0x33333333u);
  second ^= (second >> 4) & U(0x0f0f0f0fu);
  second ^= (second >> 8) & U(0x00ff00ffu);
  second ^= second >> 16;
  return {unit_float<F>(reverse_bits(scramble_from_lowest(shuffled, U(seed * U(0x9e3779b1u) + U(0x7f4a7c15u))))),
          unit_float<F>(reverse_bits(scramble_from_lowest(second, U(seed * U(0x85ebca77u) + U(0x165667b1u)))))};
}

/// A pair in one of 4x4 squares. Every 16 samples use each square once, in a random order.
template <class F>
Point2<F> stratified_pair(Uint<F> index, Uint<F> seed) {
  using U = Uint<F>;
  const U order = mix(U(seed + (index >> 4) * U(0x9e3779b1u)));
  // A bijection of 0..15 chosen by the bits of `order`. Bits above bit 3 do not matter.
  U x = index ^ order;
  x = x * ((order >> 3) | U(1u));
  x = (x ^ ((x >> 2) & U(3u))) + (order >> 7);
  x = x * ((order >> 10) | U(1u));
  x ^= order >> 16;
  x = (x ^ ((x >> 2) & U(3u))) * ((order >> 19) | U(1u)) + (order >> 23);
  const F column = to_float(as_int(U(x & U(3u)))), row = to_float(as_int(U((x >> 2) & U(3u))));
  const U jitter = mix(U(seed ^ (index * U(0x85ebca77u))));
  const F u = to_float(as_int(U(jitter >> 16))) * F(0x1p-16f),
          v = to_float(as_int(U(jitter & U(0xffffu)))) * F(0x1p-16f);
  return {(column + u) * F(0.25f), (row + v) * F(0.25f)};
}

}  // namespace glimt
