#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "film/large_memory.h"
#include "film/sample_range.h"
#include "kernel/entry/kernels.h"

namespace glimt {

/// Linear RGB, row by row from the top, three floats per pixel. Radiance is in W/(m^2 sr).
struct Image {
  int width = 0;
  int height = 0;
  std::vector<float> rgb;  ///< width * height * 3

  float* pixel(int x, int y) { return rgb.data() + 3 * (static_cast<std::size_t>(y) * width + x); }
  const float* pixel(int x, int y) const { return rgb.data() + 3 * (static_cast<std::size_t>(y) * width + x); }
};

/// Sums of radiance per pixel in two independent halves: sample 2k + h of a pixel is sample k of half h. Sums are
/// 64-bit fixed point. So the order of the samples does not change them, and rounding errors do not build up.
class Film {
 public:
  Film() = default;

  /// `max_radiance` is the brightest emission in the scene. A unit of the fixed point is 2^-38 of it, rounded up to a
  /// power of two. So each pixel of a half has room for 2^25 samples of that brightness. `emitters` are the scene's.
  Film(int width, int height, double max_radiance, std::vector<Emitter> emitters = {});

  int width() const { return width_; }
  int height() const { return height_; }
  /// The samples that every pixel has: how many, and which.
  int samples() const { return count_of(ranges_); }
  const SampleRanges& ranges() const { return ranges_; }
  /// Sets the first sample to take; 0 if this is not called.
  void go_on_from(int first) { from_ = first; }
  /// The samples to take next.
  SampleRange missing() const { return first_gap(ranges_, from_); }
  /// Records that every pixel has the first `count` of them.
  void finish_pass(int count) { add_range(ranges_, {missing().first, count}); }

  /// Adds one sample's radiance to each of a run of pixels; `rgb` has three floats per pixel. Negative and non-finite
  /// values add nothing and are counted in invalid(). Values and sums that are too large become the largest and are
  /// counted in saturated(). Threads may add to different pixels at the same time.
  void add(int first_pixel, int half, std::span<const float> rgb);
  /// The same for one pixel.
  void add(int pixel, int half, float r, float g, float b) { add(pixel, half, std::array{r, g, b}); }

  /// Adds the splats of a sample of that half, from any thread and in any order.
  void add(int half, std::span<const Splat> splats);

  /// Adds all samples of another film. Throws std::invalid_argument where the films share a sample or have sums in
  /// different units.
  void add(const Film& other);

  /// Adds what trace() counted for each emitter, from any thread.
  void add_by_chance(std::span<const std::uint64_t> counters);
  const std::vector<Emitter>& emitters() const { return emitters_; }
  /// See chance_counters().
  std::span<const std::uint64_t> by_chance() const { return by_chance_; }

  /// Counters that are 0 in a sound render.
  std::uint64_t invalid() const { return invalid_; }
  std::uint64_t saturated() const { return saturated_; }

  /// Number of samples that every pixel has in half h (0 or 1).
  int half_samples(int h) const { return half_count_of(ranges_, h); }
  /// Sum of the radiance samples of one pixel in half h, W/(m^2 sr).
  std::array<double, 3> half_sum(int pixel, int h) const {
    const std::uint64_t* sum = sums_[static_cast<std::size_t>(h)].data() + 3 * static_cast<std::size_t>(pixel);
    return {radiance(sum[0]), radiance(sum[1]), radiance(sum[2])};
  }

  /// Mean over all samples; black before the first.
  Image mean() const;
  /// Mean over the samples of half h (0 or 1); black where it has none.
  Image half_mean(int h) const;
  /// Standard error of mean(), estimated from the means h0 and h1 of the halves, which have n0 and n1 samples:
  /// |h0 - h1| sqrt(n0 n1) / (n0 + n1). Its square is an unbiased estimate of the variance of the mean, also for
  /// correlated samplers. One pixel's estimate is noisy (one degree of freedom). Infinite where a half has no sample.
  Image standard_error() const;

  /// For files: the sums of half h, three per pixel, in units of 1 / scale() and below 2^63.
  std::span<const std::uint64_t> sums(int h) const { return sums_[static_cast<std::size_t>(h)]; }
  std::span<std::uint64_t> sums(int h) { return sums_[static_cast<std::size_t>(h)]; }
  double scale() const { return scale_; }
  /// Sets what the sums hold after they were read from a file.
  void set_contents(const SampleRanges& ranges, std::uint64_t invalid, std::uint64_t saturated) {
    ranges_ = ranges;
    invalid_ = invalid;
    saturated_ = saturated;
  }

  /// Bytes of a pixel's sums.
  static constexpr std::size_t pixel_bytes = 2 * 3 * sizeof(std::uint64_t);
  /// Bytes that this film takes.
  std::size_t bytes() const {
    return sizeof(Film) + (sums_[0].capacity() + sums_[1].capacity()) * sizeof(std::uint64_t);
  }

 private:
  double radiance(std::uint64_t sum) const {
    return static_cast<double>(static_cast<std::int64_t>(sum)) * (1 / scale_);
  }
  /// The value in units of the fixed point. A value that does not fit becomes more than the largest sum. A value that
  /// is no radiance is counted and becomes 0.
  std::uint64_t checked_units(float value);
  void add_unusual(std::uint64_t& sum, float value);

  int width_ = 0;
  int height_ = 0;
  int from_ = 0;
  SampleRanges ranges_;
  double scale_ = 1;              ///< a power of two
  std::uint32_t limit_bits_ = 0;  ///< bits of the smallest float that units() cannot convert
  std::uint64_t invalid_ = 0;
  std::uint64_t saturated_ = 0;
  std::vector<Emitter> emitters_;
  std::vector<std::uint64_t> by_chance_;
  std::array<std::vector<std::uint64_t, ZeroedMemory<std::uint64_t>>, 2>
      sums_;  ///< for each half three per pixel, in units of 1/scale_, below 2^63
};

}  // namespace glimt
