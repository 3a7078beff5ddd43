#pragma once

#include <vector>

namespace glimt {

/// A value on a logarithmic axis: digit * 10^exponent.
struct LogTick {
  double value = 0;
  int digit = 1, exponent = 0;
  bool labelled = false;
};

/// Ticks between 10^first and 10^last: powers of ten are labelled, and 2 and 5 between them where there is room.
std::vector<LogTick> logarithmic_ticks(double first, double last);

}  // namespace glimt
