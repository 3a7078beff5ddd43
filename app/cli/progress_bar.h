#pragma once

#include <chrono>
#include <string>

#include "cli/render_loop.h"

namespace glimt {

/// One line of progress: share done, samples, speed, error and time left. It says "100 %" only once the goal is
/// reached.
std::string progress_text(const Progress& progress);

/// Shows progress on stderr in one line, rewritten in place at most ten times a second. The line is cleared at the end.
class ProgressBar {
 public:
  ~ProgressBar();
  void show(const Progress& progress) { show(progress.fraction, progress_text(progress)); }
  /// The same for other work, of which only the share done is known.
  void show(double fraction);

 private:
  void show(double fraction, const std::string& text);

  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
  std::chrono::steady_clock::time_point next_{};
  bool drawn_ = false;
};

}  // namespace glimt
