#include <array>
#include <string>

#include "viewer/chart_view/chart_panel.h"
#include "viewer/widgets/style.h"
#include "viewer/widgets/widgets.h"

namespace glimt {
namespace {

constexpr float sample_width = 30, number_width = 62, cross_width = 20;  ///< design units

/// Where the parts of a row begin and end, screen coordinates.
struct Columns {
  float sample, label, label_end;
  std::array<float, 3> numbers;  ///< right ends
  float cross;

  Columns() {
    const float left = ImGui::GetCursorScreenPos().x, right = left + ImGui::GetContentRegionAvail().x;
    sample = left;
    label = left + style::scaled(sample_width + 8);
    cross = right - style::scaled(cross_width);
    for (std::size_t i = 0; i < numbers.size(); ++i)
      numbers[i] = cross - style::scaled(number_width * static_cast<float>(numbers.size() - 1 - i) + 6);
    label_end = numbers[0] - style::scaled(number_width);
  }
};

void text_to_right(float right, float y, ImU32 colour, const std::string& text) {
  const float width = ImGui::CalcTextSize(text.c_str()).x;
  ImGui::GetWindowDrawList()->AddText({right - width, y}, colour, text.c_str());
}

constexpr const char* dash = "\u2013";

std::string number(const std::optional<double>& value) { return value ? short_number(*value) : dash; }

/// "4.2x"; from a thousand on "1.1e3x".
std::string ratio_text(double ratio) {
  char text[32];
  std::snprintf(text, sizeof text, "%.1e", ratio);
  std::string large = text;
  if (const auto plus = large.find("e+0"); plus != std::string::npos) large.erase(plus + 1, 2);
  return (ratio < 1000 ? short_number(ratio) : large) + "\u00D7";
}

/// A curve's error, time or samples, and efficiency, as text.
std::array<std::string, 3> numbers_of(const ChartState& chart, const Curve& curve,
                                      const std::optional<PlotPoint>& pointer) {
  const ErrorKind kind = error_kind(curve);
  const Across axis = chart.view.across;
  const RunPoint& last = curve.points.back();
  const auto error = pointer ? error_at(curve, kind, axis, pointer->x) : error_of(last, kind);
  const auto place = pointer ? place_of(curve, kind, axis, pointer->y) : across(last, axis);
  const Curve* base = chart.curves.base();
  if (base == &curve) return {number(error), number(place), "base"};
  const bool at_time = pointer && axis == Across::seconds;
  const auto ratio = efficiency_ratio(curve, *base, at_time ? std::optional(pointer->x) : std::nullopt);
  return {number(error), number(place), ratio ? ratio_text(*ratio) : dash};
}

void draw_head(const ChartState& chart, const std::optional<PlotPoint>& pointer) {
  const Columns columns;
  const float y = ImGui::GetCursorScreenPos().y;
  const bool by_time = chart.view.across == Across::seconds;
  const std::string at = pointer ? "At " + short_number(pointer->x) + (by_time ? " s" : " spp") + ", " +
                                       short_number(pointer->y) + " relMSE"
                                 : "So far";
  ImGui::GetWindowDrawList()->AddText({columns.sample, y}, style::muted, at.c_str());
  const std::array<const char*, 3> heads{"relMSE", by_time ? "seconds" : "samples", "efficiency"};
  // While the mouse is on the plot, its place is written instead of the first head.
  for (std::size_t i = pointer ? 1 : 0; i < heads.size(); ++i)
    text_to_right(columns.numbers.at(i), y, style::muted, heads.at(i));
  ImGui::Dummy({0, ImGui::GetFontSize()});
}

void draw_row(const ChartState& chart, const Curve& curve, std::size_t index, const std::optional<PlotPoint>& pointer,
              Edits& edits) {
  const Columns columns;
  const std::string name = "curve." + std::to_string(index);
  const float height = ImGui::GetFontSize() + style::scaled(5), y = ImGui::GetCursorScreenPos().y;
  const float text = y + (height - ImGui::GetFontSize()) / 2;
  ImGui::PushID(static_cast<int>(curve.id));
  const auto part = [&](const char* id, float from, float to, const char* note, const std::string& tip) {
    ImGui::SetCursorScreenPos({from, y});
    const bool pressed = ImGui::InvisibleButton(id, {to - from, height});
    if (ImGui::IsItemVisible()) note_widget(name + "." + note);
    tooltip(tip);
    return pressed;
  };
  if (part("sample", columns.sample, columns.label - style::scaled(4), "show", "Hide or show this curve"))
    (curve.shown ? edits.hide_curve : edits.show_curve) = curve.id;
  CurveStyle style = curve_style(curve.id);
  if (!curve.shown) style.colour = IM_COL32(80, 84, 92, 255);
  draw_sample({columns.sample, y, style::scaled(sample_width), height}, style);

  const bool told = error_of(curve.points.back(), error_kind(curve)).has_value();
  const char* const unknown =
      "\nNot comparable: its picture has no light yet, or an error too small for its two halves to tell";
  if (part("label", columns.label, columns.numbers.back(), "base",
           curve.label + (told ? "" : unknown) + "\nClick: efficiencies are told as multiples of this one's"))
    edits.base_curve = curve.id;
  const bool current = &curve == chart.curves.current();
  const ImU32 colour = !curve.shown ? style::muted : current ? style::outline : ImGui::GetColorU32(ImGuiCol_Text);
  ImGui::GetWindowDrawList()->AddText({columns.label, text}, colour,
                                      fit_text(curve.label, columns.label_end - columns.label).c_str());
  const auto numbers = numbers_of(chart, curve, pointer);
  for (std::size_t i = 0; i < numbers.size(); ++i) text_to_right(columns.numbers.at(i), text, colour, numbers.at(i));

  if (part("delete", columns.cross, columns.cross + style::scaled(cross_width), "delete", "Delete this curve"))
    edits.remove_curve = curve.id;
  const ImU32 cross = ImGui::IsItemHovered() ? style::error : style::muted;
  text_to_right(columns.cross + style::scaled(14), text, cross, "\u00D7");
  ImGui::PopID();
}

}  // namespace

void draw_curve_list(const ChartState& chart, const std::optional<PlotPoint>& pointer, Edits& edits) {
  if (chart.curves.all().empty()) {
    muted_text("A curve begins with the second sample of every pixel.");
    return;
  }
  draw_head(chart, pointer);
  ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, {0, 0});
  ImGui::BeginChild("curves");
  for (std::size_t i = 0; i < chart.curves.all().size(); ++i) draw_row(chart, chart.curves.all()[i], i, pointer, edits);
  ImGui::EndChild();
  ImGui::PopStyleVar();
}

}  // namespace glimt
