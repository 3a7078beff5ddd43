#include "film/continuation.h"

#include <algorithm>
#include <cmath>

namespace glimt {
namespace {

constexpr int fit_size = 16;  ///< of a block, pixels
constexpr int most_samples = 64;
constexpr std::size_t most_bytes = std::size_t{128} << 20;

/// Sums over a block, for each channel, of products of the noise of both scenes.
struct NoiseSums {
  std::array<double, 3> both{}, old{};

  void operator+=(const NoiseSums& other) {
    for (std::size_t c = 0; c < 3; ++c) both[c] += other.both[c], old[c] += other.old[c];
  }
};

/// Blocks of pixels of an image, row by row.
struct Blocks {
  int across, down, width, height;

  explicit Blocks(const Image& image)
      : across((image.width + fit_size - 1) / fit_size),
        down((image.height + fit_size - 1) / fit_size),
        width(image.width),
        height(image.height) {}

  int count() const { return across * down; }

  /// f(index of a value) for all values of a block's pixels.
  template <class F>
  void each_value(int block, F f) const {
    const int x0 = block % across * fit_size, y0 = block / across * fit_size;
    for (int y = y0; y < std::min(y0 + fit_size, height); ++y)
      for (int x = x0; x < std::min(x0 + fit_size, width); ++x)
        for (std::size_t c = 0; c < 3; ++c)
          f(3 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x)) + c, c);
  }

  /// Sum over the up to eight blocks around a block, without itself.
  NoiseSums around(const std::vector<NoiseSums>& sums, int block) const {
    const int bx = block % across, by = block / across;
    NoiseSums all;
    for (int y = std::max(by - 1, 0); y <= std::min(by + 1, down - 1); ++y)
      for (int x = std::max(bx - 1, 0); x <= std::min(bx + 1, across - 1); ++x)
        if (x != bx || y != by)
          all += sums[static_cast<std::size_t>(y) * static_cast<std::size_t>(across) + static_cast<std::size_t>(x)];
    return all;
  }
};

/// Half the samples of a film whose first is number 0.
int in_half(int samples, std::size_t h) { return (samples + 1 - static_cast<int>(h)) / 2; }

}  // namespace

int FirstSamples::next(const Film& film) const {
  const SampleRanges& ranges = film.ranges();
  if (ranges.size() > 1 || (!ranges.empty() && ranges[0].first != 0)) return 0;
  const std::size_t entry =
      std::size_t{6} * sizeof(float) * static_cast<std::size_t>(film.width()) * static_cast<std::size_t>(film.height());
  if (!entries_.empty() && bytes() + entry > most_bytes) return 0;
  const int count = entries_.empty() ? 2 : 2 * entries_.rbegin()->first;
  return count > most_samples || film.samples() > count ? 0 : count;
}

void FirstSamples::look_at(const Film& film) {
  if (film.samples() == 0 || film.samples() != next(film)) return;
  entries_.emplace(film.samples(), HalfImages{film.half_mean(0), film.half_mean(1)});
}

std::size_t FirstSamples::bytes() const {
  std::size_t sum = 0;
  for (const auto& [samples, halves] : entries_) sum += 2 * halves[0].rgb.capacity() * sizeof(float);
  return sum;
}

Correction continue_from(const Film& before, const HalfImages& old, const HalfImages& now, int samples, double scale) {
  const HalfImages all{before.half_mean(0), before.half_mean(1)};
  const Blocks blocks(old[0]);
  std::vector<NoiseSums> sums(static_cast<std::size_t>(blocks.count()));
#pragma omp parallel for
  for (int block = 0; block < blocks.count(); ++block) {
    NoiseSums& sum = sums[static_cast<std::size_t>(block)];
    blocks.each_value(block, [&](std::size_t i, std::size_t c) {
      const double noise_now = now[0].rgb[i] - now[1].rgb[i], noise_old = old[0].rgb[i] - old[1].rgb[i];
      sum.both[c] += noise_now * noise_old;
      sum.old[c] += noise_old * noise_old;
    });
  }
  Correction correction;
  for (auto& half : correction) half.resize(old[0].rgb.size());
#pragma omp parallel for
  for (int block = 0; block < blocks.count(); ++block) {
    const NoiseSums sum = blocks.around(sums, block);
    std::array<double, 3> weight{};
    for (std::size_t c = 0; c < 3; ++c) weight[c] = sum.old[c] > 0 ? sum.both[c] / sum.old[c] : 0;
    for (std::size_t h = 0; h < 2; ++h) {
      const double units = scale * in_half(samples, h);
      blocks.each_value(block, [&](std::size_t i, std::size_t c) {
        const double difference = double{all[h].rgb[i]} - double{old[h].rgb[i]};
        correction[h][i] = std::llround(weight[c] * difference * units);
      });
    }
  }
  return correction;
}

Film corrected(const Film& film, const Correction& correction) {
  Film result = film;
  for (const int h : {0, 1}) {
    const auto sums = result.sums(h);
    const auto& added = correction[static_cast<std::size_t>(h)];
    for (std::size_t i = 0; i < sums.size(); ++i) sums[i] += static_cast<std::uint64_t>(added[i]);
  }
  return result;
}

}  // namespace glimt
