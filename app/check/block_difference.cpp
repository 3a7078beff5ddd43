#include "check/block_difference.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "film/statistics.h"

namespace glimt {
namespace {

constexpr int noise_block = 8, noise_cell = 2;  // pixels

/// A normal variable that is as unlikely as Student's t with so many degrees of freedom (Wallace, "Bounds on normal
/// approximations to Student's and the chi-square distributions", 1959): within 0.02 of the exact one.
double normal_of_t(double t, double degrees) {
  const double size = (8 * degrees + 1) / (8 * degrees + 3) * std::sqrt(degrees * std::log1p(t * t / degrees));
  return std::copysign(size, t);
}

/// What is beyond this in either direction has the probability `alpha`.
double normal_limit(double alpha) {
  double low = 0, high = 40;
  for (int i = 0; i < 60; ++i) {
    const double middle = (low + high) / 2;
    (std::erfc(middle / std::sqrt(2.0)) > alpha ? low : high) = middle;
  }
  return high;
}

/// Mean and its standard error of the difference in one channel of a block.
struct ChannelDifference {
  double mean = 0, error = 0;
  int cells = 0;

  double z() const {
    if (cells < 2) return 0;
    if (error > 0) return normal_of_t(mean / error, cells - 1);
    return mean == 0 ? 0 : std::copysign(40.0, mean);
  }
};

ChannelDifference in_block(const Image& a, const Image& b, int x0, int y0, int channel) {
  std::vector<double> cells;
  for (int cy = y0; cy < std::min(y0 + noise_block, a.height); cy += noise_cell)
    for (int cx = x0; cx < std::min(x0 + noise_block, a.width); cx += noise_cell) {
      double sum = 0;
      int pixels = 0;
      for (int y = cy; y < std::min(cy + noise_cell, a.height); ++y)
        for (int x = cx; x < std::min(cx + noise_cell, a.width); ++x, ++pixels)
          sum += double{a.pixel(x, y)[channel]} - double{b.pixel(x, y)[channel]};
      cells.push_back(sum / pixels);
    }
  const auto n = static_cast<double>(cells.size());
  ChannelDifference result{0, 0, static_cast<int>(cells.size())};
  for (const double cell : cells) result.mean += cell / n;
  double squares = 0;
  for (const double cell : cells) squares += (cell - result.mean) * (cell - result.mean);
  if (n > 1) result.error = std::sqrt(squares / (n - 1) / n);
  return result;
}

}  // namespace

PictureDifference difference_of(const Image& picture, const Image& reference) {
  const Comparison whole = compare(picture, reference);
  PictureDifference result;
  result.mean = whole.mean;
  result.mean_reference = whole.mean_reference;
  result.across = (picture.width + noise_block - 1) / noise_block;
  result.down = (picture.height + noise_block - 1) / noise_block;
  const int tests = 3 * result.across * result.down;
  const double limit = normal_limit(-std::expm1(std::log1p(-1e-3) / tests));  // for all together (Sidak 1967)
  double squares = 0, variance = 0;
  for (int by = 0; by < result.down; ++by)
    for (int bx = 0; bx < result.across; ++bx) {
      BlockDifference block;
      for (int c = 0; c < 3; ++c) {
        const ChannelDifference channel = in_block(picture, reference, bx * noise_block, by * noise_block, c);
        const double z = channel.z();
        squares += z * z;
        variance += channel.error * channel.error;
        if (std::abs(z) > std::abs(block.z)) block = {channel.mean, z};
      }
      if (std::abs(block.z) > limit) ++result.beyond;
      result.blocks.push_back(block);
    }
  result.mean_square_z = squares / tests;
  result.mean_error = std::sqrt(variance) / tests;
  return result;
}

}  // namespace glimt
