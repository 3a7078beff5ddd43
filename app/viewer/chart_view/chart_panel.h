#pragma once

#include <optional>
#include <string>

#include "viewer/chart_view/plot.h"
#include "viewer/panels/panels.h"
#include "viewer/state/state.h"

namespace glimt {

/// Error against time of all that was tried, the advisor and the families of light, beside or below the picture.
void draw_chart_panel(const ViewerState& state, const Rect& place, Edits& edits);

// Its parts, drawn into the current ImGui window.

/// The reference: what it is, and buttons to make, open and drop one.
void draw_reference_controls(const ViewerState& state, Edits& edits);

/// Every curve with its error, time and efficiency: those it has come to, or those under the mouse.
void draw_curve_list(const ChartState& chart, const std::optional<PlotPoint>& pointer, Edits& edits);

/// How many shadow rays pay: the answer, and the efficiency against their number.
void draw_advice(const ViewerState& state, Edits& edits);
void draw_advice_plot(const ChartState& chart, const Rect& place);

/// Which light the remaining error is of: the answer, and a bar for each family.
void draw_families(const ViewerState& state, Edits& edits);
void draw_families_plot(const ViewerState& state, const Rect& place);

/// While something is measured says so, with a button to stop it, and returns true.
bool draw_measuring(const ChartState& chart, Edits& edits);
/// Says so where what was measured is another scene than the one shown; where rendering stops does not count.
void draw_age(Scene measured, const Scene& shown);
/// A share as whole percent: "62 %".
std::string percent(double share);

}  // namespace glimt
