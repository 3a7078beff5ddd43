#include <cmath>
#include <string>

#include "viewer/chart_view/chart_panel.h"
#include "viewer/widgets/widgets.h"

namespace glimt {
namespace {

std::string error_text(const Frame& frame) {
  if (!std::isfinite(frame.estimate.relmse_scaled)) return "error unknown";
  return (frame.estimate.is_bound() ? "relMSE at least " : "relMSE ") + short_number(frame.estimate.relmse_scaled);
}

std::string what_it_is(const ChartState& chart) {
  if (chart.making)
    return "being made: " + short_number(chart.making->estimate.relmse_scaled) + " of " + short_number(chart.target);
  if (!chart.reference) return "none: errors are estimates";
  if (!chart.reference_fits) return chart.reference->name + ": of another scene or size";
  return chart.reference->name + ", " + error_text(*chart.reference->frame);
}

}  // namespace

void draw_reference_controls(const ViewerState& state, Edits& edits) {
  const ChartState& chart = state.chart;
  begin_row("Reference", "What errors are measured against. It must be of this scene and size; settings may differ.");
  ImGui::TextUnformatted(fit_text(what_it_is(chart), ImGui::GetContentRegionAvail().x).c_str());
  note_widget("reference.is");

  begin_row("Made to error",
            "Where rendering of a reference stops, in its own estimated relMSE. A tenth of the errors to be measured "
            "does.\nDrag, or Ctrl+click to type a number.");
  double target = chart.target;
  ImGui::PushID("target");
  if (logarithmic_slider(target, least_error, most_error, " relMSE")) edits.reference_target = target;
  note_widget("reference.target");
  ImGui::PopID();

  ButtonRow row(3);
  if (chart.making) {
    edits.use_reference_now |= row.button("Use as it is", "reference.use", "Stop, and measure against what there is");
    edits.stop_reference |= row.button("Stop", "reference.stop", "Stop, and throw it away");
    return;
  }
  edits.make_reference |=
      row.button("Make", "reference.make",
                 "Render this scene on with the best method, all its light and a seed of its own, until its error is "
                 "small enough. The picture pauses meanwhile, so that times stay true; edit as you like.",
                 !chart.measuring);
  if (row.button("Open\u2026", "reference.open",
                 "An EXR or PFM of this scene and size. It can also be dropped onto the chart"))
    edits.choose_file = FilePurpose::reference;
  edits.drop_reference |= row.button("Drop", "reference.drop", "Estimate errors again", chart.reference != nullptr);
}

}  // namespace glimt
