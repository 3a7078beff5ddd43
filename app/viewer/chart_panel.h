#pragma once

#include <optional>

#include "viewer/panels.h"
#include "viewer/plot.h"
#include "viewer/state.h"

namespace glimt {

/// Error against time of all that was tried, and the advisor, beside or below the picture.
void draw_chart_panel(const ViewerState& state, const Rect& place, Edits& edits, Requests& requests);

// Its parts, drawn into the current ImGui window.

/// The reference: what it is, and buttons to make, open and drop one.
void draw_reference_controls(const ViewerState& state, Edits& edits, Requests& requests);

/// Every curve with its error, time and efficiency: those it has come to, or those under the mouse.
void draw_curve_list(const ChartState& chart, const std::optional<PlotPoint>& pointer, ChartEdits& edits);

/// How many shadow rays pay: the answer, and the efficiency against their number.
void draw_advice(const ViewerState& state, Edits& edits);
void draw_advice_plot(const ChartState& chart, const Rect& place);

}  // namespace glimt
