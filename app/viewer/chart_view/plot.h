#pragma once

#include <imgui.h>

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "viewer/widgets/layout.h"

namespace glimt {

struct PlotPoint {
  double x = 0, y = 0;
  bool at_least = false;  ///< y is a bound from below: an open marker
};

/// How a curve looks: curves differ in line and marker as well as in colour, so they can be told apart in grey.
struct CurveStyle {
  ImU32 colour;
  std::vector<float> dashes;  ///< lengths of line and gap in turn, design units; empty: one line
  int marker;
};
CurveStyle curve_style(std::uint64_t number);

/// Curves on two logarithmic axes, drawn into the current ImGui window. What is not positive or finite is left out.
class Plot {
 public:
  /// Axes that hold all the points, within `place`, labels included.
  Plot(const Rect& place, const std::vector<std::vector<PlotPoint>>& curves);

  /// Grid, numbers and titles.
  void draw_axes(const std::string& across, const std::string& up) const;
  /// Lines of constant x * y, and their title.
  void draw_guide(const std::string& title) const;
  void draw_curve(const std::vector<PlotPoint>& points, const CurveStyle& style) const;
  /// A second measure of the same thing, without markers.
  void draw_thin(const std::vector<PlotPoint>& points, ImU32 colour) const;
  /// A line at one value of y.
  void draw_level(double y, const std::string& title) const;
  void draw_crosshair(const PlotPoint& at) const;

  /// What the mouse is on, where it is on the plot of an ImGui window that takes it.
  std::optional<PlotPoint> under_mouse() const;

 private:
  ImVec2 place_of(const PlotPoint& point) const;
  std::vector<ImVec2> places_of(const std::vector<PlotPoint>& points) const;

  Rect inner_;           ///< between the axes
  double left_, right_;  ///< log10 of x
  double bottom_, top_;  ///< log10 of y
};

/// A line of a curve with its marker in the middle, for lists.
void draw_sample(const Rect& place, const CurveStyle& style);

/// A number with two or three digits, short: "0.0123", "1.2e-5", "340".
std::string short_number(double value);

}  // namespace glimt
