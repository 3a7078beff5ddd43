#include <imgui.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>

#include "viewer/panels/panels.h"
#include "viewer/widgets/field_widgets.h"
#include "viewer/widgets/labels.h"
#include "viewer/widgets/style.h"
#include "viewer/widgets/widgets.h"

namespace glimt {
namespace {

constexpr double widest_exposure = 8;  ///< of the slider, EV; more can be typed
constexpr const char* only_display = " Only the display changes, rendering goes on.";
constexpr std::string_view dither_key = "dither";

std::string number(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.3g", value);
  return text;
}

/// A check box at the end of a row; `field` chooses between on and off.
bool dither_switch(const Field<Display>& field, Display& display) {
  bool on = display.dither == Dither::on;
  ImGui::SameLine(0, style::scaled(8));
  const bool changed = ImGui::Checkbox(label_of(field.key).c_str(), &on);
  note_widget("display." + std::string(field.key));
  tooltip(sentence(field.doc) + "." + only_display);
  if (changed) display.dither = on ? Dither::on : Dither::off;
  return changed;
}

/// The view's colour scale.
void draw_legend(const Display& display) {
  ColourScale scale = colour_scale(display.view);
  if (display.view == View::samples) {
    draw_colour_scale("Samples", "Samples of each pixel", scale);
    return;
  }
  scale.low /= std::exp2(display.exposure);
  scale.high /= std::exp2(display.exposure);
  draw_colour_scale(
      "W/(m\u00B2 sr)",
      "Standard error of each pixel's radiance, mean of its channels, as seen from two halves of its samples", scale);
}

}  // namespace

void draw_colour_scale(const char* label, const char* tip, const ColourScale& scale) {
  begin_row(label, tip);
  const std::string low = number(scale.low), high = number(scale.high);
  const float gap = style::scaled(6);
  ImGui::TextUnformatted(low.c_str());
  ImGui::SameLine(0, gap);
  const ImVec2 at = ImGui::GetCursorScreenPos();
  const float width = ImGui::GetContentRegionAvail().x - ImGui::CalcTextSize(high.c_str()).x - gap;
  const float height = ImGui::GetFontSize();
  constexpr int steps = 64;
  for (int i = 0; i < steps; ++i) {
    const auto c = scale_colour((static_cast<float>(i) + 0.5F) / steps);
    ImGui::GetWindowDrawList()->AddRectFilled({at.x + width * static_cast<float>(i) / steps, at.y + style::scaled(5)},
                                              {at.x + width * static_cast<float>(i + 1) / steps, at.y + height},
                                              IM_COL32(c[0], c[1], c[2], 255));
  }
  ImGui::Dummy({width, height});
  note_widget("legend");
  ImGui::SameLine(0, gap);
  ImGui::TextUnformatted(high.c_str());
}

void draw_display_panel(const ViewerState& state, Edits& edits) {
  Display display = state.display;
  bool changed = false;
  for (const auto& field : display_fields()) {
    if (field.key == dither_key) continue;  // beside the exposure
    const std::string tip = sentence(field.doc) + "." + only_display;
    if (const auto* choice = std::get_if<Choice<Display>>(&field.member)) {
      int value = choice->get(display);
      if (edit_choice({"display." + std::string(field.key), field.key, tip}, choice->names, value)) {
        choice->set(display, value);
        changed = true;
      }
      continue;
    }
    begin_row(label_of(field.key), tip + "\nDrag, or Ctrl+click to type a number.");
    const auto dither = std::ranges::find(display_fields(), dither_key, &Field<Display>::key);
    const float box = ImGui::GetFrameHeight() + ImGui::GetStyle().ItemInnerSpacing.x +
                      ImGui::CalcTextSize(label_of(dither_key).c_str()).x + style::scaled(8);
    ImGui::SetNextItemWidth(ImGui::GetContentRegionAvail().x - box);
    ImGui::PushID("exposure");
    changed |= slider(display.exposure, -widest_exposure, widest_exposure, "%+.1f EV");
    note_widget("exposure");
    ImGui::PopID();
    changed |= dither_switch(*dither, display);
  }
  if (changed) edits.display = display;
  if (display.view != View::image) draw_legend(display);
}

}  // namespace glimt
