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
  bool at_least = false;  ///< y is a lower bound: drawn with an open marker
};

/// How a curve looks. Curves differ in line and marker as well as in colour, so they can be told apart in grey.
struct CurveStyle {
  ImU32 colour;
  std::vector<float> dashes;  ///< lengths of line and gap in turn, design units; empty: a solid line
  int marker;
};
CurveStyle curve_style(std::uint64_t number);

/// Curves on two logarithmic axes, drawn into the current ImGui window. Values that are not positive and finite are
/// left out.
class Plot {
 public:
  /// Chooses axes that hold all points. Axes and labels fit into `place`.
  Plot(const Rect& place, const std::vector<std::vector<PlotPoint>>& curves);

  /// Grid, numbers and titles.
  void draw_axes(const std::string& across, const std::string& up) const;
  /// Lines of constant x * y, and their title.
  void draw_guide(const std::string& title) const;
  void draw_curve(const std::vector<PlotPoint>& points, const CurveStyle& style) const;
  /// A second measure of the same quantity: a thin line without markers.
  void draw_thin(const std::vector<PlotPoint>& points, ImU32 colour) const;
  /// A line at one value of y.
  void draw_level(double y, const std::string& title) const;
  void draw_crosshair(const PlotPoint& at) const;

  /// The point at the mouse, if the mouse is on the plot and its ImGui window is not covered.
  std::optional<PlotPoint> under_mouse() const;

 private:
  ImVec2 place_of(const PlotPoint& point) const;
  std::vector<ImVec2> places_of(const std::vector<PlotPoint>& points) const;

  Rect inner_;           ///< between the axes
  double left_, right_;  ///< log10 of x
  double bottom_, top_;  ///< log10 of y
};

/// A short piece of a curve with one marker, for lists.
void draw_sample(const Rect& place, const CurveStyle& style);

/// A number with two or three digits: "0.0123", "1.2e-5", "340".
std::string short_number(double value);

}  // namespace glimt
