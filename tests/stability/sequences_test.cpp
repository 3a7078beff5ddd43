// Numbers that share a sequence: what a sampler makes even in one place must not tie anything together elsewhere.
#include <gtest/gtest.h>

#include <functional>

#include "kernel/transport/random.h"
#include "statistics_helpers.h"

using namespace glimt;

namespace {

constexpr double alpha = 1e-4;  ///< of a false alarm, for each test
constexpr std::uint32_t pixels = 512 * effort;

constexpr std::array samplers{Sampler::independent, Sampler::stratified, Sampler::lattice, Sampler::sobol};
constexpr std::array names{"independent", "stratified", "lattice", "sobol"};
/// Samples per pixel, both halves together: powers of two and not.
constexpr std::array<std::uint32_t, 6> counts{6, 16, 50, 64, 200, 256};

/// What a path asks for: a dimension of its hit number `hit` (0: the camera).
struct Place {
  std::uint32_t hit, dimension;
};

constexpr std::uint32_t per_hit = 6;  ///< dimensions, with one shadow ray

Point2<double> pair(Sampler sampler, std::uint32_t seed, std::uint32_t pixel, std::uint32_t sample, Place place) {
  PathKey<float> key = first_key<float>(sampler, seed, pixel, sample);
  if (place.hit > 0)
    key = skip_dimensions<float>(key, static_cast<std::uint32_t>(Dimension::camera_count) + per_hit * (place.hit - 1));
  const auto p =
      random_pair<float>(sampler, key, LatticePlace<float>::of(static_cast<std::int32_t>(place.hit)), place.dimension);
  return {static_cast<double>(p.u), static_cast<double>(p.v)};
}

/// What stands for a picture: a smooth function of a pair, of mean 0 and variance 1.
double value(const Point2<double>& p) {
  const double u = std::sqrt(12.0) * (p.u - 0.5), v = std::sqrt(12.0) * (p.v - 0.5);
  return (u + v + u * v) / std::sqrt(3.0);
}

/// Mean of `value` over the samples of one pixel.
double error_of(Sampler sampler, std::uint32_t seed, std::uint32_t pixel, std::uint32_t first, std::uint32_t step,
                std::uint32_t count, Place place) {
  double sum = 0;
  for (std::uint32_t s = 0; s < count; ++s) sum += value(pair(sampler, seed, pixel, first + step * s, place));
  return sum / count;
}

const std::vector<Place> places{{0, 0},  {1, 0},  {1, 4},  {2, 0}, {7, 4},
                                {14, 0}, {16, 0}, {17, 4}, {84, 0}};  // 84: 500 on

// Failure: numbers whose mean is off bias the picture however many there are; numbers that are less even than
// independent ones make it noisier. At powers of two and not, up to dimension 500.
TEST(Sequences, HaveTheRightMeanAndNoMoreNoiseThanIndependentNumbers) {
  const double level = sidak(alpha, static_cast<double>(samplers.size() * counts.size() * places.size()));
  for (std::size_t k = 0; k < samplers.size(); ++k)
    for (const std::uint32_t count : counts)
      for (const Place& place : places) {
        std::vector<double> errors, squares;
        for (std::uint32_t p = 0; p < pixels; ++p) {
          errors.push_back(error_of(samplers[k], 1, p, 0, 1, count, place));
          squares.push_back(errors.back() * errors.back() * count);
        }
        const std::string what = std::string(names[k]) + ", " + std::to_string(count) + " samples, hit " +
                                 std::to_string(place.hit) + ", dimension " + std::to_string(place.dimension);
        EXPECT_GT(likelihood(estimate(errors), 0), level) << what << ": mean " << estimate(errors).mean;
        const Estimate variance = estimate(squares);
        EXPECT_LT(variance.mean - 5 * variance.error, 1) << what << ": variance times n " << variance.mean;
      }
}

// Failure: streaks, or an error estimate that is wrong, where the errors of neighbouring pixels, of the two halves of
// one pixel, or of two seeds go together.
TEST(Sequences, ErrorsOfNeighboursHalvesAndSeedsAreUncorrelated) {
  struct Other {
    const char* name;
    std::uint32_t seed, pixel, half;
  };
  const std::vector<Other> others{{"next pixel", 0, 1, 0},
                                  {"pixel below", 0, 400, 0},
                                  {"other half", 0, 0, 1},
                                  {"next seed", 1, 0, 0},
                                  {"seed and pixel", 1, 1, 0}};
  const double level = sidak(alpha, static_cast<double>(samplers.size() * counts.size() * others.size() * 3));
  for (std::size_t k = 0; k < samplers.size(); ++k)
    for (const std::uint32_t count : counts)
      for (const Other& other : others)
        for (const Place& place : {Place{0, 0}, {2, 4}, {84, 0}}) {
          std::vector<double> products;
          for (std::uint32_t p = 0; p < pixels; ++p) {
            const std::uint32_t pixel = 2 * p + 1000;  // no pixel in two pairs
            products.push_back(
                error_of(samplers[k], 1, pixel, 0, 2, count / 2, place) *
                error_of(samplers[k], 1 + other.seed, pixel + other.pixel, other.half, 2, count / 2, place));
          }
          EXPECT_GT(likelihood(estimate(products), 0), level)
              << names[k] << ", " << count << " samples, hit " << place.hit << ", " << other.name;
        }
}

// Failure: two dimensions that run in step, so that the samples of a pixel meet only some of the pairs of a direction
// and the next, or of a direction and a point of the lamp. The mean over a pixel of a product of both, squared and
// times n, is 1 for independent numbers; a sequence may be better, but not worse.
TEST(Sequences, DimensionsOfAPathDoNotRunInStep) {
  const std::vector<std::pair<Place, Place>> pairs{{{0, 0}, {1, 0}},   {{1, 0}, {1, 4}},   {{1, 0}, {2, 0}},
                                                   {{1, 4}, {2, 4}},   {{2, 0}, {3, 4}},   {{1, 0}, {5, 0}},
                                                   {{9, 0}, {10, 0}},  {{14, 0}, {15, 0}}, {{15, 0}, {16, 0}},
                                                   {{16, 4}, {17, 4}}, {{40, 0}, {84, 0}}, {{83, 0}, {84, 4}}};
  for (std::size_t k = 0; k < samplers.size(); ++k)
    for (const std::uint32_t count : counts)
      for (const auto& [a, b] : pairs) {
        std::vector<double> squares, products;
        const std::uint32_t n = count / 2;  // of one half, whose samples share a sequence
        for (std::uint32_t p = 0; p < pixels; ++p) {
          double sum = 0;
          for (std::uint32_t s = 0; s < n; ++s)
            sum += value(pair(samplers[k], 1, p, 2 * s, a)) * value(pair(samplers[k], 1, p, 2 * s, b));
          products.push_back(sum / n);
          squares.push_back(sum * sum / n);
        }
        const std::string what = std::string(names[k]) + ", " + std::to_string(count) + " samples, hit " +
                                 std::to_string(a.hit) + " dimension " + std::to_string(a.dimension) + " with hit " +
                                 std::to_string(b.hit) + " dimension " + std::to_string(b.dimension);
        const double level = sidak(alpha, static_cast<double>(samplers.size() * counts.size() * pairs.size()));
        EXPECT_GT(likelihood(estimate(products), 0), level) << what << ": " << estimate(products).mean;
        const Estimate noise = estimate(squares);
        EXPECT_LT(noise.mean - 5 * noise.error, 1.5) << what << ": n times the mean square is " << noise.mean;
      }
}

}  // namespace
