#pragma once

#include <array>
#include <bit>
#include <cstdint>
#include <span>

#include "kernel/entry/kernels.h"
#include "kernel/scattering/surfaces.h"

/// Counts how often paths find, by chance, light that is left to chance alone; film/unseen.h says what follows.
namespace glimt {

template <class F>
class ChanceHits {
 public:
  /// Adds to counters as trace() has them; none: nothing is counted.
  explicit ChanceHits(std::span<std::uint64_t> counters) : counters_(counters) {}

  bool on() const { return !counters_.empty(); }

  /// Paths that went this way have met the emitter in that row, where it is not below 0.
  void meet(const Int<F>& emitter, const Int<F>& way, F throughput, Mask<F> mask) {
    mask = mask & less(Int<F>(-1), emitter);
    if (!any(mask)) return;
    static_assert(chance_ways == 4);
    const Int<F> twice = emitter + emitter;
    std::array<std::int32_t, lane_count<F>> counter;
    std::array<float, lane_count<F>> share;
    compress<Int<F>, F>(twice + twice + way, mask, counter.data());
    compress<F, F>(min(throughput, F(1.0f)), mask, share.data());
    const auto found = static_cast<std::size_t>(std::popcount(bits(mask)));
    for (std::size_t i = 0; i < found; ++i)
      counters_[static_cast<std::size_t>(counter[i])] += static_cast<std::uint64_t>(share[i] * chance_unit);
  }

  /// Camera paths have met a smooth mirror or glass first.
  void begin_mirrored(const Mask<F>& mask) {
    counters_.back() += static_cast<std::uint64_t>(std::popcount(bits(mask)));
  }

 private:
  std::span<std::uint64_t> counters_;
};

}  // namespace glimt
