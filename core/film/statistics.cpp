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

/// A relative error; 0 where a black picture has none.
double ratio(double square, double of) { return square > 0 ? square / of : 0; }

/// 97.5 % of ratios of two independent chi-square variables, each over its `degrees` of freedom, are below this
/// (Paulson's approximation, 1942). Infinite for so few degrees that nothing can be said.
double largest_ratio(double degrees) {
  constexpr double z = 1.96;
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

constexpr int block_size = 8;

/// Of a block of pixels.
struct BlockSums {
  std::array<double, 3> radiance{};                                          ///< sum of all samples
  std::array<std::array<double, 3>, block_size * block_size / 4> squares{};  ///< by 2x2 squares: sum of (h0 - h1)^2
};

/// The blocks of one row of them, from pixel row y0 on.
std::vector<BlockSums> blocks_of(const Film& film, int y0) {
  std::vector<BlockSums> blocks(static_cast<std::size_t>((film.width() + block_size - 1) / block_size));
  const double n0 = film.half_samples(0), n1 = film.half_samples(1);
  for (int y = y0; y < std::min(y0 + block_size, film.height()); ++y)
    for (int x = 0; x < film.width(); ++x) {
      const auto a = film.half_sum(y * film.width() + x, 0), b = film.half_sum(y * film.width() + x, 1);
      BlockSums& sums = blocks[static_cast<std::size_t>(x / block_size)];
      const int square = (y - y0) / 2 * (block_size / 2) + x % block_size / 2;
      auto& squares = sums.squares[static_cast<std::size_t>(square)];
      for (std::size_t c = 0; c < 3; ++c) {
        const double difference = a[c] / n0 - b[c] / n1;
        sums.radiance[c] += a[c] + b[c];
        squares[c] += difference * difference;
      }
    }
  return blocks;
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
  struct RowSums {
    double relmse = 0, scaled = 0, scaled_squares = 0;
  };

  // One sum per row of blocks, added in order: the same value for any number of threads.
  std::vector<RowSums> rows(static_cast<std::size_t>(block_rows));
#pragma omp parallel for if (film.width() * film.height() > (1 << 16))
  for (int row = 0; row < block_rows; ++row) {
    RowSums& total = rows[static_cast<std::size_t>(row)];
    const int height = std::min(block_size, film.height() - row * block_size);
    int x = 0;
    for (const BlockSums& sums : blocks_of(film, row * block_size)) {
      const double samples = n * height * std::min(block_size, film.width() - x);
      x += block_size;
      for (const auto& squares : sums.squares) {
        double scaled = 0;
        for (std::size_t c = 0; c < 3; ++c) {
          const double m = sums.radiance[c] / samples;
          total.relmse += squares[c] / (m * m + dark);
          scaled += ratio(squares[c], m * m + scaled_floor);
        }
        total.scaled += scaled;
        total.scaled_squares += scaled * scaled;
      }
    }
  }
  RowSums all;
  for (const RowSums& row : rows) {
    all.relmse += row.relmse;
    all.scaled += row.scaled;
    all.scaled_squares += row.scaled_squares;
  }
  const double per_value = (n0 * n1 / (n * n)) / (3.0 * film.width() * film.height());
  ErrorEstimate result{.relmse = all.relmse * per_value, .relmse_scaled = all.scaled * per_value};
  Unseen unseen = unseen_light(film, picture_mean);
  if (!(picture_mean > 0)) {
    // A black picture tells nothing: its light may not have been found yet.
    result.relmse_scaled = std::numeric_limits<double>::infinity();
    result.unseen = std::move(unseen);
    return result;
  }
  result.low = result.high = result.relmse_scaled;
  if (all.scaled > 0) {
    // The degrees of freedom of S, the sum of squares e of one degree each: 3 S^2 / sum e^2 - 2 (core/README.md).
    const double spread = largest_ratio(3 * all.scaled * all.scaled / all.scaled_squares - 2);
    result.low /= spread;
    result.high *= spread;
  }
  if (unseen.relmse > std::min(result.high, 2 * result.relmse_scaled) - result.relmse_scaled)
    result.unseen = std::move(unseen);
  return result;
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
