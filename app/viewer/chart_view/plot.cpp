#include "viewer/chart_view/plot.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <limits>
#include <tuple>

#include "chart/ticks.h"
#include "viewer/widgets/style.h"
#include "viewer/widgets/widgets.h"

namespace glimt {
namespace {

// Okabe and Ito's colours, brighter for a dark background. As in svg_chart.cpp, the numbers of colours, dashes and
// markers have no common divisor.
constexpr std::array colours{IM_COL32(110, 175, 235, 255), IM_COL32(240, 125, 50, 255),  IM_COL32(40, 190, 140, 255),
                             IM_COL32(235, 235, 235, 255), IM_COL32(225, 145, 190, 255), IM_COL32(60, 130, 200, 255),
                             IM_COL32(240, 190, 60, 255)};
const std::array<std::vector<float>, 5> dashes{{{}, {9, 5}, {2, 4}, {12, 4, 2, 4}, {5, 3}}};
constexpr int markers = 6;
constexpr ImU32 grid = IM_COL32(255, 255, 255, 12), grid_strong = IM_COL32(255, 255, 255, 30),
                guide = IM_COL32(255, 255, 255, 70);
constexpr float marker_size = 3.6F, marker_gap = 46;  ///< design units

bool can_show(const PlotPoint& p) { return std::isfinite(p.x) && std::isfinite(p.y) && p.x > 0 && p.y > 0; }

void draw_marker(ImDrawList& list, const ImVec2& at, const CurveStyle& style) {
  const float r = style::scaled(marker_size);
  const auto point = [&](float x, float y) { return ImVec2(at.x + x * r, at.y + y * r); };
  switch (style.marker) {
    case 0:
      return list.AddCircleFilled(at, r, style.colour, 10);
    case 1:
      return list.AddRectFilled(point(-0.9F, -0.9F), point(0.9F, 0.9F), style.colour);
    case 2:
      return list.AddTriangleFilled(point(0, -1.3F), point(1.15F, 0.9F), point(-1.15F, 0.9F), style.colour);
    case 3:
      return list.AddQuadFilled(point(0, -1.35F), point(1.35F, 0), point(0, 1.35F), point(-1.35F, 0), style.colour);
    case 4:
      return list.AddTriangleFilled(point(0, 1.3F), point(-1.15F, -0.9F), point(1.15F, -0.9F), style.colour);
    default:
      list.AddLine(point(-1, -1), point(1, 1), style.colour, style::scaled(1.5F));
      list.AddLine(point(-1, 1), point(1, -1), style.colour, style::scaled(1.5F));
  }
}

/// Draws a marker with a hole.
void draw_open_marker(ImDrawList& list, const ImVec2& at, const CurveStyle& style) {
  draw_marker(list, at, style);
  list.AddCircleFilled(at, style::scaled(marker_size * 0.62F), style::well, 10);
}

float distance(const ImVec2& a, const ImVec2& b) { return std::hypot(b.x - a.x, b.y - a.y); }

ImVec2 between(const ImVec2& a, const ImVec2& b, float share) {
  return {a.x + share * (b.x - a.x), a.y + share * (b.y - a.y)};
}

/// Draws a dashed line whose pattern continues from one piece to the next.
void draw_dashed(ImDrawList& list, const std::vector<ImVec2>& places, const CurveStyle& style, float width) {
  if (style.dashes.empty()) {
    list.AddPolyline(places.data(), static_cast<int>(places.size()), style.colour, ImDrawFlags_None, width);
    return;
  }
  std::size_t dash = 0;
  float left = style::scaled(style.dashes[0]);
  for (std::size_t i = 1; i < places.size(); ++i) {
    const float length = distance(places[i - 1], places[i]);
    for (float done = 0; done < length;) {
      const float end = std::min(done + left, length);
      if (dash % 2 == 0)
        list.AddLine(between(places[i - 1], places[i], done / length), between(places[i - 1], places[i], end / length),
                     style.colour, width);
      left -= end - done;
      done = end;
      // A remainder too small to change `done` would loop for ever.
      if (left < 0.01F) left = style::scaled(style.dashes[++dash % style.dashes.size()]);
    }
  }
}

/// log10 of the ends of an axis, from log10 of the lowest and highest value: with a margin, and at least an octave
/// apart.
std::pair<double, double> ends(double low, double high) {
  if (low > high) return {-1, 1};
  const double margin = std::max(0.04 * (high - low), 0.15 - (high - low) / 2);
  return {low - margin, high + std::max(margin, 0.02)};
}

std::string tick_label(const LogTick& tick) {
  char text[32];
  if (tick.exponent >= -3 && tick.exponent <= 3)
    std::snprintf(text, sizeof text, "%.6g", tick.value);
  else
    std::snprintf(text, sizeof text, "%de%d", tick.digit, tick.exponent);
  return text;
}

void draw_text(const ImVec2& at, ImU32 colour, const std::string& text) {
  ImGui::GetWindowDrawList()->AddText(at, colour, text.c_str());
}

}  // namespace

CurveStyle curve_style(std::uint64_t number) {
  return {colours[number % colours.size()], dashes[number % dashes.size()], static_cast<int>(number % markers)};
}

Plot::Plot(const Rect& place, const std::vector<std::vector<PlotPoint>>& curves) {
  const float line = ImGui::GetFontSize();
  const float left = 2 * line + style::scaled(24), bottom = 2 * line + style::scaled(12);
  inner_ = {place.x + left, place.y + line + style::scaled(6), place.width - left - style::scaled(8),
            place.height - bottom - line - style::scaled(6)};
  constexpr double infinity = std::numeric_limits<double>::infinity();
  double x0 = infinity, x1 = -infinity, y0 = infinity, y1 = -infinity;
  for (const auto& curve : curves)
    for (const PlotPoint& p : curve) {
      if (!can_show(p)) continue;
      x0 = std::min(x0, std::log10(p.x));
      x1 = std::max(x1, std::log10(p.x));
      y0 = std::min(y0, std::log10(p.y));
      y1 = std::max(y1, std::log10(p.y));
    }
  std::tie(left_, right_) = ends(x0, x1);
  std::tie(bottom_, top_) = ends(y0, y1);
}

ImVec2 Plot::place_of(const PlotPoint& p) const {
  const double x = (std::log10(p.x) - left_) / (right_ - left_), y = (std::log10(p.y) - bottom_) / (top_ - bottom_);
  return {inner_.x + inner_.width * static_cast<float>(x), inner_.y + inner_.height * static_cast<float>(1 - y)};
}

std::vector<ImVec2> Plot::places_of(const std::vector<PlotPoint>& points) const {
  std::vector<ImVec2> places;
  for (const PlotPoint& p : points)
    if (can_show(p)) places.push_back(place_of(p));
  return places;
}

void Plot::draw_axes(const std::string& across, const std::string& up) const {
  ImDrawList& list = *ImGui::GetWindowDrawList();
  const float right = inner_.x + inner_.width, bottom = inner_.y + inner_.height, gap = style::scaled(5);
  const ImU32 text = style::muted;
  float free = inner_.x - style::scaled(20);  // right end of the numbers so far
  for (const LogTick& tick : logarithmic_ticks(left_, right_)) {
    const float x = place_of({tick.value, 1}).x;
    list.AddLine({x, inner_.y}, {x, bottom}, tick.labelled ? grid_strong : grid);
    const std::string label = tick_label(tick);
    const float width = ImGui::CalcTextSize(label.c_str()).x, at = std::min(x - width / 2, right - width);
    if (!tick.labelled || at < free) continue;
    draw_text({at, bottom + gap}, text, label);
    free = at + width + gap;
  }
  float above = bottom + ImGui::GetFontSize();
  for (const LogTick& tick : logarithmic_ticks(bottom_, top_)) {
    const float y = place_of({1, tick.value}).y, height = ImGui::GetFontSize();
    list.AddLine({inner_.x, y}, {right, y}, tick.labelled ? grid_strong : grid);
    if (!tick.labelled || y + height / 2 > above) continue;
    const std::string label = tick_label(tick);
    draw_text({inner_.x - ImGui::CalcTextSize(label.c_str()).x - gap, y - height / 2}, text, label);
    above = y - height / 2;
  }
  list.AddRect({inner_.x, inner_.y}, {right, bottom}, grid_strong);
  draw_text({right - ImGui::CalcTextSize(across.c_str()).x, bottom + gap + ImGui::GetFontSize()}, text, across);
  draw_text({inner_.x, inner_.y - ImGui::GetFontSize() - gap}, text, fit_text(up, inner_.width));
}

void Plot::draw_guide(const std::string& title) const {
  ImDrawList& list = *ImGui::GetWindowDrawList();
  list.PushClipRect({inner_.x, inner_.y}, {inner_.x + inner_.width, inner_.y + inner_.height}, true);
  const CurveStyle style{guide, {1, 5}, 0};
  const int last = static_cast<int>(std::floor(right_ + top_));
  for (int power = static_cast<int>(std::ceil(left_ + bottom_)); power <= last; ++power) {
    // Each line runs from the left or upper edge to the right or lower one.
    const double x0 = std::max(left_, power - top_), x1 = std::min(right_, power - bottom_);
    const auto at = [&](double x) { return place_of({std::pow(10, x), std::pow(10, power - x)}); };
    draw_dashed(list, {at(x0), at(x1)}, style, style::scaled(1));
  }
  list.PopClipRect();
  const float y = inner_.y + inner_.height + style::scaled(5) + ImGui::GetFontSize();
  list.AddLine({inner_.x, y + ImGui::GetFontSize() / 2}, {inner_.x + style::scaled(18), y + ImGui::GetFontSize() / 2},
               guide);
  draw_text({inner_.x + style::scaled(24), y}, style::muted, title);
}

void Plot::draw_curve(const std::vector<PlotPoint>& points, const CurveStyle& style) const {
  const auto places = places_of(points);
  if (places.empty()) return;
  ImDrawList& list = *ImGui::GetWindowDrawList();
  draw_dashed(list, places, style, style::scaled(1.8F));
  std::vector<bool> open;
  for (const PlotPoint& p : points)
    if (can_show(p)) open.push_back(p.at_least);
  const ImVec2* marked = nullptr;
  for (std::size_t i = 0; i < places.size(); ++i) {
    const ImVec2& at = places[i];
    if (marked && i + 1 < places.size() && distance(*marked, at) < style::scaled(marker_gap)) continue;
    (open[i] ? draw_open_marker : draw_marker)(list, at, style);
    marked = &at;
  }
}

void Plot::draw_thin(const std::vector<PlotPoint>& points, ImU32 colour) const {
  const auto places = places_of(points);
  ImGui::GetWindowDrawList()->AddPolyline(places.data(), static_cast<int>(places.size()),
                                          (colour & ~IM_COL32_A_MASK) | IM_COL32(0, 0, 0, 170), ImDrawFlags_None,
                                          style::scaled(1));
}

void Plot::draw_level(double y, const std::string& title) const {
  const double level = std::log10(y);
  if (!(level > bottom_ && level < top_)) return;
  const float at = place_of({1, y}).y, right = inner_.x + inner_.width;
  draw_dashed(*ImGui::GetWindowDrawList(), {{inner_.x, at}, {right, at}}, {guide, {6, 4}, 0}, style::scaled(1));
  draw_text({inner_.x + style::scaled(6), at - ImGui::GetFontSize() - style::scaled(2)}, style::muted, title);
}

void Plot::draw_crosshair(const PlotPoint& point) const {
  const ImVec2 at = place_of(point);
  ImDrawList& list = *ImGui::GetWindowDrawList();
  list.AddLine({at.x, inner_.y}, {at.x, inner_.y + inner_.height}, style::outline_hidden);
  list.AddLine({inner_.x, at.y}, {inner_.x + inner_.width, at.y}, style::outline_hidden);
}

std::optional<PlotPoint> Plot::under_mouse() const {
  const ImVec2 mouse = ImGui::GetIO().MousePos;
  if (!ImGui::IsWindowHovered() || !is_inside(inner_, mouse.x, mouse.y)) return std::nullopt;
  const double x = (mouse.x - inner_.x) / inner_.width, y = 1 - (mouse.y - inner_.y) / inner_.height;
  return PlotPoint{std::pow(10, left_ + x * (right_ - left_)), std::pow(10, bottom_ + y * (top_ - bottom_))};
}

void draw_sample(const Rect& place, const CurveStyle& style) {
  ImDrawList& list = *ImGui::GetWindowDrawList();
  const float y = place.y + place.height / 2;
  draw_dashed(list, {{place.x, y}, {place.x + place.width, y}}, style, style::scaled(1.8F));
  draw_marker(list, {place.x + place.width / 2, y}, style);
}

std::string short_number(double value) {
  char text[32];
  const double size = std::abs(value);
  const char* format = size >= 1000 && size < 1e7 ? "%.0f" : size < 1e-3 && size > 0 ? "%.1e" : "%.3g";
  std::snprintf(text, sizeof text, format, value);
  std::string result = text;
  // "1.2e-05" becomes "1.2e-5".
  if (const auto e = result.find("e-0"); e != std::string::npos) result.erase(e + 2, 1);
  return result;
}

}  // namespace glimt
