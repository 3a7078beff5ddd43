#include "film/unseen.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "film/statistics.h"

namespace glimt {
namespace {

/// With this many hits, the two halves tell the error of the light by themselves.
constexpr double enough_hits = 20;

constexpr std::array<const char*, chance_ways> way_names{"thin lamps", "lamps in mirrors and glass",
                                                         "light of lamps on surfaces", "caustics in mirrors and glass"};

bool is_mirrored(std::size_t way) {
  return way == static_cast<std::size_t>(ChanceWay::mirrored) ||
         way == static_cast<std::size_t>(ChanceWay::lit_and_mirrored);
}

/// Names of the ways for which f(way) is true.
template <class Predicate>
std::string names_of(Predicate f) {
  std::string text;
  for (std::size_t way = 0; way < chance_ways; ++way)
    if (f(way)) text += (text.empty() ? "" : ", ") + std::string(way_names[way]);
  return text;
}

}  // namespace

double missing_events(double found) {
  // The Poisson probability of 0 ... found events; for a fractional `found`, interpolated between its neighbours.
  const auto at_most = [&](double mean) {
    double term = std::exp(-mean), sum = 0;
    const double whole = std::floor(found);
    for (double k = 0; k <= whole; term *= mean / ++k) sum += term;
    return sum + (found - whole) * term;
  };
  double low = found, high = found + 3 + 3 * std::sqrt(found);
  for (int i = 0; i < 50; ++i) {
    const double middle = (low + high) / 2;
    (at_most(middle) > 0.05 ? low : high) = middle;
  }
  return low - found;
}

Unseen unseen_light(const Film& film, double picture_mean) {
  const double paths = static_cast<double>(film.width()) * film.height() * film.samples();
  if (film.emitters().empty() || !(paths > 0)) return {};
  std::array<double, chance_ways> missing{};  ///< mean radiance over the picture
  for (std::size_t i = 0; i < film.emitters().size(); ++i) {
    const Emitter& emitter = film.emitters()[i];
    for (std::size_t way = 0; way < chance_ways; ++way) {
      const double hits = static_cast<double>(film.by_chance()[i * chance_ways + way]) / chance_unit;
      if (emitter.is_left(way) && hits < enough_hits) missing[way] += missing_events(hits) * emitter.radiance / paths;
    }
  }
  double all = 0, mirrored = 0;
  for (std::size_t way = 0; way < chance_ways; ++way) {
    all += missing[way];
    if (is_mirrored(way)) mirrored += missing[way];
  }
  if (!(all > 0)) return {};
  const double total = picture_mean + all;
  const auto relmse_of = [&](double part) { return part / (2 * std::sqrt(scaled_dark(total))); };
  const double mirror_paths = static_cast<double>(film.by_chance().back());
  const double mirror_pixels = (mirror_paths + 3 + 2 * std::sqrt(mirror_paths)) / paths;  // upper bound in 95 of 100
  const double relmse = std::min(relmse_of(mirrored), mirror_pixels) + relmse_of(all - mirrored);
  return {all / total, std::min(relmse, 1.0), names_of([&](std::size_t way) { return missing[way] > 0; })};
}

std::string light_by_chance(const std::vector<Emitter>& emitters) {
  return names_of(
      [&](std::size_t way) { return std::ranges::any_of(emitters, [&](const Emitter& e) { return e.is_left(way); }); });
}

}  // namespace glimt
