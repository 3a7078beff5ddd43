#include "viewer/chart_view/chart_panel.h"

#include <algorithm>
#include <string>

#include "viewer/widgets/style.h"
#include "viewer/widgets/widgets.h"

namespace glimt {
namespace {

constexpr float list_share = 0.44F, widest_list = 440;  ///< share of the panel; design units

std::vector<PlotPoint> points_of(const Curve& curve, ErrorKind kind, Across axis) {
  std::vector<PlotPoint> points;
  for (const RunPoint& p : curve.points)
    if (const auto error = error_of(p, kind))
      points.push_back({across(p, axis), *error, kind == ErrorKind::estimate && p.at_least});
  return points;
}

/// A curve as it is drawn.
struct Drawn {
  CurveStyle style;
  std::vector<PlotPoint> points, thin;
};

std::vector<Drawn> drawn_curves(const ChartState& chart) {
  std::vector<Drawn> drawn;
  for (const Curve& curve : chart.curves.all()) {
    if (!curve.shown) continue;
    const ErrorKind kind = error_kind(curve);
    Drawn& d = drawn.emplace_back(Drawn{curve_style(curve.id), points_of(curve, kind, chart.view.across), {}});
    if (kind == ErrorKind::reference) d.thin = points_of(curve, ErrorKind::estimate, chart.view.across);
  }
  return drawn;
}

/// Draws a few curves in each layer. Every layer has its own ImGui draw list, which holds at most 2^16 vertices.
void draw_in_layers(const Plot& plot, const Rect& place, const std::vector<Drawn>& drawn) {
  constexpr std::size_t in_one = 8;
  for (std::size_t first = 0; first < drawn.size(); first += in_one) {
    ImGui::SetCursorScreenPos({place.x, place.y});
    ImGui::BeginChild(("curves" + std::to_string(first)).c_str(), {place.width, place.height}, false,
                      ImGuiWindowFlags_NoInputs | ImGuiWindowFlags_NoBackground | ImGuiWindowFlags_NoDecoration);
    for (std::size_t i = first; i < std::min(first + in_one, drawn.size()); ++i) {
      plot.draw_thin(drawn[i].thin, drawn[i].style.colour);
      plot.draw_curve(drawn[i].points, drawn[i].style);
    }
    ImGui::EndChild();
  }
}

/// Draws the plot and returns the point under the mouse.
std::optional<PlotPoint> draw_error_plot(const ChartState& chart, const Rect& place) {
  const std::vector<Drawn> drawn = drawn_curves(chart);
  std::vector<std::vector<PlotPoint>> all;
  bool compared = false;
  for (const Drawn& d : drawn) {
    all.insert(all.end(), {d.points, d.thin});
    compared |= !d.thin.empty();
  }
  const Plot plot(place, all);
  plot.draw_axes(chart.view.across == Across::seconds ? "seconds" : "samples per pixel",
                 compared ? "relMSE to the reference; thin: as estimated" : "relMSE, estimated from two halves");
  plot.draw_guide(chart.view.across == Across::seconds ? "1/time (root: slope -1/2)" : "1/samples (root: slope -1/2)");
  if (chart.reference_fits)
    plot.draw_level(chart.reference->frame->estimate.relmse_scaled, "the reference's own error");
  draw_in_layers(plot, place, drawn);
  const auto pointer = plot.under_mouse();
  if (pointer) plot.draw_crosshair(*pointer);
  return pointer;
}

void draw_view_buttons(const ChartState& chart, Edits& edits) {
  ButtonRow row(5);
  const bool by_time = chart.view.across == Across::seconds, any = !chart.curves.all().empty();
  if (row.button(by_time ? "By samples###axis" : "By time###axis", "chart.axis",
                 "What the error is drawn against: time, or samples per pixel"))
    edits.chart_view = ChartView{true, by_time ? Across::samples : Across::seconds};
  edits.export_csv |= row.button("CSV", "chart.csv", "Every point, as a new file in the current folder", any);
  edits.export_svg |= row.button("SVG", "chart.svg", "The curves shown, as a new file in the current folder", any);
  edits.clear_chart |= row.button("Clear", "chart.clear", "Delete all curves", any);
  if (row.button("Hide", "chart.hide", "Hide the chart; curves go on growing. Key: C"))
    edits.chart_view = ChartView{false, chart.view.across};
}

bool tab(const char* label, const char* name, const char* tip) {
  const bool open = ImGui::BeginTabItem(label);
  note_widget(name);
  tooltip(tip);
  return open;
}

void draw_error_page(const ViewerState& state, const std::optional<PlotPoint>& pointer, Edits& edits) {
  draw_reference_controls(state, edits);
  draw_view_buttons(state.chart, edits);
  draw_curve_list(state.chart, pointer, edits);
}

}  // namespace

void draw_chart_panel(const ViewerState& state, const Rect& place, Edits& edits) {
  begin_fixed_window("chart", place, 12, 8);
  // The list is at the right in a wide panel and at the bottom of a tall one.
  const ImVec2 at = ImGui::GetCursorScreenPos(), free = ImGui::GetContentRegionAvail();
  const float gap = style::scaled(14);
  const bool wide = free.x > free.y;
  const float list = wide ? std::min(list_share * free.x, style::scaled(widest_list)) : free.y / 2;
  const Rect plot =
      wide ? Rect{at.x, at.y, free.x - list - gap, free.y} : Rect{at.x, at.y, free.x, free.y - list - gap};
  const ImVec2 list_at = wide ? ImVec2{at.x + free.x - list, at.y} : ImVec2{at.x, at.y + free.y - list};

  // The plot is drawn before the tabs, so it uses the page that was open in the last picture.
  enum Page { error, advice, families };
  ImGuiStorage& memory = *ImGui::GetStateStorage();
  const ImGuiID page = ImGui::GetID("page");
  std::optional<PlotPoint> pointer;
  switch (memory.GetInt(page)) {
    case advice:
      draw_advice_plot(state.chart, plot);
      break;
    case families:
      draw_families_plot(state, plot);
      break;
    default:
      pointer = draw_error_plot(state.chart, plot);
  }

  ImGui::SetCursorScreenPos(list_at);
  ImGui::BeginChild("pages", wide ? ImVec2{list, free.y} : ImVec2{free.x, list});
  if (ImGui::BeginTabBar("tabs")) {
    if (tab("Error", "chart.tab.error", "Error of every setting tried, against the time it took")) {
      draw_error_page(state, pointer, edits);
      memory.SetInt(page, error);
      ImGui::EndTabItem();
    }
    if (tab("Shadow rays", "chart.tab.advisor", "How many shadow rays pay in this scene")) {
      draw_advice(state, edits);
      memory.SetInt(page, advice);
      ImGui::EndTabItem();
    }
    if (tab("Families", "chart.tab.families", "Which light the remaining error is of: caustics or other")) {
      draw_families(state, edits);
      memory.SetInt(page, families);
      ImGui::EndTabItem();
    }
    ImGui::EndTabBar();
  }
  ImGui::EndChild();
  ImGui::End();
}

}  // namespace glimt
