#include "film/display.h"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <limits>

using namespace glimt;

namespace {

// IEC 61966-2-1, from linear to encoded.
double srgb(double linear) { return linear <= 0.0031308 ? 12.92 * linear : 1.055 * std::pow(linear, 1 / 2.4) - 0.055; }

int exact_code(double linear) { return static_cast<int>(std::floor(255 * srgb(linear) + 0.5)); }

std::uint8_t code_of(float linear, double exposure = 0) {
  return to_srgb8({1, 1, {linear, linear, linear}}, {.exposure = exposure, .dither = Dither::off})[0];
}

TEST(Display, RoundsTheExactCurveToNearest) {
  Image image{0, 1, {}};
  for (std::uint32_t bits = 0; bits < std::bit_cast<std::uint32_t>(1.0f); bits += 211)
    image.rgb.push_back(std::bit_cast<float>(bits));
  image.rgb.resize(image.rgb.size() / 3 * 3);
  image.width = static_cast<int>(image.rgb.size() / 3);
  const auto codes = to_srgb8(image, {.dither = Dither::off});
  ASSERT_EQ(codes.size(), image.rgb.size());
  int wrong = 0;
  for (std::size_t i = 0; i < codes.size() && wrong < 10; ++i)
    if (codes[i] != exact_code(image.rgb[i])) {
      ++wrong;
      ADD_FAILURE() << image.rgb[i] << " gives " << int{codes[i]} << " and not " << exact_code(image.rgb[i]);
    }
}

TEST(Display, StepsUpWhereTheCurveDoes) {
  for (int code = 1; code < 256; ++code) {
    const double encoded = (code - 0.5) / 255;
    const double step = encoded <= 0.04045 ? encoded / 12.92 : std::pow((encoded + 0.055) / 1.055, 2.4);
    EXPECT_EQ(code_of(static_cast<float>(step * (1 - 1e-6))), code - 1);
    EXPECT_EQ(code_of(static_cast<float>(step * (1 + 1e-6))), code);
  }
}

TEST(Display, KnownValues) {
  EXPECT_EQ(code_of(0), 0);
  EXPECT_EQ(code_of(0.18f), 118);  // 1.055 * 0.18^(1/2.4) - 0.055 = 0.4614, times 255 is 117.6
  EXPECT_EQ(code_of(0.5f), 188);   // 0.7354 * 255 = 187.5
  EXPECT_EQ(code_of(1), 255);
}

TEST(Display, ClipsAndShowsInvalidValuesBlack) {
  EXPECT_EQ(code_of(1.0001f), 255);
  EXPECT_EQ(code_of(1e30f), 255);
  EXPECT_EQ(code_of(std::numeric_limits<float>::infinity()), 255);
  EXPECT_EQ(code_of(-1), 0);
  EXPECT_EQ(code_of(-std::numeric_limits<float>::infinity()), 0);
  EXPECT_EQ(code_of(std::numeric_limits<float>::quiet_NaN()), 0);
}

TEST(Display, ExposureIsInStops) {
  EXPECT_EQ(code_of(0.125f, 2), code_of(0.5f));
  EXPECT_EQ(code_of(4, -3), code_of(0.5f));
  EXPECT_EQ(code_of(0.1f, 0.5), exact_code(0.1 * std::sqrt(2.0)));
}

TEST(Display, FilmicCurveIsThePublishedOne) {
  const auto code = [&](float x, double exposure = 0) {
    return to_srgb8({1, 1, {x, x, x}}, {.exposure = exposure, .tone = Tone::filmic, .dither = Dither::off})[0];
  };
  for (const double x : {0.0, 0.01, 0.18, 0.5, 1.0, 2.0, 4.0})
    EXPECT_EQ(code(static_cast<float>(x)), exact_code(x * (2.51 * x + 0.03) / (x * (2.43 * x + 0.59) + 0.14))) << x;
  EXPECT_EQ(code(0.25f, 1), code(0.5f)) << "exposure comes first";
  int last = 0;
  for (float x = 0; x < 100; x = x * 1.01f + 0.001f) {
    EXPECT_GE(code(x), last) << x;
    last = code(x);
  }
  EXPECT_EQ(code(1e30f), 255);
  EXPECT_EQ(code(std::numeric_limits<float>::infinity()), 255);
  EXPECT_EQ(code(-5), 0);
  EXPECT_EQ(code(std::numeric_limits<float>::quiet_NaN()), 0);
}

TEST(Display, ErrorIsOnALogarithmicColourScale) {
  const Display view{.view = View::error};
  const auto [low, high] = colour_scale(View::error);
  const auto colour = [&](double value, double exposure = 0) {
    const auto v = static_cast<float>(value);
    const auto bytes = to_srgb8({1, 1, {v, v, v}}, {.exposure = exposure, .view = view.view});
    return std::array{bytes[0], bytes[1], bytes[2]};
  };
  EXPECT_EQ(colour(low), scale_colour(0));
  EXPECT_EQ(colour(high), scale_colour(1));
  EXPECT_EQ(colour(std::sqrt(low * high)), scale_colour(0.5f));
  EXPECT_EQ(colour(0.1, 1), colour(0.2)) << "errors are as bright as what they are the errors of";
  EXPECT_EQ(colour(0), scale_colour(0));
  EXPECT_EQ(colour(std::numeric_limits<double>::infinity()), scale_colour(1)) << "unknown below two samples";
  EXPECT_EQ(colour(std::numeric_limits<double>::quiet_NaN()), scale_colour(0));
  int last = -1;
  for (int i = 0; i <= 100; ++i) {
    const auto c = scale_colour(static_cast<float>(i) / 100);
    const int brightness = 2126 * c[0] + 7152 * c[1] + 722 * c[2];
    EXPECT_GT(brightness, last) << "brighter from step to step";
    last = brightness;
  }
}

/// CIE L*a*b* of an 8-bit sRGB colour, white point D65.
std::array<double, 3> lab(const std::array<std::uint8_t, 3>& colour) {
  std::array<double, 3> c{};
  for (std::size_t i = 0; i < 3; ++i) {
    const double encoded = colour[i] / 255.0;
    c[i] = encoded <= 0.04045 ? encoded / 12.92 : std::pow((encoded + 0.055) / 1.055, 2.4);
  }
  const auto f = [](double t) { return t > 216.0 / 24389 ? std::cbrt(t) : (24389.0 / 27 * t + 16) / 116; };
  const double x = f((0.4124 * c[0] + 0.3576 * c[1] + 0.1805 * c[2]) / 0.9505),
               y = f(0.2126 * c[0] + 0.7152 * c[1] + 0.0722 * c[2]),
               z = f((0.0193 * c[0] + 0.1192 * c[1] + 0.9505 * c[2]) / 1.089);
  return {116 * y - 16, 500 * (x - y), 200 * (y - z)};
}

// Equal ratios of error are to look equally different: CIE 1976 distances of 32 steps, and their lightness alone, which
// is what remains in grey.
TEST(Display, ColourScaleIsPerceptuallyEven) {
  double least = 1e9, most = 0, least_grey = 1e9, most_grey = 0;
  auto last = lab(scale_colour(0));
  for (int i = 1; i <= 32; ++i) {
    const auto now = lab(scale_colour(static_cast<float>(i) / 32));
    const double step = std::hypot(now[0] - last[0], now[1] - last[1], now[2] - last[2]);
    least = std::min(least, step);
    most = std::max(most, step);
    least_grey = std::min(least_grey, now[0] - last[0]);
    most_grey = std::max(most_grey, now[0] - last[0]);
    last = now;
  }
  EXPECT_LT(most, 1.5 * least);
  EXPECT_LT(most_grey, 1.6 * least_grey);
}

TEST(Display, IsReadBackFromItsTexts) {
  const Display display{.exposure = -1.3, .tone = Tone::filmic, .view = View::samples, .dither = Dither::off};
  EXPECT_EQ(read_display(display_texts(display)), display);
  EXPECT_EQ(read_display({}), Display{});
  EXPECT_EQ(read_display({{"exposure", "bright"}, {"tone", "loud"}, {"view", ""}}), Display{});
  EXPECT_EQ(read_display({{"exposure", "1e9"}}), Display{}) << "out of range";
}

TEST(Display, KeepsTheOrderOfPixelsAndChannels) {
  const Image image{2, 2, {1, 0, 0, 0, 1, 0, 0, 0, 1, 1, 1, 1}};
  EXPECT_EQ(to_srgb8(image, {}), (std::vector<std::uint8_t>{255, 0, 0, 0, 255, 0, 0, 0, 255, 255, 255, 255}));
}

TEST(Display, LargeImagesAreDoneAlike) {
  Image image{1200, 1000, std::vector<float>(3'600'000)};
  for (std::size_t i = 0; i < image.rgb.size(); ++i) image.rgb[i] = static_cast<float>(i % 1009) / 1009;
  const auto codes = to_srgb8(image, {.dither = Dither::off});
  for (std::size_t i = 0; i < 1009; ++i) ASSERT_EQ(codes[1009 * 3500 + i], codes[i]);
  const auto dithered = to_srgb8(image, {});
  image.height = 10;
  image.rgb.resize(std::size_t{3} * 1200 * 10);
  const auto few = to_srgb8(image, {});
  for (std::size_t i = 0; i < few.size(); ++i) ASSERT_EQ(dithered[i], few[i]);
}

/// An image of one value for all pixels and channels.
Image flat(int width, int height, double value) {
  return {width, height,
          std::vector<float>(std::size_t{3} * static_cast<std::size_t>(width * height), static_cast<float>(value))};
}

// The mean of the codes over a flat region is the curve itself, which rounding loses. 1/5000 of a step is left to the
// 4096 pixels' offsets, which are not quite evenly spread, and 1/2000 to the table's chords.
TEST(Display, DitherKeepsTheMeanOfFlatRegions) {
  for (const double code : {0.1, 0.37, 0.5, 1.25, 7.9, 31.62, 117.5, 200.01, 254.4, 254.99}) {
    const double encoded = code / 255;
    const double linear = encoded <= 0.04045 ? encoded / 12.92 : std::pow((encoded + 0.055) / 1.055, 2.4);
    const Image image = flat(64, 64, linear);
    double sum = 0, low = 255, high = 0;
    for (const std::uint8_t c : to_srgb8(image, {})) {
      sum += c;
      low = std::min(low, c - code);
      high = std::max(high, c - code);
    }
    EXPECT_NEAR(sum / static_cast<double>(image.rgb.size()), code, 2e-3) << code;
    EXPECT_GT(low, -1) << code;
    EXPECT_LT(high, 1) << code;
    EXPECT_NE(std::round(code), code) << "rounding must lose something here";
  }
}

// Squares of 8x8 pixels are as bright as the whole, so that no pattern is large enough to be seen. Every such square of
// the lattice has less than 3 of its 64 pixels too many or too few; of independent offsets about half would have.
TEST(Display, DitherIsEvenInSmallSquares) {
  const double code = 100.3;
  const Image image = flat(256, 256, std::pow((code / 255 + 0.055) / 1.055, 2.4));
  const auto codes = to_srgb8(image, {});
  for (int y0 = 0; y0 < 256; y0 += 8)
    for (int x0 = 0; x0 < 256; x0 += 8) {
      double sum = 0;
      for (int y = y0; y < y0 + 8; ++y)
        for (int x = x0; x < x0 + 8; ++x) sum += codes[3 * static_cast<std::size_t>(256 * y + x)];
      ASSERT_NEAR(sum / 64, code, 3.0 / 64) << x0 << ", " << y0;
    }
}

TEST(Display, DitherLeavesGreyAndTheEndsAlone) {
  const auto grey = to_srgb8(flat(32, 32, 0.2), {});
  for (std::size_t i = 0; i < grey.size(); i += 3) {
    ASSERT_EQ(grey[i], grey[i + 1]);
    ASSERT_EQ(grey[i], grey[i + 2]);
  }
  const double infinity = std::numeric_limits<double>::infinity(), nan = std::numeric_limits<double>::quiet_NaN();
  for (const double dark : {0.0, -1.0, -infinity, nan})
    EXPECT_EQ(to_srgb8(flat(200, 200, dark), {}), std::vector<std::uint8_t>(std::size_t{3} * 200 * 200, 0)) << dark;
  for (const double bright : {1.0, 1.0001, 1e30, infinity})
    EXPECT_EQ(to_srgb8(flat(200, 200, bright), {}), std::vector<std::uint8_t>(std::size_t{3} * 200 * 200, 255));
}

}  // namespace
