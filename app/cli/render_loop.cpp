#include "cli/render_loop.h"

#include <algorithm>
#include <chrono>
#include <cmath>

#include "film/statistics.h"

namespace glimt {
namespace {

constexpr double least_pass_seconds = 0.1;
constexpr double pass_share = 20;      // a pass over what any number of samples takes of it
constexpr int first_check = 8;         // samples before the estimate can be trusted as a goal
constexpr double estimate_share = 50;  // rendering time over the time that estimates for display take

double seconds_of(const std::function<void()>& work) {
  const auto start = std::chrono::steady_clock::now();
  work();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

/// Samples at which to check the error next: where it should be reached, given that it falls as 1 / samples.
int next_check(int samples, double estimate, double wanted) {
  const double expected = std::ceil(samples * estimate / wanted);
  return static_cast<int>(std::clamp(expected, samples + std::max(1.0, samples / 32.0), 2.0 * samples));
}

/// The number of samples that takes the given time, at least one.
int samples_in(double seconds, double sample_seconds) {
  return static_cast<int>(std::clamp(seconds / sample_seconds, 1.0, 1e9));
}

}  // namespace

Rendering render_to(const Goal& goal, const CompiledScene& scene, Film& film, const RenderSamples& render,
                    const std::atomic<bool>& stop, const AfterPass& after, const Rendering& begun) {
  Rendering result = begun;
  result.next_check = std::max(begun.next_check, first_check);
  film.go_on_from(goal.samples.first);
  const double pixels = static_cast<double>(film.width()) * film.height();
  ErrorEstimate estimate;
  double estimate_seconds = 0, estimated_at = 0;
  const bool unlit = scene.max_radiance == 0;  // black is right at once
  int count = 0;                               // of the last pass
  double sample_seconds = 0, pass_seconds = least_pass_seconds;
  while (true) {
    const double seconds_left = goal.seconds - result.seconds;
    const bool checked = goal.relmse_scaled > 0 && film.samples() >= result.next_check;
    const bool shown = after.report && goal.relmse_scaled == 0 && film.samples() >= 2 &&
                       result.seconds - estimated_at >= estimate_share * estimate_seconds;
    if (checked || shown) {
      estimate_seconds = seconds_of([&] { estimate = estimate_error(film); });
      estimated_at = result.seconds;
    }
    const bool error_reached = checked && (estimate.at_most() <= goal.relmse_scaled || unlit);
    if (checked && !error_reached)
      result.next_check = next_check(film.samples(), estimate.at_most(), goal.relmse_scaled);
    result.reached = film.samples() >= goal.samples.count || seconds_left <= sample_seconds / 2 || error_reached;

    if (after.report && count > 0) {
      const double samples = film.samples();
      double samples_needed = goal.samples.count;
      if (goal.relmse_scaled > 0) samples_needed = std::max(samples, samples * estimate.at_most() / goal.relmse_scaled);
      const double left = std::min(seconds_left, (samples_needed - samples) * sample_seconds);
      const double total = result.seconds + left;
      after.report({result.reached ? 1.0 : result.seconds / total, film.samples(), result.seconds, std::max(left, 0.0),
                    pixels * samples / result.seconds, estimate.relmse_scaled, estimate.is_bound()});
    }
    if (result.reached || (stop && film.samples() > 0)) return result;
    if (count > 0 && after.save) after.save(result);

    // The next pass relies on the speed of the last one, so it has at most four times as many samples.
    count =
        count == 0
            ? 1
            : std::min({samples_in(pass_seconds, sample_seconds), 4 * count, samples_in(seconds_left, sample_seconds)});
    count = std::min({count, goal.samples.count - film.samples(), film.missing().count});
    if (goal.relmse_scaled > 0) count = std::min(count, result.next_check - film.samples());
    double fixed_seconds = 0;
    const double pass = seconds_of([&] { fixed_seconds = render(film, count); });
    pass_seconds = std::max(least_pass_seconds, pass_share * fixed_seconds);
    result.seconds = std::round((result.seconds + pass) * 1e9) / 1e9;
    sample_seconds = pass / count;
  }
}

}  // namespace glimt
