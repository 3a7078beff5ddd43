#include "film/statistics.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <stdexcept>
#include <string>

using namespace glimt;

namespace {

Image grey(int width, int height, float value) {
  return {width, height,
          std::vector<float>(static_cast<std::size_t>(width) * static_cast<std::size_t>(height) * 3, value)};
}

std::string message_of(const Image& x, const Image& reference) {
  try {
    compare(x, reference);
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "nothing thrown";
}

TEST(Compare, TwoPixelsByHand) {
  const Image x{2, 1, {1.5f, 1, 1, 0, 0.5f, 0}};
  const Image reference{2, 1, {1, 1, 1, 0, 0, 0}};
  const Comparison c = compare(x, reference);
  EXPECT_DOUBLE_EQ(c.mean, 4.0 / 6);
  EXPECT_DOUBLE_EQ(c.mean_reference, 0.5);
  EXPECT_DOUBLE_EQ(c.bias, 1.0 / 6);
  EXPECT_DOUBLE_EQ(c.rmse, std::sqrt(0.5 / 6));
  const double e0 = 0.25 / 1.01 / 3, e1 = 0.25 / 0.01 / 3;
  EXPECT_DOUBLE_EQ(c.relmse, (e0 + e1) / 2);
  EXPECT_DOUBLE_EQ(c.relmse999, e0) << "0.1 % of 2 pixels is rounded up to 1";
}

TEST(Compare, IsRelativeToTheReference) {
  const Comparison c = compare(grey(4, 4, 1), grey(4, 4, 3));
  EXPECT_DOUBLE_EQ(c.relmse, 4 / 9.01);
  EXPECT_DOUBLE_EQ(c.bias, -2);
  EXPECT_DOUBLE_EQ(c.rmse, 2);
}

TEST(Compare, LeavesOutATenthOfAPercentRoundedUp) {
  // Black reference: a pixel of grey v has e = v^2 / 0.01 = 100 v^2. All pixels have 100 but three, which have more.
  const auto relmse999_of = [](int pixels) {
    Image x = grey(pixels, 1, 1);
    const int brighter[3] = {4, 3, 2};
    for (int i = 0; i < 3; ++i)
      for (int c = 0; c < 3; ++c) x.pixel(7 * i + 1, 0)[c] = static_cast<float>(brighter[i]);
    return compare(x, grey(pixels, 1, 0)).relmse999;
  };
  EXPECT_NEAR(relmse999_of(1000), (996 * 100 + 1 * 100 + 400 + 900) / 999.0, 1e-9) << "1 left out";
  EXPECT_NEAR(relmse999_of(1001), (998 * 100 + 400) / 999.0, 1e-9) << "2 left out";
  EXPECT_NEAR(relmse999_of(2000), (1997 * 100 + 400) / 1998.0, 1e-9) << "2 left out";
  EXPECT_NEAR(relmse999_of(2001), 100, 1e-9) << "3 left out";
}

TEST(Compare, NothingIsLeftOfOnePixel) {
  const Comparison c = compare(grey(1, 1, 1), grey(1, 1, 0));
  EXPECT_DOUBLE_EQ(c.relmse, 100);
  EXPECT_EQ(c.relmse999, 0);
}

TEST(Compare, RefusesDifferentSizes) {
  const std::string message = message_of(grey(4, 2, 0), grey(2, 4, 0));
  EXPECT_NE(message.find("4x2"), std::string::npos) << message;
  EXPECT_NE(message.find("2x4"), std::string::npos) << message;
}

TEST(Compare, NamesTheFirstPixelThatIsNotFinite) {
  Image bad = grey(5, 4, 1);
  bad.pixel(3, 2)[1] = std::numeric_limits<float>::quiet_NaN();
  bad.pixel(4, 3)[0] = std::numeric_limits<float>::infinity();
  const std::string message = message_of(bad, grey(5, 4, 1));
  EXPECT_NE(message.find("the image"), std::string::npos) << message;
  EXPECT_NE(message.find("(3, 2)"), std::string::npos) << message;
  EXPECT_NE(message_of(grey(5, 4, 1), bad).find("the reference"), std::string::npos);
}

TEST(Mean, IsOverPixelsAndChannels) {
  EXPECT_DOUBLE_EQ(mean(Image{2, 1, {1, 2, 3, 4, 5, 9}}), 4);
  EXPECT_EQ(mean(Image{}), 0);
}

TEST(RelmseEstimate, IsInfiniteBelowTwoSamples) {
  Film film(3, 3, 1);
  EXPECT_EQ(relmse_estimate(film), std::numeric_limits<double>::infinity());
  film.finish_pass(1);
  EXPECT_EQ(relmse_estimate(film), std::numeric_limits<double>::infinity());
  film.finish_pass(1);
  EXPECT_EQ(relmse_estimate(film), 0);
}

// 9x10 pixels are four blocks: 8x8, 1x8, 8x2, 1x2.
TEST(RelmseEstimate, BlocksAreAlignedAndPartialAtTheBorder) {
  Film film(9, 10, 64);
  for (int y = 0; y < 10; ++y)
    for (int x = 0; x < 9; ++x) {
      const float base = y < 8 ? (x < 8 ? 1.0f : 2.0f) : (x < 8 ? 4.0f : 8.0f);
      const float half_difference = x == 8 && y == 9 ? 2.0f : 0.5f;
      film.add(y * 9 + x, 0, base + half_difference, base, base);
      film.add(y * 9 + x, 1, base - half_difference, base, base);
    }
  film.finish_pass(2);
  // Per pixel (h0 - h1)^2 / 4 = 0.25, and 4 in the last one; only the first channel differs.
  const double sum = 64 * 0.25 / 1.01 + 8 * 0.25 / 4.01 + 16 * 0.25 / 16.01 + (0.25 + 4) / 64.01;
  EXPECT_NEAR(relmse_estimate(film), sum / (90 * 3), 1e-14);
}

TEST(RelmseEstimate, WeighsOddCounts) {
  Film film(1, 1, 8);
  for (const float value : {1.0f, 3.0f}) film.add(0, 0, value, value, value);  // mean 2
  film.add(0, 1, 5, 5, 5);
  film.finish_pass(3);
  EXPECT_NEAR(relmse_estimate(film), 9 * (2.0 / 9) / (9 + 0.01), 1e-14);
}

// Each channel is the mean of 4 exponential variables of mean 2: variance 1, excess kurtosis 6/4. Noise of the block
// mean m (variance 1/64) raises the estimate by 3 var(m) / m^2 = 1.2 %, its correlation with the noise measured lowers
// it by 2 cov / m = 1.6 %. The squared errors behind estimate and truth have variance 2 + 6/4 each and do not correlate
// negatively, so five standard deviations of the ratio over 480,000 channels are at most 5 sqrt(7 / 480000) = 1.9 %: a
// false alarm once in 1.7 million tests.
TEST(RelmseEstimate, AgreesWithTheTrueError) {
  constexpr int side = 400;
  Film film(side, side, 64);
  std::mt19937 random(3);
  std::exponential_distribution<float> sample(0.5f);
  for (int pixel = 0; pixel < side * side; ++pixel)
    for (int i = 0; i < 4; ++i) film.add(pixel, i % 2, sample(random), sample(random), sample(random));
  film.finish_pass(4);
  EXPECT_NEAR(relmse_estimate(film) / compare(film.mean(), grey(side, side, 2)).relmse, 1, 0.016 + 0.019);
}

// A power of two times every radiance is exact in film and images, so no bit of a measure without a scale may change.
TEST(RelmseScaled, IsTheSameForEveryScale) {
  const auto of_scale = [](float scale) {
    Film film(9, 10, 8 * scale);
    std::mt19937 random(5);
    std::exponential_distribution<float> sample(0.5f);
    for (int pixel = 0; pixel < 90; ++pixel)
      for (int i = 0; i < 3; ++i) {
        const float r = sample(random) * scale, g = sample(random) * scale, b = sample(random) * scale;
        film.add(pixel, i % 2, r, g, b);
      }
    film.finish_pass(3);
    return std::pair(estimate_error(film), compare(film.half_mean(0), film.half_mean(1)).relmse_scaled);
  };
  const auto [one, compared] = of_scale(1);
  EXPECT_GT(one.relmse_scaled, 0);
  for (const float scale : {0x1p-40f, 0.5f, 2.0f, 0x1p40f}) {
    const auto [other, other_compared] = of_scale(scale);
    EXPECT_EQ(other.relmse_scaled, one.relmse_scaled) << scale;
    EXPECT_EQ(other.low, one.low) << scale;
    EXPECT_EQ(other.high, one.high) << scale;
    EXPECT_EQ(other_compared, compared) << scale;
  }
  EXPECT_NE(of_scale(0.5f).first.relmse, one.relmse) << "relmse has a scale";
}

TEST(RelmseScaled, BlackPictureHasNone) {
  Film film(9, 10, 1);
  film.finish_pass(1 << 20);
  const ErrorEstimate black = estimate_error(film);
  EXPECT_EQ(black.relmse_scaled, std::numeric_limits<double>::infinity());
  EXPECT_EQ(black.low, 0);
  EXPECT_EQ(black.high, std::numeric_limits<double>::infinity());
  EXPECT_EQ(trust_text(black), "error unknown");
}

// Halves and truth are independent, each the mean of 4 normal numbers: the ratio of the error made and the error
// estimated is that of two chi-square variables. More than 35 of 400 pictures outside an interval of 95 % come by
// chance once in 1000 tests.
TEST(RelmseScaled, IntervalHoldsTheError) {
  std::mt19937 random(7);
  std::normal_distribution<float> sample(4, 0.5f);
  int outside = 0;
  for (int picture = 0; picture < 400; ++picture) {
    Film film(16, 16, 16);
    for (int pixel = 0; pixel < 256; ++pixel)
      for (int i = 0; i < 4; ++i) film.add(pixel, i % 2, sample(random), sample(random), sample(random));
    film.finish_pass(4);
    const ErrorEstimate estimate = estimate_error(film);
    const double error = compare(film.mean(), grey(16, 16, 4)).relmse_scaled;
    outside += error < estimate.low || error > estimate.high;
  }
  EXPECT_LE(outside, 35);
}

TEST(RelmseScaled, IntervalIsOpenWhereOnePixelHasAllOfTheError) {
  Film film(16, 16, 16);
  for (int pixel = 0; pixel < 256; ++pixel)
    for (int half = 0; half < 2; ++half) film.add(pixel, half, 1, 1, pixel == 99 && half == 0 ? 9 : 1);
  film.finish_pass(2);
  EXPECT_EQ(estimate_error(film).high, std::numeric_limits<double>::infinity());
}

}  // namespace
