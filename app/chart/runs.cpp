#include "chart/runs.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <limits>
#include <map>

namespace glimt {
namespace {

/// Renders one pass that is not measured: the first pass also pays for threads, memory and caches.
void warm_up(std::span<const Variant> variants, const Execution& execution) {
  for (const Variant& variant : variants) {
    Film film = make_film(variant.scene);
    render_pass(variant.scene, film, 1, execution);
  }
}

/// A variant's measurements, by sample count.
std::map<int, std::vector<const Measurement*>> by_spp(std::span<const Measurement> measurements, std::size_t variant) {
  std::map<int, std::vector<const Measurement*>> found;
  for (const auto& m : measurements)
    if (m.variant == variant) found[m.spp].push_back(&m);
  return found;
}

template <class Get>
std::vector<double> values_of(const std::vector<const Measurement*>& measurements, Get get) {
  std::vector<double> values;
  values.reserve(measurements.size());
  for (const Measurement* m : measurements) values.push_back(get(*m));
  return values;
}

template <class Get>
ChartPoint point_of(const std::vector<const Measurement*>& measurements, Get error) {
  const auto errors = values_of(measurements, error);
  const auto seconds = values_of(measurements, [](const Measurement& m) { return m.seconds; });
  return {quantile(seconds, 0.5), quantile(errors, 0.5), quantile(errors, 0.25), quantile(errors, 0.75)};
}

std::string csv_number(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.9g", value);
  return text;
}

/// The text as a field of CSV: in quotes where it has a comma.
std::string csv_text(const std::string& text) {
  return text.find(',') == std::string::npos ? text : "\"" + text + "\"";
}

}  // namespace

double seconds_of_pass(const CompiledScene& scene, Film& film, int count, const Execution& execution) {
  const auto start = std::chrono::steady_clock::now();
  render_pass(scene, film, count, execution);
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

std::vector<Measurement> measure(std::span<Variant> variants, const Plan& plan, const Image* reference,
                                 const std::function<void(double)>& report) {
  warm_up(variants, plan.execution);
  std::vector<Measurement> measurements;
  std::vector<int> last(variants.size(), 0);  // samples at which a variant ends; 0 while the first seed decides
  for (int run = 0; run < plan.seeds; ++run) {
    std::vector<Film> films;
    std::vector<double> seconds(variants.size(), 0);
    for (const Variant& variant : variants) films.push_back(make_film(variant.scene));
    for (bool going = true; going;) {
      going = false;
      double time = 0;
      for (std::size_t i = 0; i < variants.size(); ++i) {
        Film& film = films[i];
        const int samples = film.samples();
        const bool ends =
            last[i] > 0 ? samples >= last[i] : samples >= plan.spp || (samples > 1 && 2 * seconds[i] > plan.seconds);
        if (ends) {
          last[i] = samples;
          continue;
        }
        going = true;
        const int end = last[i] > 0 ? last[i] : plan.spp;
        seconds[i] +=
            seconds_of_pass(variants[i].scene, film, std::min(std::max(1, samples), end - samples), plan.execution);
        const ErrorEstimate estimate = estimate_error(film);
        measurements.push_back(
            {i, variants[i].scene.settings.seed, film.samples(), seconds[i], estimate.relmse_scaled});
        measurements.back().at_least = estimate.is_bound();
        if (reference) measurements.back().error = compare(film.mean(), *reference);
        time = std::max({time, seconds[i] / plan.seconds, static_cast<double>(film.samples()) / plan.spp});
      }
      if (report && going) report((run + std::min(time, 1.0)) / plan.seeds);
    }
    for (Variant& variant : variants) ++variant.scene.settings.seed;
  }
  for (Variant& variant : variants) variant.scene.settings.seed -= plan.seeds;
  return measurements;
}

double quantile(std::vector<double> values, double q) {
  if (values.empty()) return std::numeric_limits<double>::quiet_NaN();
  std::ranges::sort(values);
  const double place = q * static_cast<double>(values.size() - 1);
  const auto below = static_cast<std::size_t>(place);
  const double above = values[std::min(below + 1, values.size() - 1)], share = place - static_cast<double>(below);
  return share > 0 ? values[below] + share * (above - values[below]) : values[below];
}

Outcome outcome(std::span<const Measurement> measurements, std::size_t variant) {
  const auto all = by_spp(measurements, variant);
  if (all.empty()) return {};
  const auto& [spp, last] = *all.rbegin();
  const auto error = [](const Measurement& m) { return m.error ? m.error->relmse999 : m.estimate; };
  return {spp, quantile(values_of(last, [](const Measurement& m) { return m.seconds; }), 0.5),
          quantile(values_of(last, error), 0.5),
          quantile(values_of(last, [&](const Measurement& m) { return 1 / (error(m) * m.seconds); }), 0.5)};
}

Chart error_chart(std::span<const Variant> variants, std::span<const Measurement> measurements) {
  Chart chart;
  const bool compared = !measurements.empty() && measurements.front().error.has_value();
  bool bounds = false;
  for (std::size_t i = 0; i < variants.size(); ++i) {
    ChartCurve curve;
    curve.label = variants[i].label;
    for (const auto& [spp, at] : by_spp(measurements, i)) {
      ChartPoint estimate = point_of(at, [](const Measurement& m) { return m.estimate; });
      estimate.at_least = std::ranges::any_of(at, &Measurement::at_least);
      bounds = bounds || (estimate.at_least && !compared);
      curve.points.push_back(compared ? point_of(at, [](const Measurement& m) { return m.error->relmse_scaled; })
                                      : estimate);
      if (compared) curve.thin.push_back(estimate);
    }
    chart.curves.push_back(std::move(curve));
  }
  chart.x.label = "rendering time, seconds";
  chart.y.label =
      compared ? "error: relmse_scaled against the reference" : "error: relmse_scaled, estimated from two halves";
  chart.guide = "equal efficiency: the error falls as 1/time, its root as time^(−1/2)";
  chart.notes.emplace_back("Median and quartiles over seeds.");
  if (compared)
    chart.notes.emplace_back(
        "Thin line: the error as the picture's own two halves estimate it, without the reference.");
  if (bounds) chart.notes.emplace_back("Open markers: at least so much. Light that chance alone finds may be missing.");
  return chart;
}

std::string measurements_csv(std::span<const Variant> variants, std::span<const Measurement> measurements) {
  std::string csv = "method,seed,spp,seconds,relmse_scaled,relmse999,relmse_scaled_estimate\n";
  for (const auto& m : measurements) {
    csv += csv_text(variants[m.variant].name) + "," + std::to_string(m.seed) + "," + std::to_string(m.spp) + "," +
           csv_number(m.seconds) + ",";
    csv += m.error ? csv_number(m.error->relmse_scaled) + "," + csv_number(m.error->relmse999) + "," : ",,";
    csv += (std::isfinite(m.estimate) ? csv_number(m.estimate) : "") + "\n";
  }
  return csv;
}

}  // namespace glimt
