#include "viewer/picture/inspector.h"

#include <imgui.h>

#include <algorithm>

#include "viewer/chart_view/plot.h"
#include "viewer/state/compare_actions.h"
#include "viewer/widgets/style.h"
#include "viewer/widgets/widgets.h"

namespace glimt {
namespace {

std::string three(const float* rgb) {
  return short_number(rgb[0]) + "  " + short_number(rgb[1]) + "  " + short_number(rgb[2]);
}

std::optional<Pixel> under_mouse(const ImageSize& size, const Rect& area, const PicturePlace& picture) {
  const ImGuiIO& io = ImGui::GetIO();
  const Rect& r = picture.rect;
  if (io.WantCaptureMouse || !is_inside(area, io.MousePos.x, io.MousePos.y) ||
      !is_inside(r, io.MousePos.x, io.MousePos.y))
    return std::nullopt;
  const auto along = [](float from_edge, float length, int pixels) {
    return std::clamp(static_cast<int>(from_edge / length * static_cast<float>(pixels)), 0, pixels - 1);
  };
  return Pixel{along(io.MousePos.x - r.x, r.width, size.width), along(io.MousePos.y - r.y, r.height, size.height)};
}

/// A frame around the pixel.
void draw_mark(const Pixel& pixel, const ImageSize& size, const Rect& area, const PicturePlace& picture) {
  const Rect& r = picture.rect;
  const float side = r.width / static_cast<float>(size.width);
  const float middle_x = r.x + (static_cast<float>(pixel.x) + 0.5F) * side,
              middle_y = r.y + (static_cast<float>(pixel.y) + 0.5F) * side;
  const float half = std::max(side / 2, style::scaled(4)) + style::scaled(1);
  ImDrawList& list = *ImGui::GetBackgroundDrawList();
  list.PushClipRect({area.x, area.y}, {area.x + area.width, area.y + area.height});
  for (const bool shadow : {true, false})
    list.AddRect({middle_x - half, middle_y - half}, {middle_x + half, middle_y + half},
                 shadow ? style::outline_shadow : style::outline, 0, ImDrawFlags_None, style::scaled(shadow ? 4 : 2));
  list.PopClipRect();
}

}  // namespace

std::vector<std::array<std::string, 2>> pixel_lines(const ViewerState& state, const Pixel& pixel) {
  const Frame& frame = *state.frame;
  std::vector<std::array<std::string, 2>> lines{{"Pixel", std::to_string(pixel.x) + ", " + std::to_string(pixel.y)}};
  const auto value_at = [&](const Image& image) {
    // A preview has fewer pixels than its frame.
    return image.pixel(pixel.x * image.width / frame.size.width, pixel.y * image.height / frame.size.height);
  };
  lines.push_back({"Radiance", three(value_at(frame.mean))});
  if (!frame.error.rgb.empty()) lines.push_back({"Standard error", three(value_at(frame.error))});
  lines.push_back({"Samples", std::to_string(frame.samples)});
  if (!obstacle_to_compare(state).empty()) return lines;
  const Image& b = picture_b(state).frame->mean;
  if (!same_size(frame.mean, b)) return lines;
  lines.push_back({"B", three(b.pixel(pixel.x, pixel.y))});
  lines.push_back(
      {"Relative error",
       short_number(100 * relative_error(frame.mean.pixel(pixel.x, pixel.y), b.pixel(pixel.x, pixel.y))) + " %"});
  return lines;
}

void Inspector::draw(const ViewerState& state, const Rect& area, const PicturePlace& picture) const {
  if (!state.inspect || !state.frame) return;
  const ImageSize& size = state.frame->size;
  const auto pixel = under_mouse(size, area, picture);
  const bool marked = marked_ && marked_->x < size.width && marked_->y < size.height;
  if (marked) draw_mark(*marked_, size, area, picture);
  if (!pixel && !marked) return;
  const auto lines = pixel_lines(state, pixel ? *pixel : *marked_);

  float labels = 0, values = 0;
  for (const auto& [label, value] : lines) {
    labels = std::max(labels, ImGui::CalcTextSize(label.c_str()).x);
    values = std::max(values, ImGui::CalcTextSize(value.c_str()).x);
  }
  const float line = ImGui::GetTextLineHeightWithSpacing(), gap = style::scaled(14), pad = style::scaled(10);
  const float height = line * static_cast<float>(lines.size()) + 2 * pad;
  const ImVec2 at{area.x + pad, area.y + area.height - height - pad};
  ImDrawList& list = *ImGui::GetBackgroundDrawList();
  list.AddRectFilled(at, {at.x + labels + gap + values + 2 * pad, at.y + height}, IM_COL32(15, 16, 18, 215),
                     style::scaled(6));
  float y = at.y + pad;
  for (const auto& [label, value] : lines) {
    list.AddText({at.x + pad, y}, style::muted, label.c_str());
    list.AddText({at.x + pad + labels + gap, y}, ImGui::GetColorU32(ImGuiCol_Text), value.c_str());
    y += line;
  }
}

}  // namespace glimt
