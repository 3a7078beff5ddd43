#pragma once

#include "kernel/transport/random.h"

namespace glimt {

/// The random numbers of one hit of a path.
template <class F>
struct HitNumbers {
  Sampler sampler;
  const PathKey<F>& key;  ///< its dimension 0 is the first of the hit
  LatticePlace<F> place;

  /// Of several pairs or numbers, number `k` of `count`.
  Point2<F> pair(HitDimension dimension, int count = 1, int k = 0) const {
    return random_pair<F>(sampler, key, place, static_cast<std::uint32_t>(dimension), count, k);
  }
  F number(HitDimension dimension, int count = 1, int k = 0) const {
    return random_number<F>(sampler, key, place, static_cast<std::uint32_t>(dimension), count, k);
  }
  /// Which of several ways to scatter. Independent of all others, so that it takes no dimension from a sequence.
  F lobe() const {
    using U = Uint<F>;
    return uniform<F>(PathKey<F>{key.a + key.index * U(0x85ebca77u), key.b ^ U(0x5bd1e995u), key.index}, 0);
  }
};

}  // namespace glimt
