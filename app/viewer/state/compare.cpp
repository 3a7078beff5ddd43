#include "viewer/state/compare.h"

#include <algorithm>
#include <cmath>

namespace glimt {

bool same_size(const Image& a, const Image& b) { return a.width == b.width && a.height == b.height; }

Image difference(const Image& a, const Image& b) {
  Image result = a;
  for (std::size_t i = 0; i < result.rgb.size(); ++i) result.rgb[i] = std::abs(a.rgb[i] - b.rgb[i]);
  return result;
}

float relative_error(const float* a, const float* b) {
  constexpr float dark = 0.01F;  // as in relmse
  float sum = 0;
  for (int c = 0; c < 3; ++c) {
    const float d = a[c] - b[c];
    sum += d * d / (b[c] * b[c] + dark);
  }
  return std::sqrt(sum / 3);
}

Image relative_error(const Image& a, const Image& b) {
  Image result = a;
  for (std::size_t i = 0; i < result.rgb.size(); i += 3)
    std::fill_n(&result.rgb[i], 3, relative_error(&a.rgb[i], &b.rgb[i]));
  return result;
}

Pixel worst_pixel(const Image& a, const Image& b) {
  const Image error = relative_error(a, b);
  const auto worst = std::ranges::max_element(error.rgb) - error.rgb.begin();
  const auto pixel = static_cast<int>(worst / 3);
  return {pixel % error.width, pixel / error.width};
}

}  // namespace glimt
