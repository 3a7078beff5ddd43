// fma_peak: how many fused products and sums of floats this processor does in a second, in the kernel's batches and
// nothing else, on one thread and on all; as JSON. A FLOP is a product or a sum, so a fused product counts twice.
#include <omp.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdio>

#include "math/lanes.h"
#include "render/render.h"

namespace {

using namespace glimt;

constexpr int chains = 12;         // independent, so that latency is hidden: 2 units with 4 or 5 cycles each, and spare
constexpr int rounds = 1'000'000;  // in one run: some milliseconds, so that few are disturbed

/// FLOP/s on so many threads, the best of 200 runs.
double peak(int threads) {
  double best = 0, sink = 0;
  for (int repeat = 0; repeat < 200; ++repeat) {
    const auto start = std::chrono::steady_clock::now();
#pragma omp parallel num_threads(threads) reduction(+ : sink)
    {
      std::array<NativeLanes, chains> sums;
      sums.fill(NativeLanes(1.0f));
      NativeLanes factor(0.999f), term(0.001f);
      for (int i = 0; i < rounds; ++i)
        for (NativeLanes& sum : sums) sum = fma(sum, factor, term);
      for (const NativeLanes& sum : sums) sink += static_cast<double>(sum.get(0));
    }
    const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    best = std::max(best, 2.0 * rounds * chains * lane_count<NativeLanes> * threads / seconds);
  }
  return sink > 0 ? best : 0;
}

}  // namespace

int main() {
  const int threads = hardware_threads();
  std::printf("{\"lanes\": %d, \"threads\": %d, \"flops_one\": %.4g, \"flops_all\": %.4g}\n", lane_count<NativeLanes>,
              threads, peak(1), peak(threads));
}
