#pragma once

#include <string>
#include <vector>

namespace glimt {

/// A measured value with its spread, usually the quartiles.
struct ChartPoint {
  double x = 0, y = 0;
  double low = 0, high = 0;  ///< of y
  bool at_least = false;     ///< y is a lower bound: drawn with an open marker
};

struct ChartCurve {
  std::string label;
  std::vector<ChartPoint> points;  ///< by increasing x
  std::vector<ChartPoint> thin;    ///< a second measure of the same quantity: a thin line without markers or band
};

struct ChartAxis {
  std::string label;  ///< with the unit
  bool logarithmic = true;
};

struct Chart {
  std::string title;
  ChartAxis x, y;
  std::vector<ChartCurve> curves;
  std::string guide;               ///< what lines of constant x * y mean (logarithmic axes only); empty: none are drawn
  std::vector<std::string> notes;  ///< how to read it: lines below the legend
  std::string made_of = {};        ///< such as version and scene: kept in the file, not drawn
};

/// The chart as an SVG document, 720 units wide: axes with ticks and grid, curves with bands, and a legend below.
/// Curves differ in line and marker as well as in colour, so the chart can be read in grey. Values that are not finite,
/// or not positive on a logarithmic axis, are left out.
std::string svg_chart(const Chart& chart);

}  // namespace glimt
