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
  constexpr int block = 8;
  const double n0 = film.half_samples(0), n1 = film.half_samples(1), n = n0 + n1;
  const int block_rows = (film.height() + block - 1) / block;
  const int block_columns = (film.width() + block - 1) / block;
  struct BlockSums {
    std::array<double, 3> radiance{}, squares{};  ///< sum of all samples; sum over pixels of (h0 - h1)^2
  };

  // One sum per row of blocks, added in order: the same value for any number of threads.
  std::vector<double> row_errors(static_cast<std::size_t>(block_rows));
#pragma omp parallel for if (film.width() * film.height() > (1 << 16))
  for (int row = 0; row < block_rows; ++row) {
    std::vector<BlockSums> blocks(static_cast<std::size_t>(block_columns));
    const int y0 = row * block, y1 = std::min(y0 + block, film.height());
    for (int y = y0; y < y1; ++y) {
      for (int x = 0; x < film.width(); ++x) {
        const auto a = film.half_sum(y * film.width() + x, 0), b = film.half_sum(y * film.width() + x, 1);
        BlockSums& sums = blocks[static_cast<std::size_t>(x / block)];
        for (std::size_t c = 0; c < 3; ++c) {
          const double difference = a[c] / n0 - b[c] / n1;
          sums.radiance[c] += a[c] + b[c];
          sums.squares[c] += difference * difference;
        }
      }
    }
    for (int column = 0; column < block_columns; ++column) {
      const BlockSums& sums = blocks[static_cast<std::size_t>(column)];
      const int block_pixels = (y1 - y0) * (std::min((column + 1) * block, film.width()) - column * block);
      for (std::size_t c = 0; c < 3; ++c) {
        const double m = sums.radiance[c] / (n * block_pixels);
        row_errors[static_cast<std::size_t>(row)] += sums.squares[c] / (m * m + dark);
      }
    }
  }
  const double total = std::accumulate(row_errors.begin(), row_errors.end(), 0.0);
  return total * (n0 * n1 / (n * n)) / (3.0 * film.width() * film.height());
}

}  // namespace glimt
