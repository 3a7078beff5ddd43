#include "viewer/chart_view/chart_export.h"

#include "chart/runs.h"

namespace glimt {

std::string curves_csv(const std::vector<Curve>& curves) {
  std::vector<Variant> variants;
  std::vector<Measurement> measurements;
  for (const Curve& curve : curves) {
    for (const RunPoint& p : curve.points)
      measurements.push_back({variants.size(), curve.scene->render.seed, p.samples, p.seconds, p.estimate, p.error});
    variants.push_back({curve.label, curve.label, {}});
  }
  return measurements_csv(variants, measurements);
}

std::string curves_svg(const std::vector<Curve>& curves, Across axis, const std::string& title) {
  const auto point = [&](const RunPoint& p, double error, bool at_least) {
    return ChartPoint{across(p, axis), error, error, error, at_least};
  };
  Chart chart;
  chart.title = title;
  bool compared = false;
  for (const Curve& curve : curves) {
    if (!curve.shown) continue;
    ChartCurve drawn{curve.label, {}, {}};
    const ErrorKind kind = error_kind(curve);
    const bool has_reference = kind == ErrorKind::reference;
    compared |= has_reference;
    for (const RunPoint& p : curve.points) {
      if (const auto error = error_of(p, kind)) drawn.points.push_back(point(p, *error, !has_reference && p.at_least));
      const auto estimate = error_of(p, ErrorKind::estimate);
      if (has_reference && estimate) drawn.thin.push_back(point(p, *estimate, false));
    }
    chart.curves.push_back(std::move(drawn));
  }
  chart.x.label = axis == Across::seconds ? "rendering time, seconds" : "samples per pixel";
  chart.y.label = compared ? "error: relmse_scaled" : "error: relmse_scaled, estimated from two halves";
  chart.guide = "the error falls as 1/time, its root as time^(−1/2)";
  if (compared)
    chart.notes.emplace_back(
        "Against the reference; thin, and alone where there is none: as estimated from two halves.");
  return svg_chart(chart);
}

}  // namespace glimt
