#include "viewer/picture/compare_layer.h"

#include <imgui.h>

#include <algorithm>
#include <string>
#include <utility>

#include "viewer/state/compare_actions.h"
#include "viewer/widgets/style.h"
#include "viewer/widgets/widgets.h"

namespace glimt {
namespace {

/// A label over the picture, left or right of x.
void draw_label(const std::string& text, float x, float y, bool to_left) {
  const ImVec2 size = ImGui::CalcTextSize(text.c_str()), pad{style::scaled(8), style::scaled(4)};
  const float left = to_left ? x - size.x - 2 * pad.x : x;
  ImDrawList& list = *ImGui::GetBackgroundDrawList();
  list.AddRectFilled({left, y}, {left + size.x + 2 * pad.x, y + size.y + 2 * pad.y}, IM_COL32(15, 16, 18, 205),
                     style::scaled(4));
  list.AddText({left + pad.x, y + pad.y}, ImGui::GetColorU32(ImGuiCol_Text), text.c_str());
}

/// The visible part of the picture.
Rect visible(const Rect& picture, const Rect& area) {
  const float x = std::max(picture.x, area.x), y = std::max(picture.y, area.y);
  return {x, y, std::min(picture.x + picture.width, area.x + area.width) - x,
          std::min(picture.y + picture.height, area.y + area.height) - y};
}

float line_of(const ViewerState& state, const Rect& seen, const PicturePlace& picture) {
  return std::clamp(picture.rect.x + state.compare.line * picture.rect.width, seen.x, seen.x + seen.width);
}

}  // namespace

std::shared_ptr<const Frame> CompareLayer::compared(const std::shared_ptr<const Frame>& a,
                                                    const std::shared_ptr<const Frame>& b, CompareView view) {
  if (a == a_ && b == b_ && view == view_) return result_;
  // A preview has fewer pixels, so the last comparison stays.
  if (!same_size(a->mean, b->mean)) return result_;
  auto result = std::make_shared<Frame>();
  result->size = a->size;
  if (view == CompareView::difference)
    result->mean = difference(a->mean, b->mean);
  else
    result->error = relative_error(a->mean, b->mean);
  a_ = a;
  b_ = b;
  view_ = view;
  return result_ = std::move(result);
}

void CompareLayer::draw(const ViewerState& state, const Rect& area, const PicturePlace& picture) {
  const CompareView view = state.compare.view;
  if (view == CompareView::off || !state.frame) return;
  if (const std::string obstacle = obstacle_to_compare(state); !obstacle.empty()) {
    const Rect seen = visible(picture.rect, area);
    draw_label(obstacle, seen.x + style::scaled(8), seen.y + style::scaled(8), false);
    return;
  }
  const Held b = picture_b(state);
  const Rect seen = visible(picture.rect, area);
  Display display = state.display;
  display.view = View::image;
  const float top = seen.y + style::scaled(8), gap = style::scaled(8);
  if (view == CompareView::split) {
    const float line = line_of(state, seen, picture);
    image_.draw(b.frame, display, {line, area.y, area.x + area.width - line, area.height}, picture);
    draw_label("A: " + label_of_picture(state), line - gap, top, true);
    draw_label("B: " + b.label, line + gap, top, false);
    return;
  }
  if (view == CompareView::held) {
    image_.draw(b.frame, display, area, picture);
    draw_label("B: " + b.label, seen.x + gap, top, false);
    return;
  }
  if (view == CompareView::relative) display = {.exposure = 0, .tone = Tone::linear, .view = View::error};
  if (const auto result = compared(state.frame, b.frame, view)) image_.draw(result, display, area, picture);
  const std::string what = view == CompareView::difference ? "|A - B|" : "relative error of A";
  draw_label(what + ", B: " + b.label, seen.x + gap, top, false);
}

void CompareLayer::draw_line(const ViewerState& state, const Rect& area, const PicturePlace& picture, Edits& edits) {
  if (state.compare.view != CompareView::split || !state.frame || !obstacle_to_compare(state).empty()) return;
  const Rect seen = visible(picture.rect, area);
  const float line = line_of(state, seen, picture), grip = style::scaled(6);
  ImGui::SetNextWindowPos({line - grip, seen.y});
  ImGui::SetNextWindowSize({2 * grip, seen.height});
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {0, 0});
  ImGui::PushStyleVar(ImGuiStyleVar_WindowMinSize, {1, 1});
  ImGui::Begin("split", nullptr,
               ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoSavedSettings |
                   ImGuiWindowFlags_NoBackground | ImGuiWindowFlags_NoNav | ImGuiWindowFlags_NoBringToFrontOnFocus |
                   ImGuiWindowFlags_NoFocusOnAppearing);
  ImGui::InvisibleButton("line", {2 * grip, seen.height});
  note_widget("split");
  const bool active = ImGui::IsItemActive(), hovered = ImGui::IsItemHovered();
  if (active || hovered) ImGui::SetMouseCursor(ImGuiMouseCursor_ResizeEW);
  if (active && ImGui::GetIO().MouseDelta.x != 0) {
    Compare compare = state.compare;
    compare.line = std::clamp((ImGui::GetIO().MousePos.x - picture.rect.x) / picture.rect.width, 0.0F, 1.0F);
    edits.compare = compare;
  }
  ImDrawList& list = *ImGui::GetWindowDrawList();
  const float width = style::scaled(1);
  list.AddRectFilled({line - width, seen.y}, {line + width, seen.y + seen.height},
                     active || hovered ? style::outline : IM_COL32(240, 240, 240, 220));
  list.AddRect({line - width - 1, seen.y}, {line + width + 1, seen.y + seen.height}, style::outline_shadow);
  ImGui::End();
  ImGui::PopStyleVar(2);
}

}  // namespace glimt
