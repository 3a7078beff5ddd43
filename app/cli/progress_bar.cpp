#include "cli/progress_bar.h"

#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace glimt {
namespace {

constexpr const char* clear_line = "\r\x1b[K";
constexpr auto interval = std::chrono::milliseconds(100);
constexpr std::size_t bar_width = 20;

std::string time_text(double seconds) {
  if (!(seconds < 1e6)) return "-";
  const long whole = std::lround(seconds);
  char text[32];
  if (whole < 3600)
    std::snprintf(text, sizeof text, "%ld:%02ld", whole / 60, whole % 60);
  else
    std::snprintf(text, sizeof text, "%ld:%02ld:%02ld", whole / 3600, whole / 60 % 60, whole % 60);
  return text;
}

std::size_t terminal_width() {
  winsize size{};
  return ioctl(STDERR_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 0 ? size.ws_col : 80;
}

/// " 42 % [########............]"
std::string bar_text(double fraction) {
  const int percent = fraction >= 1 ? 100 : std::min(99, static_cast<int>(100 * fraction));
  std::string bar(bar_width, '.');
  std::fill_n(bar.begin(), static_cast<std::size_t>(percent) * bar_width / 100, '#');
  char text[40];
  std::snprintf(text, sizeof text, "%3d %% [%s]", percent, bar.c_str());
  return text;
}

}  // namespace

std::string progress_text(const Progress& progress) {
  char error[32] = "-";
  if (std::isfinite(progress.relmse_scaled))
    std::snprintf(error, sizeof error, "%s%.2e", progress.at_least ? "at least " : "", progress.relmse_scaled);
  char text[200];
  std::snprintf(text, sizeof text, "%s %d spp, %.1f Mpaths/s, error %s, ETA %s", bar_text(progress.fraction).c_str(),
                progress.samples, progress.paths_per_second / 1e6, error, time_text(progress.seconds_left).c_str());
  return text;
}

ProgressBar::~ProgressBar() {
  if (drawn_) std::fputs(clear_line, stderr);
}

void ProgressBar::show(double fraction) {
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
  show(fraction, bar_text(fraction) + " ETA " + time_text(fraction > 0 ? seconds * (1 / fraction - 1) : 1e9));
}

void ProgressBar::show(double fraction, const std::string& text) {
  const auto now = std::chrono::steady_clock::now();
  if (now < next_ && fraction < 1) return;
  next_ = now + interval;
  drawn_ = true;
  std::fprintf(stderr, "%s%s", clear_line, text.substr(0, terminal_width() - 1).c_str());
  std::fflush(stderr);
}

}  // namespace glimt
