#include "film/statistics.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>
#include <numeric>
#include <stdexcept>
#include <string>
#include <vector>

namespace glimt {
namespace {

constexpr double dark = 0.01;  // keeps relative errors finite where the reference is black

std::string size_text(const Image& image) { return std::to_string(image.width) + "x" + std::to_string(image.height); }

void require_finite(const Image& image, const char* which) {
  const auto bad = std::ranges::find_if(image.rgb, [](float v) { return !std::isfinite(v); });
  if (bad == image.rgb.end()) return;
  const auto pixel = static_cast<int>((bad - image.rgb.begin()) / 3);
  throw std::invalid_argument(std::string("the ") + which + " holds a value that is not finite, first at pixel (" +
                              std::to_string(pixel % image.width) + ", " + std::to_string(pixel / image.width) +
                              ") counted from 0 at the top left");
}

double mean_without_largest(std::vector<double>& errors, std::size_t left_out) {
  const auto kept = errors.end() - static_cast<std::ptrdiff_t>(left_out);
  if (kept == errors.begin()) return 0;
  if (left_out > 0) std::ranges::nth_element(errors, kept);
  return std::accumulate(errors.begin(), kept, 0.0) / static_cast<double>(kept - errors.begin());
}

/// The relative error square / of; 0 where both are 0, as in a black picture.
double ratio(double square, double of) { return square > 0 ? square / of : 0; }

/// The 99 % quantile of the ratio of two independent chi-square variables, each divided by its `degrees` of freedom
/// (Paulson's approximation, 1942). Infinite for so few degrees that nothing can be said.
double largest_ratio(double degrees) {
  if (!(degrees > 0)) return std::numeric_limits<double>::infinity();
  constexpr double z = 2.33;
  const double a = 2 / (9 * degrees), b = (1 - a) * (1 - a), c = b - z * z * a;
  if (!(c > 0)) return std::numeric_limits<double>::infinity();
  const double root = (b + std::sqrt(b * b - c * c)) / c;
  return root * root * root;
}

}  // namespace

double mean(const Image& image) {
  if (image.rgb.empty()) return 0;
  return std::accumulate(image.rgb.begin(), image.rgb.end(), 0.0) / static_cast<double>(image.rgb.size());
}

Comparison compare(const Image& x, const Image& reference) {
  if (x.width != reference.width || x.height != reference.height)
    throw std::invalid_argument("the images differ in size: " + size_text(x) + " against the reference's " +
                                size_text(reference));
  require_finite(x, "image");
  require_finite(reference, "reference");
  if (x.rgb.empty()) return {};

  const std::size_t pixels = x.rgb.size() / 3;
  std::vector<double> errors(pixels);
  double squares = 0, scaled = 0;
  const double mean_reference = mean(reference), scaled_floor = scaled_dark(mean_reference);
  for (std::size_t i = 0; i < pixels; ++i) {
    for (std::size_t c = 3 * i; c < 3 * i + 3; ++c) {
      const double r = reference.rgb[c];
      const double square = (x.rgb[c] - r) * (x.rgb[c] - r);
      squares += square;
      errors[i] += square / (r * r + dark) / 3;
      scaled += ratio(square, r * r + scaled_floor);
    }
  }

  Comparison result;
  result.mean = mean(x);
  result.mean_reference = mean_reference;
  result.bias = result.mean - result.mean_reference;
  result.rmse = std::sqrt(squares / static_cast<double>(x.rgb.size()));
  result.relmse = mean_without_largest(errors, 0);
  result.relmse_scaled = scaled / static_cast<double>(x.rgb.size());
  result.relmse999 = mean_without_largest(errors, (pixels + 999) / 1000);
  return result;
}

namespace {

constexpr int block_size = 8, part_size = 4;  // pixels

/// Sums over pixels for the estimates, before the factor for halves and pixels.
struct ErrorSums {
  double relmse = 0, scaled = 0, scaled_squares = 0;  ///< the last: squares of what each part adds to `scaled`

  void operator+=(const ErrorSums& other) {
    relmse += other.relmse;
    scaled += other.scaled;
    scaled_squares += other.scaled_squares;
  }
};

/// Means of the two halves at a pixel.
struct HalfMeans {
  std::array<double, 3> a, b;
};

/// A part of a block: those of 4x4 pixels that are in the picture. Values are ordered by row, pixel and channel.
struct BlockPart {
  static constexpr std::size_t row_values = 3 * part_size, values = row_values * part_size;
  int width = 0, height = 0;
  std::array<double, 3> sum{};
  std::array<double, values> own{}, low{},
      high{};  ///< mean of all samples; the lower and the higher of the halves' means

  /// The part whose upper left pixel is (x0, y0). means(pixel) gives HalfMeans; the first half has `share` of the
  /// samples.
  template <class Means>
  BlockPart(int picture_width, int picture_height, int x0, int y0, double share, Means means)
      : width(std::clamp(picture_width - x0, 0, part_size)), height(std::clamp(picture_height - y0, 0, part_size)) {
    for (int y = 0; y < height; ++y)
      for (int x = 0; x < width; ++x) {
        const HalfMeans halves = means((y0 + y) * picture_width + x0 + x);
        for (std::size_t c = 0; c < 3; ++c) {
          const double h0 = halves.a[c], h1 = halves.b[c], mean = share * h0 + (1 - share) * h1;
          const std::size_t k = static_cast<std::size_t>(y) * row_values + static_cast<std::size_t>(3 * x) + c;
          own[k] = mean, low[k] = std::min(h0, h1), high[k] = std::max(h0, h1);
          sum[c] += mean;
        }
      }
  }

  int pixels() const { return width * height; }

  /// The likely square of the radiance; see core/README.md, "Without a scale".
  double likely_square(std::size_t k, std::size_t c) const {
    const double around = pixels() > 1 ? (sum[c] - own[k]) / (pixels() - 1) : own[k];
    const double bright = std::max(around, low[k]);
    // A half that goes on from another picture may be negative.
    return own[k] < around / 2 ? std::max(low[k], 0.0) * std::max(high[k], 0.0) : bright * bright;
  }

  /// The part's sums; `block` is the mean of the block that holds it.
  ErrorSums errors(const std::array<double, 3>& block, double scaled_floor) const {
    std::array<double, 3> relmse{}, scaled{};
    for (std::size_t k = 0; k < values; k += 3)
      for (std::size_t c = 0; c < 3; ++c) {
        const double difference = high[k + c] - low[k + c], square = difference * difference;
        relmse[c] += square / (block[c] * block[c] + dark);
        scaled[c] += ratio(square, likely_square(k + c, c) + scaled_floor);
      }
    const double all = scaled[0] + scaled[1] + scaled[2];
    return {relmse[0] + relmse[1] + relmse[2], all, all * all};
  }
};

/// The sums of the block whose upper left pixel is (x, y).
ErrorSums errors_in(const Film& film, int x, int y, double scaled_floor) {
  const double n0 = film.half_samples(0), n1 = film.half_samples(1);
  const auto means = [&](int pixel) {
    HalfMeans halves{film.half_sum(pixel, 0), film.half_sum(pixel, 1)};
    for (std::size_t c = 0; c < 3; ++c) halves.a[c] /= n0, halves.b[c] /= n1;
    return halves;
  };
  const auto part = [&](int px, int py) {
    return BlockPart(film.width(), film.height(), px, py, n0 / (n0 + n1), means);
  };
  const std::array parts{part(x, y), part(x + part_size, y), part(x, y + part_size),
                         part(x + part_size, y + part_size)};
  std::array<double, 3> mean{};
  double pixels = 0;
  for (const BlockPart& p : parts) {
    for (std::size_t c = 0; c < 3; ++c) mean[c] += p.sum[c];
    pixels += p.pixels();
  }
  for (double& value : mean) value /= pixels;
  ErrorSums errors;
  for (const BlockPart& p : parts)
    if (p.pixels() > 0) errors += p.errors(mean, scaled_floor);
  return errors;
}

double mean_of(const Film& film) {
  double sum = 0;
  for (int pixel = 0; pixel < film.width() * film.height(); ++pixel)
    for (int h = 0; h < 2; ++h) {
      const auto radiance = film.half_sum(pixel, h);
      sum += radiance[0] + radiance[1] + radiance[2];
    }
  return sum / (3.0 * film.width() * film.height() * film.samples());
}

}  // namespace

double relmse_estimate(const Film& film) { return estimate_error(film).relmse; }

ErrorEstimate estimate_error(const Film& film) {
  if (film.half_samples(0) == 0 || film.half_samples(1) == 0) return {};
  const double n0 = film.half_samples(0), n1 = film.half_samples(1), n = n0 + n1;
  const double picture_mean = mean_of(film), scaled_floor = scaled_dark(picture_mean);
  const int block_rows = (film.height() + block_size - 1) / block_size;

  // One sum per row of blocks, added in order, gives the same value for any number of threads.
  std::vector<ErrorSums> rows(static_cast<std::size_t>(block_rows));
#pragma omp parallel for if (film.width() * film.height() > (1 << 16))
  for (int row = 0; row < block_rows; ++row)
    for (int x = 0; x < film.width(); x += block_size)
      rows[static_cast<std::size_t>(row)] += errors_in(film, x, row * block_size, scaled_floor);
  ErrorSums all;
  for (const ErrorSums& row : rows) all += row;
  const double per_value = (n0 * n1 / (n * n)) / (3.0 * film.width() * film.height());
  ErrorEstimate result{.relmse = all.relmse * per_value, .relmse_scaled = all.scaled * per_value};
  Unseen unseen = unseen_light(film, picture_mean);
  if (!(picture_mean > 0)) {
    // A black picture tells nothing about its error: light may not have been found yet.
    result.relmse_scaled = std::numeric_limits<double>::infinity();
    result.unseen = std::move(unseen);
    return result;
  }
  result.low = result.high = result.relmse_scaled;
  if (all.scaled > 0) {
    // The degrees of freedom are U - 2, with U as in core/README.md.
    const double spread = largest_ratio(3 * all.scaled * all.scaled / all.scaled_squares - 4);
    result.low /= spread;
    result.high *= spread;
  }
  const bool shows = unseen.relmse > std::min(result.high, 2 * result.relmse_scaled) - result.relmse_scaled;
  result.high += unseen.relmse;
  if (shows) result.unseen = std::move(unseen);
  return result;
}

std::vector<double> relative_weights(const Image& half0, const Image& half1, double share) {
  const double floor = scaled_dark(share * mean(half0) + (1 - share) * mean(half1));
  std::vector<double> weights(half0.rgb.size(), 0);
  if (!(floor > 0)) return weights;
  const auto rgb = [](const Image& image, int pixel) {
    const float* p = image.rgb.data() + 3 * static_cast<std::ptrdiff_t>(pixel);
    return std::array<double, 3>{p[0], p[1], p[2]};
  };
  for (int y0 = 0; y0 < half0.height; y0 += part_size)
    for (int x0 = 0; x0 < half0.width; x0 += part_size) {
      const BlockPart part(half0.width, half0.height, x0, y0, share, [&](int pixel) {
        return HalfMeans{rgb(half0, pixel), rgb(half1, pixel)};
      });
      for (int y = 0; y < part.height; ++y)
        for (int x = 0; x < part.width; ++x)
          for (std::size_t c = 0; c < 3; ++c)
            weights[3 * static_cast<std::size_t>((y0 + y) * half0.width + x0 + x) + c] =
                1 / (part.likely_square(
                         static_cast<std::size_t>(y) * BlockPart::row_values + static_cast<std::size_t>(3 * x) + c, c) +
                     floor);
    }
  return weights;
}

std::string trust_text(const ErrorEstimate& estimate) {
  if (!std::isfinite(estimate.relmse_scaled)) return "error unknown";
  std::array<char, 256> text{};
  if (estimate.is_bound())
    std::snprintf(text.data(), text.size(), "error at least %.3g: up to %.2g %% of the light may be missing (%s)",
                  estimate.relmse_scaled, 100 * estimate.unseen.flux, estimate.unseen.light.c_str());
  else if (std::isfinite(estimate.high))
    std::snprintf(text.data(), text.size(), "error %.3g (%.2g to %.2g in 95 of 100)", estimate.relmse_scaled,
                  estimate.low, estimate.high);
  else
    std::snprintf(text.data(), text.size(), "error %.3g, nearly all in a few pixels, so it may be far off",
                  estimate.relmse_scaled);
  return text.data();
}

}  // namespace glimt
