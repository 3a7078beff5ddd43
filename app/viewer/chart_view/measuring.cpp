#include <cmath>

#include "viewer/chart_view/chart_panel.h"
#include "viewer/widgets/widgets.h"

namespace glimt {

bool draw_measuring(const ChartState& chart, Edits& edits) {
  if (!chart.measuring) return false;
  muted_text("Measuring this view. The picture pauses meanwhile.");
  ImGui::ProgressBar(static_cast<float>(*chart.measuring), {-FLT_MIN, ImGui::GetFontSize() / 2}, "");
  ButtonRow row(2);
  edits.stop_measuring |= row.button("Stop", "measuring.stop", "Stop measuring");
  return true;
}

void draw_age(Scene measured, const Scene& shown) {
  measured.render.spp = shown.render.spp;
  measured.render.target_error = shown.render.target_error;
  if (measured == shown) return;
  muted_text("Measured before the last edit:");
  note_widget("measured.before");
}

std::string percent(double share) { return short_number(std::round(100 * share)) + " %"; }

}  // namespace glimt
