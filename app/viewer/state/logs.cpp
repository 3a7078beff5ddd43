#include "viewer/state/logs.h"

#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <sstream>

namespace glimt {
namespace {

std::string setting(const char* name) {
  const char* value = std::getenv(name);
  return value != nullptr ? value : "";
}

}  // namespace

Logs::Logs() : widget_file_(setting("GLIMT_WIDGET_LOG")) {
  if (const auto file = setting("GLIMT_FRAME_LOG"); !file.empty()) frames_.open(file);
}

void Logs::picture(const ViewerState& state) {
  if (!frames_.is_open() || !state.frame) return;
  const std::chrono::duration<double> now = std::chrono::system_clock::now().time_since_epoch();
  frames_ << std::fixed << now.count() << ' ' << state.frame->samples << ' ' << state.frame->finished << std::endl;
}

void Logs::laid_out(const WidgetRects& widgets) {
  if (widget_file_.empty()) return;
  std::ostringstream text;
  for (const auto& [name, r] : widgets)
    text << name << '\t' << r.x << ' ' << r.y << ' ' << r.width << ' ' << r.height << '\n';
  // A menu gets its place only in its second picture, so controls are logged once they stay where they are.
  const bool stands = text.str() == drawn_widgets_;
  drawn_widgets_ = text.str();
  if (!stands || drawn_widgets_ == told_widgets_) return;
  told_widgets_ = drawn_widgets_;
  std::ofstream(widget_file_ + ".part") << told_widgets_;
  std::filesystem::rename(widget_file_ + ".part", widget_file_);
}

}  // namespace glimt
