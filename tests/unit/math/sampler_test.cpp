#include "math/sampler.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "statistics_helpers.h"

using namespace glimt;

namespace {

double number(std::uint32_t seed, std::uint32_t pixel, std::uint32_t sample, std::uint32_t dimension) {
  return static_cast<double>(uniform<float>(path_key<float>(seed, pixel, sample), dimension));
}

constexpr double alpha = 1e-4;  ///< of a false alarm, for each of the tests below

// A block of neighbouring paths: 64 pixels, 64 samples, 16 dimensions. Buckets of equal probability; the statistic has
// 255 degrees of freedom.
TEST(Sampler, IsUniformInEveryStretchOfPixelsSamplesAndDimensions) {
  constexpr int buckets = 256;
  const std::vector<std::array<std::uint32_t, 4>> corners{
      {1, 0, 0, 0}, {1, 160000, 0, 2}, {2, 0, 1 << 20, 0}, {0, 1u << 25, 7, 100}, {2147483647, 399, 0xffffffc0u, 5000}};
  for (const auto& [seed, pixel, sample, dimension] : corners) {
    std::vector<double> count(buckets);
    double sum = 0, squares = 0, n = 0;
    for (std::uint32_t p = 0; p < 64; ++p)
      for (std::uint32_t s = 0; s < 64; ++s)
        for (std::uint32_t d = 0; d < 16; ++d) {
          const double u = number(seed, pixel + p, sample + s, dimension + d);
          ASSERT_GE(u, 0);
          ASSERT_LT(u, 1);
          ++count[static_cast<std::size_t>(u * buckets)];
          sum += u, squares += (u - 0.5) * (u - 0.5), ++n;
        }
    double chi2 = 0;
    for (const double c : count) chi2 += (c - n / buckets) * (c - n / buckets) / (n / buckets);
    const double level = sidak(alpha, 3.0 * static_cast<double>(corners.size()));
    EXPECT_GT(chi_square_tail(chi2, buckets - 1), level)
        << "seed " << seed << ", pixel " << pixel << ", sample " << sample;
    // A uniform number has mean 1/2 and variance 1/12; its squared deviation has variance 1/80 - 1/144 = 1/180.
    EXPECT_GT(normal_tails((sum / n - 0.5) * std::sqrt(12 * n)), level) << sum / n;
    EXPECT_GT(normal_tails((squares / n - 1.0 / 12) * std::sqrt(180 * n)), level) << squares / n;
  }
}

// The extreme values of 2^24 steps: a number of 1 would send a sample off its lamp.
TEST(Sampler, IsBelowOneAndFineGrained) {
  float largest = 0, smallest = 1;
  for (std::uint32_t s = 0; s < (1u << 22); ++s) {
    const float u = uniform<float>(path_key<float>(1, 0, s), 0u);
    ASSERT_EQ(u * 0x1p24f, std::floor(u * 0x1p24f));
    largest = std::max(largest, u), smallest = std::min(smallest, u);
  }
  EXPECT_LT(largest, 1.0f);
  EXPECT_GT(largest, 1 - 0x1p-18f) << "missed with probability exp(-16)";
  EXPECT_LT(smallest, 0x1p-18f) << "missed with probability exp(-16)";
}

// Numbers of two paths or dimensions that differ in one way: their correlation over n pairs, times sqrt(n), is normal.
// Also of squares (a joint dependence that leaves numbers uncorrelated) and on a grid of 16 x 16 by chi-square.
TEST(Sampler, NeighboursAreIndependent) {
  struct Step {
    const char* name;
    std::uint32_t seed, pixel, sample, dimension;
  };
  std::vector<Step> steps{{"next pixel", 0, 1, 0, 0},
                          {"pixel below", 0, 400, 0, 0},
                          {"next sample", 0, 0, 1, 0},
                          {"other half", 0, 0, 2, 0},
                          {"next seed", 1, 0, 0, 0},
                          {"next dimension", 0, 0, 0, 1},
                          {"u and roulette", 0, 0, 0, 2},
                          {"next hit", 0, 0, 0, 6},
                          {"four shadow rays", 0, 0, 0, 15},
                          {"pixel and sample", 0, 1, 1, 0},
                          {"pixel, sample", 0, 1, ~0u, 0},
                          {"a bit of the pixel", 0, 1u << 16, 0, 0},
                          {"a bit of the sample", 0, 0, 1u << 16, 0}};
  const double level = sidak(alpha, 3.0 * static_cast<double>(steps.size()));
  for (const Step& step : steps) {
    double product = 0, squares = 0, n = 0;
    std::vector<double> grid(256);
    for (std::uint32_t p = 0; p < 256; ++p)
      for (std::uint32_t s = 0; s < 256; ++s)
        for (std::uint32_t d = 0; d < 4; ++d) {
          // Twice the step, so that no number serves in two pairs.
          const std::uint32_t seed = 1 + 2 * step.seed, pixel = 1000 + p * (step.pixel == 1 ? 2 : 1);
          const std::uint32_t sample = s * (step.sample == 1 || step.sample == ~0u ? 2 : 1) + 2, dimension = 40 * d;
          const double a = number(seed, pixel, sample, dimension) - 0.5;
          const double b =
              number(seed + step.seed, pixel + step.pixel, sample + step.sample, dimension + step.dimension) - 0.5;
          product += 12 * a * b;                                     // variance 1
          squares += 180 * (a * a - 1.0 / 12) * (b * b - 1.0 / 12);  // variance 1
          ++grid[static_cast<std::size_t>((a + 0.5) * 16) * 16 + static_cast<std::size_t>((b + 0.5) * 16)];
          ++n;
        }
    double chi2 = 0;
    for (const double c : grid) chi2 += (c - n / 256) * (c - n / 256) / (n / 256);
    EXPECT_GT(normal_tails(product / std::sqrt(n)), level) << step.name << ": correlation " << product / n;
    EXPECT_GT(normal_tails(squares / std::sqrt(n)), level) << step.name << ": correlation of squares " << squares / n;
    EXPECT_GT(chi_square_tail(chi2, 255), level) << step.name << ": chi-square " << chi2;
  }
}

// 2^20 keys of 64 bits collide by chance with probability 2^40 / 2 / 2^64 = 3e-8.
TEST(Sampler, KeysOfAMillionPathsDiffer) {
  for (const std::uint32_t rows : {1u, 1024u, 1u << 20}) {
    std::vector<std::uint64_t> keys;
    for (std::uint32_t p = 0; p < rows; ++p)
      for (std::uint32_t s = 0; s < (1u << 20) / rows; ++s) {
        const PathKey<float> key = path_key<float>(1, p, s);
        keys.push_back(std::uint64_t{key.a} << 32 | key.b);
      }
    std::ranges::sort(keys);
    EXPECT_EQ(std::ranges::adjacent_find(keys), keys.end()) << rows << " pixels";
  }
}

// One path's numbers go on through its blocks of dimensions, which never overlap.
TEST(Sampler, BlocksOfDimensionsHoldAllShadowRays) {
  for (int rays = 1; rays <= 64; ++rays) EXPECT_EQ(hit_dimensions(rays), 3u + 3u * static_cast<std::uint32_t>(rays));
}

TEST(Sampler, LanesDrawTheScalarNumbers) {
  using U = Uint<KernelLanes>;
  std::array<std::uint32_t, lane_count<KernelLanes>> pixel, sample;
  std::array<float, lane_count<KernelLanes>> lane;
  for (std::uint32_t trial = 0; trial < 10000; ++trial) {
    for (std::uint32_t i = 0; i < pixel.size(); ++i)
      pixel[i] = mix(trial * 64 + i), sample[i] = mix(pixel[i]) >> (trial % 32);
    const PathKey<KernelLanes> key = path_key<KernelLanes>(trial, load<U>(pixel.data()), load<U>(sample.data()));
    store(uniform<KernelLanes>(key, trial), lane.data());
    for (std::size_t i = 0; i < pixel.size(); ++i)
      ASSERT_EQ(lane[i], uniform<float>(path_key<float>(trial, pixel[i], sample[i]), trial))
          << pixel[i] << " " << sample[i];
  }
}

}  // namespace
