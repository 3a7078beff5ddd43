#include "chart/relative_weights.h"

#include <algorithm>

#include "film/statistics.h"

namespace glimt {

std::vector<double> relative_weights(const Image& picture) {
  constexpr int block = 8;
  const double dark = scaled_dark(mean(picture));
  std::vector<double> weights(picture.rgb.size(), 0);
  if (!(dark > 0)) return weights;
  for (int y0 = 0; y0 < picture.height; y0 += block)
    for (int x0 = 0; x0 < picture.width; x0 += block) {
      const int y1 = std::min(y0 + block, picture.height), x1 = std::min(x0 + block, picture.width);
      for (std::size_t c = 0; c < 3; ++c) {
        double sum = 0;
        for (int y = y0; y < y1; ++y)
          for (int x = x0; x < x1; ++x) sum += static_cast<double>(picture.pixel(x, y)[c]);
        const double m = sum / ((y1 - y0) * (x1 - x0));
        for (int y = y0; y < y1; ++y)
          for (int x = x0; x < x1; ++x)
            weights[3 * static_cast<std::size_t>(y * picture.width + x) + c] = 1 / (m * m + dark);
      }
    }
  return weights;
}

}  // namespace glimt
