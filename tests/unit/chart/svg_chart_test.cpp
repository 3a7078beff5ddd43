#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <regex>
#include <set>

#include "chart/runs.h"
#include "chart/svg_chart.h"

using namespace glimt;

namespace {

std::vector<std::string> all(const std::string& text, const std::string& pattern) {
  const std::regex expression(pattern);
  std::vector<std::string> found;
  for (std::sregex_iterator i(text.begin(), text.end(), expression), end; i != end; ++i) found.push_back((*i)[1]);
  return found;
}

Chart line_chart(std::size_t curves) {
  Chart chart{"Room & <lamp>", {"time, seconds"}, {"error"}, {}, "guide", {"note"}, "x < 1"};
  for (std::size_t i = 0; i < curves; ++i)
    chart.curves.push_back({"curve " + std::to_string(i), {{1, 100, 90, 110}, {10, 10, 9, 11}, {100, 1, 1, 1}}, {}});
  return chart;
}

TEST(SvgChart, PointsOfAPowerLawLieOnALine) {
  const std::string svg = svg_chart(line_chart(1));
  const auto lines = all(svg, "<polyline fill='none' stroke='[^>]* stroke-width='2' [^>]*points='([^']*)'");
  ASSERT_EQ(lines.size(), 1U);
  double x[3], y[3];
  ASSERT_EQ(std::sscanf(lines[0].c_str(), "%lf,%lf %lf,%lf %lf,%lf", &x[0], &y[0], &x[1], &y[1], &x[2], &y[2]), 6);
  EXPECT_NEAR(x[1], (x[0] + x[2]) / 2, 0.02);
  EXPECT_NEAR(y[1], (y[0] + y[2]) / 2, 0.02);
  EXPECT_GT(y[2], y[0]) << "small errors are at the bottom";
}

TEST(SvgChart, CurvesDifferWithoutColour) {
  const std::string svg = svg_chart(line_chart(12));
  std::set<std::string> styles;
  const auto dashes = all(svg, "<polyline fill='none' stroke='[^>]* stroke-width='2' stroke-dasharray='([^']*)'");
  const auto markers = all(svg, "<g transform='translate[^>]*>(<[^g].*)</g>");
  ASSERT_EQ(dashes.size(), 12U);
  ASSERT_EQ(markers.size(), 48U) << "three points and a place in the legend each";
  for (std::size_t i = 0; i < 12; ++i) styles.insert(dashes[i] + markers[3 * i]);
  EXPECT_EQ(styles.size(), 12U);
}

TEST(SvgChart, SaysWhatItShowsAndEscapesIt) {
  const std::string svg = svg_chart(line_chart(2));
  for (const char* part : {"Room &amp; &lt;lamp&gt;", "time, seconds", ">error<", "curve 1", ">guide<", ">note<",
                           "<metadata>x &lt; 1</metadata>"})
    EXPECT_NE(svg.find(part), std::string::npos) << part;
}

TEST(SvgChart, LeavesOutWhatCannotBeDrawn) {
  Chart chart = line_chart(1);
  constexpr double infinite = std::numeric_limits<double>::infinity();
  chart.curves[0].points.push_back({1000, infinite, infinite, infinite});
  chart.curves[0].points.push_back({1000, 0, 0, 0});
  chart.curves[0].points.push_back({std::nan(""), 1, 1, 1});
  const std::string svg = svg_chart(chart);
  EXPECT_EQ(svg, svg_chart(line_chart(1)));
  chart.curves.clear();
  for (const Chart& empty : {chart, Chart{}})
    for (const char* part : {"nan", "inf"}) EXPECT_EQ(svg_chart(empty).find(part), std::string::npos) << part;
}

TEST(Quantile, InterpolatesBetweenSortedValues) {
  EXPECT_DOUBLE_EQ(quantile({3, 1, 2}, 0.5), 2);
  EXPECT_DOUBLE_EQ(quantile({4, 1, 2, 3}, 0.5), 2.5);
  EXPECT_DOUBLE_EQ(quantile({10, 20, 30, 40, 50}, 0.25), 20);
  EXPECT_DOUBLE_EQ(quantile({1, 2}, 1), 2);
  EXPECT_TRUE(std::isnan(quantile({}, 0.5)));
}

}  // namespace
