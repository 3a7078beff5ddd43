#pragma once

#include <string>
#include <vector>

namespace glimt {

/// A measured value with its spread, as a rule the quartiles.
struct ChartPoint {
  double x = 0, y = 0;
  double low = 0, high = 0;  ///< of y
  bool at_least = false;     ///< y is a bound from below: an open marker
};

struct ChartCurve {
  std::string label;
  std::vector<ChartPoint> points;  ///< by increasing x
  std::vector<ChartPoint> thin;    ///< a second measure of the same thing: a thin line without markers or band
};

struct ChartAxis {
  std::string label;  ///< with the unit
  bool logarithmic = true;
};

struct Chart {
  std::string title;
  ChartAxis x, y;
  std::vector<ChartCurve> curves;
  std::string guide;  ///< what the lines of constant x * y stand for; empty: none are drawn. For logarithmic axes
  std::vector<std::string> notes;  ///< how to read it: lines below the legend
  std::string made_of = {};        ///< version and scene, say: kept in the file and not drawn
};

/// The chart as an SVG of its own, 720 units wide, for a page or a paper: axes with ticks and grid, bands, and a legend
/// below. Curves differ in line and marker as well as in colour, so it reads in grey. Values that are not finite, or
/// not positive on a logarithmic axis, are left out.
std::string svg_chart(const Chart& chart);

}  // namespace glimt
