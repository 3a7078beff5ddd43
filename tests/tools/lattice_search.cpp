#include <cmath>
#include <cstdint>
#include <cstdio>
#include <numbers>
#include <random>
#include <vector>

// Finds the steps of core/math/lattice.h, one dimension after the other: of many random ones the step that makes the
// variance of randomly shifted points smallest, over that of independent ones, averaged over numbers of points. The
// integrand's Fourier coefficients are taken to fall as 1/h in each dimension, as those of one with jumps do, so the
// variance is the sum over h of |(1/n) sum_i exp(2 pi i h.step i)|^2 / h^2; single dimensions and pairs count.
//
//   c++ -O3 -ffast-math -o lattice_search tests/tools/lattice_search.cpp && ./lattice_search

namespace {

constexpr int hits = 15, per_hit = 6;
constexpr int candidates = 20000;
const std::vector<int> sizes{8, 16, 32, 64, 128, 256, 1024};

/// |(1/n) sum over i < n of exp(2 pi i x i)|^2
double power(double x, int n) {
  const double s = std::sin(std::numbers::pi * (x - std::floor(x)));
  if (std::abs(s) < 1e-9) return 1;
  const double t = std::sin(std::numbers::pi * n * (x - std::floor(x))) / (n * s);
  return t * t;
}

/// Dimensions in the order of the search: two of the camera, then of each hit the direction's two, the lamp point's
/// two, roulette's, and the choice of the lamp.
double pair_weight(int i, int j) {
  const bool same = j < 2 || (i >= 2 && (i - 2) / per_hit == (j - 2) / per_hit);
  const int p = j < 2 ? i : (i + 4) % per_hit, q = j < 2 ? j : (j + 4) % per_hit;
  const bool square = same && p % 2 == 0 && q == p + 1 && q < 4;
  return (square ? 0.6 : same ? 0.12 : j - i <= 8 ? 0.06 : 0.02) * (p == 5 || q == 5 ? 0.2 : 1);
}

double variance_ratio(const std::vector<double>& found, double step, double give_up) {
  const int j = static_cast<int>(found.size());
  double sum = 0;
  for (const int n : sizes) {
    double variance = 0, independent = 0;
    const auto add = [&](double weight, double x) { variance += weight * power(x, n), independent += weight / n; };
    for (int h = 1; h <= 32; ++h) add(1.0 / (h * h), h * step);
    for (int i = 0; i < j; ++i) {
      const double weight = pair_weight(i, j);
      const int most = weight > 0.3 ? 8 : 4;
      for (int p = 1; p <= most; ++p)
        for (int q = 1; q <= most; ++q)
          for (const int sign : {-1, 1})
            add(weight / (p * p * q * q), p * found[static_cast<std::size_t>(i)] + sign * q * step);
    }
    sum += variance / independent / static_cast<double>(sizes.size());
    if (sum > give_up) break;
  }
  return sum;
}

}  // namespace

int main() {
  std::mt19937 random(1);
  std::vector<double> found;
  std::vector<std::uint32_t> steps;
  while (found.size() < 2 + hits * per_hit) {
    double best = 1e300;
    std::uint32_t best_step = 0;
    for (int c = 0; c < candidates; ++c) {
      const auto step = static_cast<std::uint32_t>(random()) | 1u;
      const double ratio = variance_ratio(found, step * 0x1p-32, best);
      if (ratio < best) best = ratio, best_step = step;
    }
    found.push_back(best_step * 0x1p-32);
    steps.push_back(best_step);
    std::fprintf(stderr, "%zu: %08x, variance over that of independent points %.3f\n", steps.size(), best_step, best);
  }
  // A row for each dimension of a hit in the sampler's order, the camera first in it.
  for (const int dimension : {0, 1, 4, 5, 2, 3}) {
    std::printf("    {0x%08xu", dimension < 2 ? steps[static_cast<std::size_t>(dimension)] : 0);
    for (int hit = 0; hit < hits; ++hit)
      std::printf(", 0x%08xu", steps[static_cast<std::size_t>(2 + hit * per_hit + dimension)]);
    std::printf("},\n");
  }
}
