#include "film/statistics.h"

#include <algorithm>
#include <cmath>
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
  double squares = 0;
  for (std::size_t i = 0; i < pixels; ++i) {
    for (std::size_t c = 3 * i; c < 3 * i + 3; ++c) {
      const double r = reference.rgb[c];
      const double square = (x.rgb[c] - r) * (x.rgb[c] - r);
      squares += square;
      errors[i] += square / (r * r + dark) / 3;
    }
  }

  Comparison result;
  result.mean = mean(x);
  result.mean_reference = mean(reference);
  result.bias = result.mean - result.mean_reference;
  result.rmse = std::sqrt(squares / static_cast<double>(x.rgb.size()));
  result.relmse = mean_without_largest(errors, 0);
  result.relmse999 = mean_without_largest(errors, (pixels + 999) / 1000);
  return result;
}

double relmse_estimate(const Film& film) {
  if (film.samples() < 2) return std::numeric_limits<double>::infinity();
  constexpr int reach = 3;  // pixels of the block to each side of its middle
  const int width = film.width(), height = film.height();
  const auto values = 3 * static_cast<std::size_t>(width);
  const double n0 = film.half_samples(0), n1 = film.half_samples(1), n = n0 + n1;
  const Image mean = film.mean();
  const auto around = [](int at, int size) { return std::min(at + reach + 1, size) - std::max(at - reach, 0); };
  std::vector<double> shares(values);  // of one of the block's columns in it
  for (std::size_t i = 0; i < values; ++i) shares[i] = 1.0 / around(static_cast<int>(i / 3), width);

  // One sum per row, added in order: the same value for any number of threads.
  std::vector<double> row_errors(static_cast<std::size_t>(height));
#pragma omp parallel if (width * height > (1 << 16))
  {
    // Sums over the block's rows, with black pixels before and behind.
    std::vector<double> columns(values + std::size_t{6} * reach), squares(values);
#pragma omp for
    for (int y = 0; y < height; ++y) {
      std::ranges::fill(columns, 0.0);
      for (int row = std::max(y - reach, 0); row < std::min(y + reach + 1, height); ++row)
        for (std::size_t i = 0; i < values; ++i) columns[i + 3 * reach] += static_cast<double>(mean.pixel(0, row)[i]);
      for (int x = 0; x < width; ++x) {
        const auto a = film.half_sum(y * width + x, 0), b = film.half_sum(y * width + x, 1);
        for (std::size_t c = 0; c < 3; ++c) {
          const double difference = a[c] / n0 - b[c] / n1;
          squares[3 * static_cast<std::size_t>(x) + c] = difference * difference;
        }
      }
      const double rows = around(y, height);
      double row_error = 0;
#pragma omp simd reduction(+ : row_error)
      for (std::size_t i = 0; i < values; ++i) {
        double sum = 0;
        for (std::size_t k = 0; k <= 2 * reach; ++k) sum += columns[i + 3 * k];
        const double m = sum * shares[i] / rows;
        row_error += squares[i] / (m * m + dark);
      }
      row_errors[static_cast<std::size_t>(y)] = row_error;
    }
  }
  const double total = std::accumulate(row_errors.begin(), row_errors.end(), 0.0);
  return total * (n0 * n1 / (n * n)) / (3.0 * width * height);
}

}  // namespace glimt
