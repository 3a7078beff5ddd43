#include <cmath>
#include <string>
#include <utility>

#include "viewer/chart_view/chart_panel.h"
#include "viewer/widgets/widgets.h"

namespace glimt {
namespace {

std::string rays_text(int count) { return std::to_string(count) + (count == 1 ? " shadow ray" : " shadow rays"); }

void draw_answer(const ViewerState& state, Edits& edits) {
  const ShadowRayAdvice& advice = state.chart.advice->what;
  const ShadowRayModel& model = advice.model;
  const std::string spread = advice.low == advice.high ? ""
                                                       : " (quartiles " + std::to_string(advice.low) + " to " +
                                                             std::to_string(advice.high) + ")";
  heading((rays_text(advice.best) + " at each hit" + (advice.best == 1 ? " is best" : " are best") + spread).c_str());
  note_widget("advice.best." + std::to_string(advice.best));

  std::string others;
  for (const int count : {1, 4, 8, 30})
    if (count != advice.best)
      others += (others.empty() ? "" : ", ") + std::to_string(count) + ": " +
                percent(model.efficiency(count) / model.efficiency(advice.best));
  text_row("Efficiency", others, "Of other numbers, as a share of the best one's");
  const double error = model.error(1), seconds = model.seconds(1);
  text_row("Camera paths",
           percent(model.path_error / error) + " of noise, " + percent(model.path_seconds / seconds) + " of time",
           "With one shadow ray: what all else than shadow rays makes");
  text_row("A shadow ray",
           percent(model.ray_error / error) + " of noise, " + percent(model.ray_seconds / seconds) + " of time",
           "With M of them, the noise is divided by M and the time multiplied");
  Settings settings = state.scene.render;
  ButtonRow row(2);
  if (row.button("Use it", "advice.use", "Set this number of shadow rays", settings.shadow_rays != advice.best)) {
    settings.shadow_rays = advice.best;
    edits.edit(state).render = settings;
  }
}

}  // namespace

void draw_advice(const ViewerState& state, Edits& edits) {
  const ChartState& chart = state.chart;
  if (draw_measuring(chart, edits)) return;
  ButtonRow row(2);
  edits.advise |= row.button("Measure", "advice.measure",
                             "Render this view with 1 and with 4 shadow rays in turn, five seeds each, some five "
                             "seconds in all. The picture pauses meanwhile.",
                             !chart.making);
  if (!chart.advice) {
    muted_text(
        "More shadow rays make a path less noisy and slower. This measures both on the view, and finds where "
        "they balance.");
    return;
  }
  Scene measured = chart.advice->scene;
  measured.render.shadow_rays = state.scene.render.shadow_rays;
  draw_age(std::move(measured), state.scene);
  draw_answer(state, edits);
}

void draw_advice_plot(const ChartState& chart, const Rect& place) {
  std::vector<PlotPoint> curve, measured;
  if (chart.advice) {
    const ShadowRayModel& model = chart.advice->what.model;
    const double best = model.efficiency(chart.advice->what.best);
    constexpr int steps = 64;
    for (int i = 0; i <= steps; ++i) {
      const double rays = std::pow(most_shadow_rays, 1.0 * i / steps);
      curve.push_back({rays, model.efficiency(rays) / best});
    }
    for (const ShadowRayRun& run : chart.advice->what.runs)
      measured.push_back({1.0 * run.shadow_rays, 1 / (run.error * run.seconds) / best});
  }
  const Plot plot(place, {curve, measured});
  plot.draw_axes("shadow rays", "efficiency, 1 / (relMSE \u00D7 seconds), over the best");
  const CurveStyle style = curve_style(0), other = curve_style(1);
  plot.draw_thin(curve, style.colour);
  for (const PlotPoint& point : measured) plot.draw_curve({point}, style);
  if (chart.advice) plot.draw_curve({{1.0 * chart.advice->what.best, 1}}, {other.colour, {}, 3});
}

}  // namespace glimt
