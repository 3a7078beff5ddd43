#pragma once

#include "math/lanes.h"

/// Random numbers as a pure function of (seed, pixel, sample, dimension): no state, so a path is the same in every
/// thread, block and lane.
namespace glimt {

/// A bijection of 32-bit words in which every input bit flips every output bit with probability near 1/2 (constants:
/// C. Wellons, "Prospecting for hash functions", 2018, the variant called lowbias32).
template <class U>
U mix(U x) {
  x ^= x >> 16;
  x = x * U(0x7feb352du);
  x ^= x >> 15;
  x = x * U(0x846ca68bu);
  x ^= x >> 16;
  return x;
}

/// The 64 bits that tell one path from all others. Two words, because 32 bits would make paths of a large image repeat.
template <class F>
struct PathKey {
  Uint<F> a, b;
};

template <class F>
PathKey<F> path_key(std::uint32_t seed, Uint<F> pixel, Uint<F> sample) {
  using U = Uint<F>;
  const U p = mix(pixel + U(mix(seed + 0x68bc21ebu)));
  const U s = mix(sample + U(mix(seed + 0x02e5be93u)));
  return {mix(p ^ (s * U(0x9e3779b1u))), mix(s + p * U(0x85ebca77u))};
}

/// What a random number is for. Camera dimensions come first; each surface hit then has a block of its own, in which
/// the shadow rays take the last places, three each.
enum class Dimension : std::uint32_t { pixel_x, pixel_y, camera_count };
enum class HitDimension : std::uint32_t { direction_u, direction_v, roulette, shadow };
inline constexpr std::uint32_t shadow_dimensions = 3;  ///< which lamp, u and v on it

/// Number of dimensions in the block of a hit.
inline std::uint32_t hit_dimensions(int shadow_rays) {
  return static_cast<std::uint32_t>(HitDimension::shadow) + shadow_dimensions * static_cast<std::uint32_t>(shadow_rays);
}

inline constexpr std::uint32_t dimension_stride = 0x9e3779b9u;  ///< odd, near 2^32 / golden ratio

/// The key whose dimension 0 is dimension `count` of this one, so that the dimensions of a hit are constants.
template <class F>
PathKey<F> skip_dimensions(const PathKey<F>& key, std::uint32_t count) {
  return {key.a + Uint<F>(count * dimension_stride), key.b};
}

/// A uniform number in [0, 1), a multiple of 2^-24.
template <class F>
F uniform(const PathKey<F>& key, std::uint32_t dimension) {
  using U = Uint<F>;
  U x = key.a + U(dimension * dimension_stride);
  x ^= x >> 16;
  x = x * U(0x7feb352du);
  x ^= key.b;
  x ^= x >> 15;
  x = x * U(0x846ca68bu);
  x ^= x >> 16;
  return to_float(as_int(x >> 8)) * F(0x1p-24f);
}

}  // namespace glimt
