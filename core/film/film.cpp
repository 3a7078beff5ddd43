#include "film/film.h"

#include <algorithm>
#include <atomic>
#include <bit>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace glimt {
namespace {

constexpr std::uint64_t largest_sum = std::numeric_limits<std::int64_t>::max();

constexpr double magic = 0x1p52;  // adding it rounds to an integer, which is then in the lowest bits

/// value * scale, rounded to the nearest integer, for 0 <= value * scale < 2^52. The product is exact, because scale is
/// a power of two.
std::uint64_t units(float value, double scale) {
  return std::bit_cast<std::uint64_t>(value * scale + magic) - std::bit_cast<std::uint64_t>(magic);
}

/// Adds 1 to a counter that several threads share.
void count(std::uint64_t& counter) { std::atomic_ref(counter).fetch_add(1, std::memory_order_relaxed); }

/// Makes an image from f(pixel) -> array of three numbers, on several threads if the image is large.
template <class F>
Image make_image(int width, int height, F f) {
  const int pixels = width * height;
  const auto values = static_cast<std::size_t>(pixels) * 3;
  Image image{width, height, {}};
  image.rgb.reserve(values);
  use_huge_pages(image.rgb.data(), values * sizeof(float));
  image.rgb.resize(values);
#pragma omp parallel for if (pixels > (1 << 16))
  for (int i = 0; i < pixels; ++i) {
    const auto value = f(i);
    for (std::size_t c = 0; c < 3; ++c) image.rgb[3 * static_cast<std::size_t>(i) + c] = static_cast<float>(value[c]);
  }
  return image;
}

double reciprocal(int n) { return n > 0 ? 1.0 / n : 0.0; }

}  // namespace

Film::Film(int width, int height, double max_radiance, std::vector<Emitter> emitters)
    : width_(width), height_(height), emitters_(std::move(emitters)), by_chance_(chance_counters(emitters_.size())) {
  // Stays inside the range of float, with room for the fixed point on either side.
  const double brightest =
      max_radiance > 0 && std::isfinite(max_radiance) ? std::clamp(max_radiance, 1e-30, 1e30) : 1.0;
  scale_ = std::exp2(38 - std::ceil(std::log2(brightest)));
  for (auto& sums : sums_) sums.resize(3 * static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
  limit_bits_ = std::bit_cast<std::uint32_t>(static_cast<float>(magic / scale_));
}

void Film::add(int first_pixel, int half, std::span<const float> rgb) {
  std::uint64_t* sums = sums_[static_cast<std::size_t>(half)].data() + 3 * static_cast<std::size_t>(first_pixel);
  // As unsigned numbers, the bits of negative and non-finite floats are larger than those of the limit.
  std::uint32_t largest_bits = 0;
  for (const float value : rgb) largest_bits = std::max(largest_bits, std::bit_cast<std::uint32_t>(value));
  if (largest_bits >= limit_bits_) {
    for (std::size_t i = 0; i < rgb.size(); ++i) add_unusual(sums[i], rgb[i]);
    return;
  }
  std::uint64_t all_sums = 0;
  for (std::size_t i = 0; i < rgb.size(); ++i) {
    sums[i] += units(rgb[i], scale_);
    all_sums |= sums[i];
  }
  if (all_sums > largest_sum)
    for (std::size_t i = 0; i < rgb.size(); ++i)
      if (sums[i] > largest_sum) {
        sums[i] = largest_sum;
        count(saturated_);
      }
}

std::uint64_t Film::checked_units(float value) {
  if (!(value >= 0 && std::isfinite(value))) {
    count(invalid_);
    return 0;
  }
  const double scaled = value * scale_;  // an integer from 2^24 units on
  return scaled < magic ? units(value, scale_) : scaled < 0x1p63 ? static_cast<std::uint64_t>(scaled) : largest_sum + 1;
}

void Film::add_unusual(std::uint64_t& sum, float value) {
  const std::uint64_t added = checked_units(value);
  if (added > largest_sum - sum) count(saturated_);
  sum = std::min(sum + added, largest_sum);
}

void Film::add(int half, std::span<const Splat> splats) {
  std::uint64_t* const first = sums_[static_cast<std::size_t>(half)].data();
  const auto place = [&](std::size_t i) { return first + 3 * static_cast<std::size_t>(splats[i].pixel); };
  constexpr std::size_t ahead = 8;  // pixels are far apart in memory, so each is fetched before its addition
  for (std::size_t i = 0; i < splats.size(); ++i) {
    if (i + ahead < splats.size()) __builtin_prefetch(place(i + ahead), 1);
    std::uint64_t* sums = place(i);
    for (const float value : {splats[i].r, splats[i].g, splats[i].b}) {
      const std::uint64_t added = checked_units(value);
      const std::atomic_ref sum(*sums++);
      std::uint64_t before = sum.load(std::memory_order_relaxed);
      while (!sum.compare_exchange_weak(before, std::min(before + added, largest_sum), std::memory_order_relaxed)) {
      }
      if (added > largest_sum - before) count(saturated_);
    }
  }
}

void Film::add(const Film& other) {
  if (other.width_ != width_ || other.height_ != height_ || other.scale_ != scale_ ||
      other.by_chance_.size() != by_chance_.size())
    throw std::invalid_argument("films of different units");
  if (overlap_of(ranges_, other.ranges_)) throw std::invalid_argument("films with samples in common");
  for (std::size_t h = 0; h < 2; ++h)
    for (std::size_t i = 0; i < sums_[h].size(); ++i) {
      const std::uint64_t sum = sums_[h][i] + other.sums_[h][i];
      if (sum > largest_sum) count(saturated_);
      sums_[h][i] = std::min(sum, largest_sum);
    }
  for (const SampleRange& range : other.ranges_) add_range(ranges_, range);
  invalid_ += other.invalid_;
  saturated_ += other.saturated_;
  add_by_chance(other.by_chance_);
}

void Film::add_by_chance(std::span<const std::uint64_t> counters) {
  for (std::size_t i = 0; i < counters.size(); ++i)
    if (counters[i] != 0) std::atomic_ref(by_chance_[i]).fetch_add(counters[i], std::memory_order_relaxed);
}

Image Film::mean() const {
  const double factor = reciprocal(samples());
  return make_image(width_, height_, [&](int i) {
    const auto a = half_sum(i, 0), b = half_sum(i, 1);
    return std::array{(a[0] + b[0]) * factor, (a[1] + b[1]) * factor, (a[2] + b[2]) * factor};
  });
}

Image Film::half_mean(int h) const {
  const double factor = reciprocal(half_samples(h));
  return make_image(width_, height_, [&](int i) {
    const auto a = half_sum(i, h);
    return std::array{a[0] * factor, a[1] * factor, a[2] * factor};
  });
}

Image Film::standard_error() const {
  const double n0 = half_samples(0), n1 = half_samples(1);
  if (n0 == 0 || n1 == 0) {
    constexpr double unknown = std::numeric_limits<double>::infinity();
    return make_image(width_, height_, [&](int) { return std::array{unknown, unknown, unknown}; });
  }
  const double factor = std::sqrt(n0 * n1) / (n0 + n1);
  return make_image(width_, height_, [&](int i) {
    const auto a = half_sum(i, 0), b = half_sum(i, 1);
    std::array<double, 3> error{};
    for (std::size_t c = 0; c < 3; ++c) error[c] = factor * std::abs(a[c] / n0 - b[c] / n1);
    return error;
  });
}

}  // namespace glimt
