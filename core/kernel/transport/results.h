#pragma once

#include <array>
#include <bit>

#include "math/vec.h"

namespace glimt {

/// Colours that lanes bring to numbered places, gathered without a loop over lanes, whose length could not be foretold.
template <class F>
class Results {
 public:
  /// Of the lanes in the mask. take(place, r, g, b) is called for all that wait once they are many.
  template <class Function>
  void add(const Vec3<F>& rgb, const Int<F>& place, const Mask<F>& mask, Function take) {
    const auto next = static_cast<std::size_t>(count_);
    compress<F, F>(rgb.x, mask, &r_[next]);
    compress<F, F>(rgb.y, mask, &g_[next]);
    compress<F, F>(rgb.z, mask, &b_[next]);
    compress<Int<F>, F>(place, mask, &place_[next]);
    count_ += std::popcount(bits(mask));
    if (count_ >= capacity) flush(take);
  }

  template <class Function>
  void flush(Function take) {
    for (std::size_t i = 0; i < static_cast<std::size_t>(count_); ++i) take(place_[i], r_[i], g_[i], b_[i]);
    count_ = 0;
  }

 private:
  static constexpr int capacity = 128;
  template <class T>
  using Array = std::array<T, capacity + 2 * lane_count<F>>;

  int count_ = 0;
  Array<float> r_, g_, b_;
  Array<std::int32_t> place_;
};

}  // namespace glimt
