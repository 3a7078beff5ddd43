#include <algorithm>
#include <cctype>
#include <cmath>
#include <string>

#include "chart/materials.h"
#include "film/unseen.h"
#include "viewer/chart_view/chart_panel.h"
#include "viewer/widgets/style.h"
#include "viewer/widgets/widgets.h"

namespace glimt {
namespace {

constexpr ImU32 track = IM_COL32(255, 255, 255, 14);  ///< behind a bar, up to 100 %

ImU32 colour_of(std::size_t family) { return curve_style(family).colour; }

/// A row with the name at the left and the value at the right.
void family_row(const Family& family, std::size_t number) {
  const FamilyText& text = family_texts.at(number);
  const std::string spread = " (" + short_number(std::round(100 * family.low)) + " to " +
                             short_number(std::round(100 * family.high)) + ")",
                    value = percent(family.share) + spread;
  const float left = ImGui::GetCursorPosX(), line = ImGui::GetFontSize();
  const float right = left + ImGui::GetContentRegionAvail().x, at = right - ImGui::CalcTextSize(value.c_str()).x;
  const ImVec2 corner = ImGui::GetCursorScreenPos();
  ImGui::GetWindowDrawList()->AddRectFilled({corner.x, corner.y + 0.2F * line},
                                            {corner.x + 0.6F * line, corner.y + 0.8F * line}, colour_of(number));
  ImGui::SetCursorPosX(left + line);
  ImGui::TextUnformatted(fit_text(std::string(text.name), at - left - 1.5F * line).c_str());
  note_widget("families." + std::to_string(number));
  std::string tip(text.tip);
  if (family.pixels > 0)
    tip += " Each of its pixels has " + short_number(family.share / family.pixels) + " times the mean pixel's error.";
  tooltip(tip + " In brackets: quartiles over seeds.");
  ImGui::SameLine(at);
  ImGui::TextUnformatted(value.c_str());
}

void draw_answer(const Families& families) {
  const auto worst = std::ranges::max_element(families.all, {}, &Family::share) - families.all.begin();
  std::string name(family_texts.at(static_cast<std::size_t>(worst)).name);
  name[0] = static_cast<char>(std::tolower(name[0]));
  ImGui::PushTextWrapPos(0);
  heading((percent(families.all.at(static_cast<std::size_t>(worst)).share) + " of the error is " + name).c_str());
  ImGui::PopTextWrapPos();
  note_widget("families.answer." + std::to_string(worst));
  for (std::size_t i = 0; i < families.all.size(); ++i) family_row(families.all.at(i), i);
  muted_text("Measured to " + std::to_string(families.samples) + " samples per pixel.");
  note_widget("families.samples");
}

/// A track of length `width`, filled up to the share, with the value to its right. It is centred on a line of text.
void draw_bar(const ImVec2& at, float width, float height, double share, ImU32 colour, const std::string& value,
              ImU32 text) {
  ImDrawList& list = *ImGui::GetWindowDrawList();
  const float middle = at.y + ImGui::GetFontSize() / 2, top = middle - height / 2, bottom = middle + height / 2;
  list.AddRectFilled({at.x, top}, {at.x + width, bottom}, track);
  list.AddRectFilled({at.x, top}, {at.x + width * static_cast<float>(share), bottom}, colour);
  list.AddText({at.x + width + style::scaled(8), at.y}, text, value.c_str());
}

/// Names the light that no technique samples directly.
void draw_chance(const ViewerState& state) {
  const std::string light = state.compiled ? light_by_chance(state.compiled->emitters) : "";
  if (!light.empty()) muted_text("Chance alone finds: " + light + ".");
}

}  // namespace

void draw_families(const ViewerState& state, Edits& edits) {
  const ChartState& chart = state.chart;
  if (draw_measuring(chart, edits)) return;
  const bool several = has_specular(state.scene);
  ButtonRow row(2);
  edits.measure_families |= row.button(
      "Measure", "families.measure",
      "Render this view without caustics and its caustics alone in turn, five seeds each, some five seconds in "
      "all. The picture pauses meanwhile.",
      several && !chart.making);
  if (!several || !chart.families) {
    muted_text(
        "Noise is left by caustics and by other light, on matt surfaces and where a mirror or glass is seen. This "
        "measures how much by which, so that one sees what to work on.");
    draw_chance(state);
    return;
  }
  draw_age(chart.families->scene, state.scene);
  draw_answer(chart.families->what);
  draw_chance(state);
}

void draw_families_plot(const ViewerState& state, const Rect& place) {
  const float line = ImGui::GetFontSize();
  if (!has_specular(state.scene)) {
    ImGui::SetCursorScreenPos({place.x, place.y});
    ImGui::PushTextWrapPos(ImGui::GetCursorPosX() + place.width);
    ImGui::TextUnformatted("This scene has no mirrors and no glass: all of its light is one family.");
    ImGui::PopTextWrapPos();
    note_widget("families.one");
    return;
  }
  const auto& found = state.chart.families;
  const std::string widest = "100 % of the error";
  const float width = std::max(0.0F, place.width - ImGui::CalcTextSize(widest.c_str()).x - style::scaled(8));
  const float step = std::min(place.height / 4, 5 * line);
  for (std::size_t i = 0; i < family_texts.size(); ++i) {
    const ImVec2 at{place.x, place.y + static_cast<float>(i) * step};
    ImGui::SetCursorScreenPos(at);
    ImGui::Dummy({place.width, 3.2F * line});
    note_widget("families.bar." + std::to_string(i));
    tooltip(family_texts.at(i).tip);
    ImGui::GetWindowDrawList()->AddText(at, ImGui::GetColorU32(ImGuiCol_Text),
                                        fit_text(std::string(family_texts.at(i).name), place.width).c_str());
    const Family family = found ? found->what.all.at(i) : Family{};
    draw_bar({at.x, at.y + 1.2F * line}, width, 0.8F * line, family.share, colour_of(i),
             found ? percent(family.share) + " of the error" : "", ImGui::GetColorU32(ImGuiCol_Text));
    draw_bar({at.x, at.y + 2.2F * line}, width, 0.25F * line, family.pixels, style::muted,
             found ? percent(family.pixels) + " of pixels" : "", style::muted);
  }
}

}  // namespace glimt
