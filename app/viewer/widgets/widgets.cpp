#include "viewer/widgets/widgets.h"

#include <algorithm>
#include <cmath>

#include "viewer/widgets/style.h"

namespace glimt {
namespace {

/// Draws the frame of a slider, filled between two shares of its width. ImGui's own slider is drawn over it.
class Bar {
 public:
  Bar(double from, double to) {
    const ImVec2 low = ImGui::GetCursorScreenPos();
    const float width = ImGui::CalcItemWidth(), height = ImGui::GetFrameHeight(),
                round = ImGui::GetStyle().FrameRounding;
    ImDrawList& list = *ImGui::GetWindowDrawList();
    list.AddRectFilled(low, {low.x + width, low.y + height}, ImGui::GetColorU32(ImGuiCol_FrameBg), round);
    const auto at = [&](double share) { return low.x + width * static_cast<float>(std::clamp(share, 0.0, 1.0)); };
    const auto corners = from <= 0 ? ImDrawFlags_RoundCornersLeft : ImDrawFlags_RoundCornersNone;
    list.AddRectFilled({at(std::min(from, to)), low.y}, {at(std::max(from, to)), low.y + height}, style::fill, round,
                       corners);
    const float mark = std::min(at(to), low.x + width - style::scaled(2));
    list.AddRectFilled({mark, low.y}, {mark + style::scaled(2), low.y + height},
                       ImGui::GetColorU32(ImGuiCol_SliderGrab));

    ImGui::PushStyleColor(ImGuiCol_SliderGrab, IM_COL32_BLACK_TRANS);
    ImGui::PushStyleColor(ImGuiCol_SliderGrabActive, IM_COL32_BLACK_TRANS);
    ImGui::PushStyleColor(ImGuiCol_FrameBg, IM_COL32_BLACK_TRANS);
    ImGui::PushStyleColor(ImGuiCol_FrameBgHovered, IM_COL32(255, 255, 255, 12));
    ImGui::PushStyleColor(ImGuiCol_FrameBgActive, IM_COL32(255, 255, 255, 18));
    ImGui::PushStyleVar(ImGuiStyleVar_GrabMinSize, style::scaled(3));
  }
  ~Bar() {
    ImGui::PopStyleVar();
    ImGui::PopStyleColor(5);
  }
  Bar(const Bar&) = delete;
  Bar& operator=(const Bar&) = delete;
};

}  // namespace

bool slider(double& value, double low, double high, const char* format) {
  const Bar bar((0 - low) / (high - low), (value - low) / (high - low));
  const bool changed =
      ImGui::SliderScalar("##value", ImGuiDataType_Double, &value, &low, &high, format, ImGuiSliderFlags_AlwaysClamp);
  if (changed) value = std::clamp(value, low, high);  // ImGui rounds to the format's digits after it clamps
  return changed;
}

bool slider(int& value, int low, int high, bool logarithmic) {
  const double share = logarithmic ? std::log2(std::max(value, 1)) / std::log2(high)
                                   : static_cast<double>(value - low) / static_cast<double>(high - low);
  const Bar bar(0, share);
  const auto flags = logarithmic ? ImGuiSliderFlags_Logarithmic : ImGuiSliderFlags_None;
  return ImGui::SliderInt("##value", &value, low, high, "%d", flags | ImGuiSliderFlags_AlwaysClamp);
}

bool logarithmic_slider(double& value, double low, double high, const char* unit) {
  const Bar bar(0, std::log(std::max(value, low) / low) / std::log(high / low));
  // ImGui needs this many digits to tell the lowest value from 0.
  const int digits = static_cast<int>(std::ceil(-std::log10(low)));
  const std::string format = "%." + std::to_string(digits) + "g" + unit;
  const bool changed = ImGui::SliderScalar("##value", ImGuiDataType_Double, &value, &low, &high, format.c_str(),
                                           ImGuiSliderFlags_Logarithmic | ImGuiSliderFlags_AlwaysClamp);
  if (!changed) return false;
  if (ImGui::IsMouseDown(ImGuiMouseButton_Left)) {  // the mouse chooses two digits; other numbers can be typed
    const double place = std::pow(10, std::floor(std::log10(std::max(value, low))) - 1);
    value = std::round(value / place) * place;
  }
  value = std::clamp(value, low, high);
  return true;
}

void wrapped_text(const std::string& text) {
  ImGui::PushTextWrapPos(0);
  ImGui::TextUnformatted(text.c_str());
  ImGui::PopTextWrapPos();
}

void muted_text(const std::string& text) {
  ImGui::PushStyleColor(ImGuiCol_Text, style::muted);
  wrapped_text(text);
  ImGui::PopStyleColor();
}

void note_widget(const std::string& name) {
  if (auto* rects = static_cast<WidgetRects*>(ImGui::GetIO().UserData)) {
    const ImVec2 low = ImGui::GetItemRectMin(), size = ImGui::GetItemRectSize();
    (*rects)[name] = {low.x, low.y, size.x, size.y};
  }
}

void begin_fixed_window(const char* name, const Rect& place, float beside, float above, ImGuiWindowFlags flags) {
  ImGui::SetNextWindowPos({place.x, place.y});
  ImGui::SetNextWindowSize({place.width, place.height});
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {style::scaled(beside), style::scaled(above)});
  ImGui::Begin(name, nullptr,
               flags | ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoSavedSettings |
                   ImGuiWindowFlags_NoBringToFrontOnFocus);
  ImGui::PopStyleVar();
}

void heading(const char* text) {
  ImGui::Dummy({0, style::scaled(4)});
  ImGui::PushFont(style::heading_font());
  ImGui::TextUnformatted(text);
  ImGui::PopFont();
}

float row_split() { return ImGui::GetCursorStartPos().x + style::scaled(118); }

void begin_row(const std::string& label, std::string_view tip) {
  const float split = row_split();
  ImGui::AlignTextToFramePadding();
  ImGui::PushStyleColor(ImGuiCol_Text, style::muted);
  ImGui::TextUnformatted(fit_text(label, split - ImGui::GetCursorPosX() - style::scaled(4)).c_str());
  ImGui::PopStyleColor();
  tooltip(tip);
  ImGui::SameLine(split);
  ImGui::SetNextItemWidth(-FLT_MIN);
}

ButtonRow::ButtonRow(int columns) : columns_(columns) {
  const float gaps = static_cast<float>(columns - 1) * ImGui::GetStyle().ItemSpacing.x;
  width_ = (ImGui::GetContentRegionAvail().x - gaps) / static_cast<float>(columns);
}

bool ButtonRow::button(const char* label, const char* name, std::string_view tip, bool enabled) {
  if (count_++ % columns_ != 0) ImGui::SameLine();
  ImGui::BeginDisabled(!enabled);
  const bool pressed = ImGui::Button(label, {width_, 0});
  ImGui::EndDisabled();
  note_widget(name);
  tooltip(tip);
  return pressed;
}

void text_row(const std::string& label, const std::string& value, std::string_view tip) {
  ImGui::PushStyleColor(ImGuiCol_Text, style::muted);
  ImGui::TextUnformatted(label.c_str());
  ImGui::PopStyleColor();
  tooltip(tip);
  ImGui::SameLine(row_split());
  ImGui::TextUnformatted(value.c_str());
}

void place_beside_controls() {
  const ImVec2 window = ImGui::GetIO().DisplaySize, item = ImGui::GetItemRectMin();
  const Layout layout = make_layout(window.x, window.y, style::scaled(1));
  if (item.x >= layout.column.x) {
    ImGui::SetNextWindowPos({layout.column.x - style::scaled(8), item.y}, ImGuiCond_Always, {1, 0});
  } else {
    ImGui::SetNextWindowPos({item.x, std::min(item.y, layout.status.y) - style::scaled(8)}, ImGuiCond_Always, {0, 1});
  }
}

void tooltip(std::string_view tip) {
  if (tip.empty() || !ImGui::IsItemHovered(ImGuiHoveredFlags_AllowWhenDisabled)) return;
  place_beside_controls();
  ImGui::BeginTooltip();
  ImGui::PushTextWrapPos(style::scaled(280));
  ImGui::TextUnformatted(tip.data(), tip.data() + tip.size());
  ImGui::PopTextWrapPos();
  ImGui::EndTooltip();
}

std::string fit_text(const std::string& text, float width) {
  if (ImGui::CalcTextSize(text.c_str()).x <= width) return text;
  if (auto* rects = static_cast<WidgetRects*>(ImGui::GetIO().UserData)) (*rects)["cut." + text] = {};
  const std::string ellipsis = "...";
  const float room = width - ImGui::CalcTextSize(ellipsis.c_str()).x;
  const char* end = text.c_str();
  ImGui::GetFont()->CalcTextSizeA(ImGui::GetFontSize(), room, 0, text.c_str(), text.c_str() + text.size(), &end);
  return std::string(text.c_str(), end) + ellipsis;
}

}  // namespace glimt
