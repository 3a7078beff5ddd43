#include "chart/svg_chart.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <limits>

#include "chart/ticks.h"

namespace glimt {
namespace {

constexpr double width = 720, left = 78, right = 20, top = 44, plot_height = 380, row_height = 21;
constexpr double plot_width = width - left - right;

// Okabe and Ito's colours, which people with any colour vision can tell apart. The numbers of colours, dashes and
// markers have no common divisor, so the first 210 curves all differ.
constexpr std::array colours{"#0072b2", "#d55e00", "#009e73", "#000000", "#cc79a7", "#56b4e9", "#e69f00"};
constexpr std::array dashes{"none", "9 4", "2 3", "12 3 2 3", "5 2"};
constexpr std::array markers{"<circle r='3.8'/>",
                             "<rect x='-3.4' y='-3.4' width='6.8' height='6.8'/>",
                             "<path d='M0-4.8 4.4 3.2H-4.4Z'/>",
                             "<path d='M0-5 5 0 0 5-5 0Z'/>",
                             "<path d='M0 4.8 4.4-3.2H-4.4Z'/>",
                             "<path fill='none' d='M-4-4 4 4M-4 4 4-4'/>"};

struct Style {
  const char *colour, *dash, *marker;
};

Style style_of(std::size_t curve) {
  return {colours[curve % colours.size()], dashes[curve % dashes.size()], markers[curve % markers.size()]};
}

std::string formatted(double value, const char* format = "%.2f") {
  char text[40];
  std::snprintf(text, sizeof text, format, value);
  return text;
}

std::string escaped(const std::string& text) {
  std::string result;
  for (const char c : text) {
    if (c == '&')
      result += "&amp;";
    else if (c == '<')
      result += "&lt;";
    else if (c == '>')
      result += "&gt;";
    else
      result += c;
  }
  return result;
}

/// Where values lie along an axis, 0 to 1.
struct Scale {
  bool logarithmic = true;
  double first = 0, last = 1;  ///< ends of the axis: values, or their logarithms to base 10

  double inner(double value) const { return logarithmic ? std::log10(value) : value; }
  double place(double value) const { return (inner(value) - first) / (last - first); }
};

struct Tick {
  double value;
  std::string label;  ///< SVG; empty for small ticks
};

bool can_show(const ChartAxis& axis, double value) { return std::isfinite(value) && (!axis.logarithmic || value > 0); }

bool can_show(const Chart& chart, const ChartPoint& p) { return can_show(chart.x, p.x) && can_show(chart.y, p.y); }

/// The axis that holds these values, with a margin.
Scale scale_of(const ChartAxis& axis, const std::vector<double>& values) {
  Scale scale{axis.logarithmic, std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};
  for (const double value : values)
    if (can_show(axis, value)) {
      scale.first = std::min(scale.first, scale.inner(value));
      scale.last = std::max(scale.last, scale.inner(value));
    }
  if (scale.first > scale.last) scale.first = 0, scale.last = 1;
  const double margin = scale.last > scale.first ? 0.04 * (scale.last - scale.first) : 0.5;
  scale.first -= margin, scale.last += margin;
  return scale;
}

std::vector<double> xs_of(const Chart& chart) {
  std::vector<double> values;
  for (const auto& curve : chart.curves)
    for (const auto* points : {&curve.points, &curve.thin})
      for (const auto& p : *points)
        if (can_show(chart, p)) values.push_back(p.x);
  return values;
}

/// All y values, bands included.
std::vector<double> ys_of(const Chart& chart) {
  std::vector<double> values;
  for (const auto& curve : chart.curves) {
    for (const auto& p : curve.points)
      if (can_show(chart, p)) values.insert(values.end(), {p.y, p.low, p.high});
    for (const auto& p : curve.thin)
      if (can_show(chart, p)) values.push_back(p.y);
  }
  return values;
}

std::string power_label(int exponent, int digit) {
  if (exponent >= -3 && exponent <= 3) return formatted(digit * std::pow(10, exponent), "%.6g");
  const std::string front = digit == 1 ? "" : std::to_string(digit) + "·";
  return front + "10<tspan dy='-5' font-size='9'>" + (exponent < 0 ? "−" : "") + std::to_string(std::abs(exponent)) +
         "</tspan>";
}

std::vector<Tick> logarithmic_ticks_of(const Scale& scale) {
  std::vector<Tick> ticks;
  for (const LogTick& tick : logarithmic_ticks(scale.first, scale.last))
    ticks.push_back({tick.value, tick.labelled ? power_label(tick.exponent, tick.digit) : ""});
  return ticks;
}

/// About five ticks, at steps of 1, 2 or 5 times a power of ten.
std::vector<Tick> linear_ticks(const Scale& scale) {
  const double rough = (scale.last - scale.first) / 5, power = std::pow(10, std::floor(std::log10(rough)));
  const double step = power * (rough < 2 * power ? 2 : rough < 5 * power ? 5 : 10);
  std::vector<Tick> ticks;
  const int last = static_cast<int>(std::floor(scale.last / step));
  for (int i = static_cast<int>(std::ceil(scale.first / step)); i <= last; ++i)
    ticks.push_back({i * step, formatted(i * step, "%.4g")});
  return ticks;
}

std::vector<Tick> ticks_of(const Scale& scale) {
  return scale.logarithmic ? logarithmic_ticks_of(scale) : linear_ticks(scale);
}

class Drawing {
 public:
  explicit Drawing(const Chart& chart)
      : chart_(chart), x_(scale_of(chart.x, xs_of(chart))), y_(scale_of(chart.y, ys_of(chart))) {}

  std::string svg() {
    const std::string body = axes() + guide() + curves() + legend();
    const std::string size = formatted(width, "%.0f") + "' height='" + formatted(height_, "%.0f");
    return "<svg xmlns='http://www.w3.org/2000/svg' width='" + size + "' viewBox='0 0 " + formatted(width, "%.0f") +
           " " + formatted(height_, "%.0f") +
           "' font-family='Helvetica, Arial, sans-serif' font-size='13' fill='#222'>\n" +
           (chart_.made_of.empty() ? "" : "<metadata>" + escaped(chart_.made_of) + "</metadata>\n") +
           "<rect width='100%' height='100%' fill='#fff'/>\n<clipPath id='plot'><rect x='" + formatted(left) + "' y='" +
           formatted(top) + "' width='" + formatted(plot_width) + "' height='" + formatted(plot_height) +
           "'/></clipPath>\n" + body + "</svg>\n";
  }

 private:
  double across(double x) const { return left + plot_width * x_.place(x); }
  double down(double y) const { return top + plot_height * (1 - y_.place(y)); }

  static std::string line(double x1, double y1, double x2, double y2, const std::string& style) {
    return "<line x1='" + formatted(x1) + "' y1='" + formatted(y1) + "' x2='" + formatted(x2) + "' y2='" +
           formatted(y2) + "' " + style + "/>\n";
  }
  static std::string text(double x, double y, const std::string& style, const std::string& content) {
    return "<text x='" + formatted(x) + "' y='" + formatted(y) + "' " + style + ">" + content + "</text>\n";
  }

  std::string axes() const {
    constexpr double bottom = top + plot_height;
    std::string svg = text(left, top - 18, "font-size='15' font-weight='bold'", escaped(chart_.title));
    const auto grid = [](const Tick& tick) {
      return std::string("stroke='") + (tick.label.empty() ? "#f0f0f0" : "#dadada") + "'";
    };
    for (const Tick& tick : ticks_of(x_)) {
      svg += line(across(tick.value), top, across(tick.value), bottom, grid(tick));
      if (!tick.label.empty()) svg += text(across(tick.value), bottom + 18, "text-anchor='middle'", tick.label);
    }
    for (const Tick& tick : ticks_of(y_)) {
      svg += line(left, down(tick.value), left + plot_width, down(tick.value), grid(tick));
      if (!tick.label.empty()) svg += text(left - 8, down(tick.value) + 4.5, "text-anchor='end'", tick.label);
    }
    svg += "<rect x='" + formatted(left) + "' y='" + formatted(top) + "' width='" + formatted(plot_width) +
           "' height='" + formatted(plot_height) + "' fill='none' stroke='#444'/>\n";
    svg += text(left + plot_width / 2, bottom + 40, "text-anchor='middle'", escaped(chart_.x.label));
    const std::string middle = formatted(top + plot_height / 2);
    return svg + text(18, top + plot_height / 2, "text-anchor='middle' transform='rotate(-90 18 " + middle + ")'",
                      escaped(chart_.y.label));
  }

  /// Lines of constant x * y, one for each power of ten.
  std::string guide() const {
    if (chart_.guide.empty()) return {};
    std::string svg = "<g clip-path='url(#plot)' " + std::string(guide_style) + ">\n";
    const int last = static_cast<int>(std::floor(x_.last + y_.last));
    for (int power = static_cast<int>(std::ceil(x_.first + y_.first)); power <= last; ++power) {
      const auto at = [&](double x) { return down(std::pow(10, power - x)); };
      svg += line(left, at(x_.first), left + plot_width, at(x_.last), "");
    }
    return svg + "</g>\n";
  }

  std::string polyline(const std::vector<ChartPoint>& points, const std::string& style) const {
    std::string svg = "<polyline fill='none' " + style + " points='";
    for (const auto& p : points)
      if (can_show(chart_, p)) svg += formatted(across(p.x)) + "," + formatted(down(p.y)) + " ";
    return svg + "'/>\n";
  }

  std::string band(const ChartCurve& curve, const char* colour) const {
    std::string there, back;
    for (const auto& p : curve.points) {
      if (!can_show(chart_, p) || !can_show(chart_.y, p.low) || !can_show(chart_.y, p.high)) continue;
      there += formatted(across(p.x)) + "," + formatted(down(p.low)) + " ";
      back = formatted(across(p.x)) + "," + formatted(down(p.high)) + " " + back;
    }
    return "<polygon stroke='none' fill-opacity='0.18' fill='" + std::string(colour) + "' points='" + there + back +
           "'/>\n";
  }

  std::string curves() const {
    std::string svg = "<g clip-path='url(#plot)'>\n";
    for (std::size_t i = 0; i < chart_.curves.size(); ++i) svg += band(chart_.curves[i], style_of(i).colour);
    for (std::size_t i = 0; i < chart_.curves.size(); ++i) {
      const auto [colour, dash, marker] = style_of(i);
      const std::string stroke = "stroke='" + std::string(colour) + "' ";
      svg += polyline(chart_.curves[i].thin, stroke + "stroke-width='0.9' stroke-opacity='0.75'");
      svg += polyline(chart_.curves[i].points, stroke + "stroke-width='2' stroke-dasharray='" + dash + "'");
      for (const auto& p : chart_.curves[i].points)
        if (can_show(chart_, p)) svg += marker_at(across(p.x), down(p.y), colour, marker, p.at_least);
    }
    return svg + "</g>\n";
  }

  static std::string marker_at(double x, double y, const std::string& colour, const char* marker, bool open = false) {
    return "<g transform='translate(" + formatted(x) + " " + formatted(y) + ")' fill='" + (open ? "#fff" : colour) +
           "' stroke='" + colour + "' stroke-width='1.2'>" + marker + "</g>\n";
  }

  /// Below the plot, in as many columns as the longest label allows.
  std::string legend() {
    std::size_t longest = 0;
    for (const auto& curve : chart_.curves) longest = std::max(longest, curve.label.size());
    const double needed = 60 + 7.0 * static_cast<double>(longest);
    const auto columns = static_cast<std::size_t>(std::clamp(plot_width / needed, 1.0, 4.0));
    const double first = top + plot_height + 70;
    std::string svg;
    for (std::size_t i = 0; i < chart_.curves.size(); ++i) {
      const auto [colour, dash, marker] = style_of(i);
      const double x = left + static_cast<double>(i % columns) * plot_width / static_cast<double>(columns);
      const std::size_t row = i / columns;
      const double y = first + static_cast<double>(row) * row_height;
      svg += line(x, y - 4.5, x + 40, y - 4.5,
                  "stroke='" + std::string(colour) + "' stroke-width='2' stroke-dasharray='" + dash + "'");
      svg += marker_at(x + 20, y - 4.5, colour, marker) + text(x + 49, y, "", escaped(chart_.curves[i].label));
    }
    const std::size_t rows = (chart_.curves.size() + columns - 1) / columns;
    double y = first + row_height * static_cast<double>(rows);
    if (!chart_.guide.empty()) {
      svg += line(left, y - 4.5, left + 40, y - 4.5, guide_style) + text(left + 49, y, "", escaped(chart_.guide));
      y += row_height;
    }
    for (const auto& note : chart_.notes) {
      svg += text(left, y, "font-size='11.5' fill='#555'", escaped(note));
      y += row_height;
    }
    height_ = y - 4;
    return svg;
  }

  static constexpr const char* guide_style = "stroke='#999' stroke-width='1' stroke-dasharray='1 4'";

  const Chart& chart_;
  Scale x_, y_;
  double height_ = 0;  ///< of the whole chart, known once the legend is drawn
};

}  // namespace

std::string svg_chart(const Chart& chart) { return Drawing(chart).svg(); }

}  // namespace glimt
