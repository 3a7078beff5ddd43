#pragma once

#include <optional>
#include <string>

#include "viewer/chart_view/plot.h"
#include "viewer/panels/panels.h"
#include "viewer/state/state.h"

namespace glimt {

/// The chart beside or below the picture: error against time of all that was tried, the advisor, the families of light.
void draw_chart_panel(const ViewerState& state, const Rect& place, Edits& edits);

// The panel's parts, drawn into the current ImGui window.

/// The reference's name, and buttons to make, open and drop one.
void draw_reference_controls(const ViewerState& state, Edits& edits);

/// Every curve with its error, time and efficiency: the latest ones, or those at the mouse.
void draw_curve_list(const ChartState& chart, const std::optional<PlotPoint>& pointer, Edits& edits);

/// How many shadow rays pay: the answer, and a plot of efficiency against their number.
void draw_advice(const ViewerState& state, Edits& edits);
void draw_advice_plot(const ChartState& chart, const Rect& place);

/// Which light the remaining error comes from: the answer, and a bar for each family.
void draw_families(const ViewerState& state, Edits& edits);
void draw_families_plot(const ViewerState& state, const Rect& place);

/// While a measurement runs, says so, draws a button to stop it, and returns true.
bool draw_measuring(const ChartState& chart, Edits& edits);
/// Says so if the measured scene differs from the one shown, in more than where rendering stops.
void draw_age(Scene measured, const Scene& shown);
/// A share in whole percent: "62 %".
std::string percent(double share);

}  // namespace glimt
