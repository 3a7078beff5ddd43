#pragma once

#include <cstddef>
#include <vector>

#include "math/vec.h"

namespace glimt {

/// What the paths of a block have gathered, W/(m^2 sr), by their places. Each has three parts: its own; its tail, which
/// it shares (tail_sharing.h); and what comes with the tail but is for this path alone.
template <class F>
class PathSums {
 public:
  enum Part { own, tail, alone, parts };

  /// Nothing gathered yet. Memory is kept.
  void begin(int places) {
    places_ = places;
    sums_.assign(channels * parts * static_cast<std::size_t>(places), 0.0f);
  }

  int places() const { return places_; }
  /// Of all parts.
  std::size_t size() const { return sums_.size() / channels; }
  /// All of a channel, part by part.
  float* channel(int c) { return sums_.data() + static_cast<std::ptrdiff_t>(c) * parts * places_; }
  /// Adds a colour to a part, `place` + `places()` * part.
  void add(std::int32_t at, float r, float g, float b) {
    channel(0)[at] += r;
    channel(1)[at] += g;
    channel(2)[at] += b;
  }

  Vec3<F> load(Part part, int place) {
    const int at = part * places_ + place;
    return {glimt::load<F>(channel(0) + at), glimt::load<F>(channel(1) + at), glimt::load<F>(channel(2) + at)};
  }
  void store_own(const Vec3<F>& rgb, int place) {
    store(rgb.x, channel(0) + place);
    store(rgb.y, channel(1) + place);
    store(rgb.z, channel(2) + place);
  }

 private:
  static constexpr int channels = 3;
  int places_ = 0;
  std::vector<float> sums_;
};

}  // namespace glimt
