#include "chart/ticks.h"

#include <algorithm>
#include <cmath>

namespace glimt {

std::vector<LogTick> logarithmic_ticks(double first, double last) {
  std::vector<LogTick> ticks;
  const double decades = last - first;
  const int every = std::max(1, static_cast<int>(std::ceil(decades / 10)));
  for (int exponent = static_cast<int>(std::floor(first)); exponent <= last; ++exponent)
    for (int digit = 1; digit < 10; ++digit) {
      const double value = digit * std::pow(10, exponent);
      if (std::log10(value) < first || std::log10(value) > last) continue;
      const bool whole = digit == 1 && exponent % every == 0;
      const bool between = decades < 2 && (digit == 2 || digit == 5);
      if (whole || between || every == 1) ticks.push_back({value, digit, exponent, whole || between});
    }
  return ticks;
}

}  // namespace glimt
