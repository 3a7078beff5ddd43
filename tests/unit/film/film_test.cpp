#include "film/film.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <thread>

using namespace glimt;

namespace {

constexpr float nan_value = std::numeric_limits<float>::quiet_NaN();
constexpr float infinite = std::numeric_limits<float>::infinity();

void add_grey(Film& film, int pixel, int half, float value) { film.add(pixel, half, value, value, value); }

TEST(Film, SumsDoNotDependOnTheOrderOfSamples) {
  std::mt19937 random(1);
  std::vector<float> samples(10000);
  for (float& sample : samples) sample = std::exp(std::normal_distribution<float>(0, 4)(random));
  const auto picture = [&] {
    Film film(1, 1, 20);
    for (const float sample : samples) film.add(0, 0, sample, 2 * sample, sample / 3);
    film.finish_pass(static_cast<int>(samples.size()));
    return film.mean().rgb;
  };
  const auto first = picture();
  std::ranges::shuffle(samples, random);
  EXPECT_EQ(first, picture());
  std::ranges::sort(samples, std::greater());
  EXPECT_EQ(first, picture());
}

// A float sum of a million 0.1f is 100958 and not 100000. With the brightest radiance 1 a unit is 2^-38, and 0.1f is a
// whole number of 2^-27, so that the sums are exact.
TEST(Film, AMillionSamplesDoNotDrift) {
  Film film(1, 1, 1);
  for (int i = 0; i < 1'000'000; ++i) film.add(0, i % 2, 0.1f, 1e-3f, 1.0f);
  film.finish_pass(1'000'000);
  EXPECT_EQ(film.mean().rgb[0], 0.1f);
  EXPECT_EQ(film.mean().rgb[2], 1.0f);
  EXPECT_EQ(film.half_sum(0, 0)[0], 500'000 * static_cast<double>(0.1f));
  EXPECT_NEAR(film.half_sum(0, 1)[1] / 500'000, static_cast<double>(1e-3f), 0x1p-39) << "half a unit at most";
}

TEST(Film, RoundsToTheNearestUnit) {
  Film film(1, 1, 1);
  film.add(0, 0, 0.25f * 0x1p-38f, 0.75f * 0x1p-38f, 7.75f * 0x1p-38f);
  EXPECT_EQ(film.half_sum(0, 0), (std::array{0.0, 0x1p-38, 0x1p-35}));
}

// Large values, and rows that hold one, take another way than the rest; it must lead to the same sums.
TEST(Film, RowsAddAsSinglePixelsDo) {
  std::mt19937 random(4);
  constexpr int width = 37, pixels = 3 * width, samples = 50;
  Film rows(width, 3, 2), singles(width, 3, 2);
  std::lognormal_distribution<float> value(0, 6);
  for (int sample = 0; sample < samples; ++sample)
    for (int y = 0; y < 3; ++y) {
      std::vector<float> rgb(3 * width);
      for (float& v : rgb) v = value(random);
      if (sample % 5 == 0) rgb[static_cast<std::size_t>(sample)] = nan_value;
      if (sample % 7 == 0) rgb[7] = 1e30f;
      rows.add(y * width, sample % 2, rgb);
      for (std::size_t x = 0; x < width; ++x)
        singles.add(y * width + static_cast<int>(x), sample % 2, rgb[3 * x], rgb[3 * x + 1], rgb[3 * x + 2]);
    }
  for (int pixel = 0; pixel < pixels; ++pixel)
    for (const int half : {0, 1}) EXPECT_EQ(rows.half_sum(pixel, half), singles.half_sum(pixel, half)) << pixel;
  EXPECT_EQ(rows.invalid(), 30u);
  EXPECT_EQ(rows.invalid(), singles.invalid());
  EXPECT_GE(rows.saturated(), 24u) << "later sums on the full ones count too";
  EXPECT_EQ(rows.saturated(), singles.saturated());
}

TEST(Film, NoBrightestRadianceIsAsGoodAsOne) {
  for (const double brightest : {0.0, -1.0, std::numeric_limits<double>::infinity()}) {
    Film film(1, 1, brightest);
    add_grey(film, 0, 0, 0.5f);
    film.finish_pass(1);
    EXPECT_EQ(film.mean().rgb[1], 0.5f);
  }
}

TEST(Film, HoldsRadianceOfAnyScale) {
  for (const float brightest : {1e-30f, 1e-6f, 1.0f, 1e9f, 1e30f}) {
    Film film(1, 1, brightest);
    for (int i = 0; i < 1000; ++i) add_grey(film, 0, i % 2, brightest);
    film.finish_pass(1000);
    EXPECT_FLOAT_EQ(film.mean().rgb[0], brightest);
    EXPECT_EQ(film.saturated(), 0u);
  }
}

// 2^25 samples of the brightest radiance are 2^25 * 2^38 = 2^63 units, the first number that does not fit.
TEST(Film, ValuesThatDoNotFitStopAtTheLargestAndAreCounted) {
  Film film(1, 1, 32);
  film.add(0, 0, 32 * 0x1p24f, 0, 0);
  EXPECT_EQ(film.saturated(), 0u);
  film.add(0, 1, 0, 32 * 0x1p25f, 1);
  EXPECT_EQ(film.saturated(), 1u);
  EXPECT_EQ(film.half_sum(0, 1), (std::array{0.0, 32 * 0x1p25, 1.0}));
  EXPECT_EQ(film.invalid(), 0u);
}

TEST(Film, SumsThatDoNotFitStopAtTheLargestAndAreCounted) {
  Film film(1, 1, 32);
  for (int i = 0; i < 3; ++i) film.add(0, 0, 32 * 0x1p24f, 1, 1);
  EXPECT_EQ(film.saturated(), 2u);
  EXPECT_EQ(film.half_sum(0, 0), (std::array{32 * 0x1p25, 3.0, 3.0}));
}

TEST(Film, InvalidValuesAreCountedAndAddNothing) {
  Film film(1, 1, 1);
  film.add(0, 0, 1, 1, 1);
  film.add(0, 0, nan_value, 0, 1);
  film.add(0, 0, 1, infinite, -infinite);
  film.add(0, 0, 0, -1e-30f, 1);
  EXPECT_EQ(film.invalid(), 4u);
  EXPECT_EQ(film.saturated(), 0u);
  EXPECT_EQ(film.half_sum(0, 0), (std::array{2.0, 1.0, 3.0}));
  film.add(0, 0, -0.0f, 0, 0);
  EXPECT_EQ(film.invalid(), 4u) << "minus zero is zero";
}

TEST(Film, ThreadsCountTogether) {
  constexpr int threads = 4, samples = 20000;
  Film film(threads, 1, 1);
  std::vector<std::thread> workers;
  for (int pixel = 0; pixel < threads; ++pixel)
    workers.emplace_back([&film, pixel] {
      for (int i = 0; i < samples; ++i) film.add(pixel, i % 2, 1, nan_value, 1e30f);
    });
  for (auto& worker : workers) worker.join();
  EXPECT_EQ(film.invalid(), threads * samples);
  EXPECT_EQ(film.saturated(), threads * samples);
  for (int pixel = 0; pixel < threads; ++pixel) EXPECT_EQ(film.half_sum(pixel, 0)[0], samples / 2);
}

TEST(Film, HalvesHoldEvenAndOddSamples) {
  Film film(2, 1, 8);
  for (int sample = 0; sample < 5; ++sample) film.add(1, sample % 2, static_cast<float>(sample), 1, 0);
  film.finish_pass(3);
  film.finish_pass(2);
  EXPECT_EQ(film.samples(), 5);
  EXPECT_EQ(film.half_samples(0), 3);
  EXPECT_EQ(film.half_samples(1), 2);
  EXPECT_EQ(film.half_mean(0).rgb, (std::vector<float>{0, 0, 0, 2, 1, 0}));  // (0 + 2 + 4) / 3
  EXPECT_EQ(film.half_mean(1).rgb, (std::vector<float>{0, 0, 0, 2, 1, 0}));  // (1 + 3) / 2
  EXPECT_EQ(film.mean().rgb, (std::vector<float>{0, 0, 0, 2, 1, 0}));
}

TEST(Film, IsBlackBeforeTheFirstSampleAndItsErrorUnknownBeforeTheSecond) {
  Film film(1, 1, 1);
  EXPECT_EQ(film.mean().rgb, std::vector<float>(3, 0));
  EXPECT_EQ(film.standard_error().rgb, std::vector<float>(3, infinite));
  add_grey(film, 0, 0, 1);
  film.finish_pass(1);
  EXPECT_EQ(film.half_mean(1).rgb, std::vector<float>(3, 0));
  EXPECT_EQ(film.standard_error().rgb, std::vector<float>(3, infinite));
  add_grey(film, 0, 1, 1);
  film.finish_pass(1);
  EXPECT_EQ(film.standard_error().rgb, std::vector<float>(3, 0));
}

TEST(Film, StandardErrorComesFromTheHalves) {
  Film film(1, 1, 8);
  for (const float value : {1.0f, 2.0f, 6.0f}) add_grey(film, 0, 0, value);  // mean 3
  for (const float value : {0.0f, 2.0f}) add_grey(film, 0, 1, value);        // mean 1
  film.finish_pass(5);
  EXPECT_FLOAT_EQ(film.standard_error().rgb[0], static_cast<float>(2 * std::sqrt(6.0) / 5));
}

// The mean of five exponential variables has variance 1/5. The mean squared standard error over 600,000 channels is
// normal by the central limit theorem; five of its standard deviations are left by chance once in 1.7 million tests.
TEST(Film, SquaredStandardErrorIsUnbiased) {
  constexpr int side = 448, samples = 5;
  Film film(side, side, 64);
  std::mt19937 random(2);
  std::exponential_distribution<float> sample;
  for (int pixel = 0; pixel < side * side; ++pixel)
    for (int i = 0; i < samples; ++i) film.add(pixel, i % 2, sample(random), sample(random), sample(random));
  film.finish_pass(samples);

  double sum = 0, sum_of_squares = 0;
  const Image error = film.standard_error();
  for (const float e : error.rgb) {
    const double square = static_cast<double>(e) * e;
    sum += square;
    sum_of_squares += square * square;
  }
  const auto n = static_cast<double>(error.rgb.size());
  const double deviation = std::sqrt((sum_of_squares / n - sum / n * sum / n) / n);
  EXPECT_NEAR(sum / n, 1.0 / samples, 5 * deviation);
  EXPECT_LT(deviation, 0.001);
}

TEST(Film, FullHighDefinitionFitsInMemory) {
  const Film film(1920, 1080, 1);
  EXPECT_LT(film.bytes(), 150'000'000u);
  EXPECT_GE(film.bytes(), 1920u * 1080u * 6u * sizeof(std::int64_t));
}

TEST(Film, CopiesAreIndependent) {
  Film film(1, 1, 1);
  add_grey(film, 0, 0, nan_value);
  Film copy = film;
  add_grey(copy, 0, 0, 1);
  EXPECT_EQ(film.half_sum(0, 0)[0], 0);
  EXPECT_EQ(copy.half_sum(0, 0)[0], 1);
  EXPECT_EQ(copy.invalid(), 3u);
}

}  // namespace
