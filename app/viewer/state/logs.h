#pragma once

#include <fstream>
#include <string>

#include "viewer/state/state.h"
#include "viewer/widgets/widgets.h"

namespace glimt {

/// Writes the logs for tests and measurements; see viewer.h.
class Logs {
 public:
  Logs();
  /// Call it when a picture of the window is on the screen.
  void picture(const ViewerState& state);
  /// Call it when the controls have been laid out.
  void laid_out(const WidgetRects& widgets);

 private:
  std::ofstream frames_;
  std::string widget_file_;
  std::string drawn_widgets_, told_widgets_;  ///< in the last picture, and in the file
};

}  // namespace glimt
