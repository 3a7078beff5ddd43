#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "kernel/entry/kernels.h"
#include "scene_parts.h"
#include "statistics_helpers.h"

namespace glimt {

/// Statistics of the radiance that many paths along one ray bring, in one channel.
struct Samples {
  Estimate mean;      ///< from 32 groups of paths
  double second = 0;  ///< mean square
  double smallest = 0, largest = 0;
  int lit = 0;  ///< number of paths that bring any light

  double relative_variance() const { return second / (mean.mean * mean.mean) - 1; }
};

/// Traces paths from `eye` along `direction`.
inline Samples samples_along(const CompiledScene& scene, const dvec3& eye, const dvec3& direction, int paths,
                             float Rgb::*channel = &Rgb::g) {
  constexpr std::size_t groups = 32;
  std::vector<double> sums(groups);
  Samples s{{}, 0, 1e300, 0, 0};
  for (int i = 0; i < paths; ++i) {
    const GivenPath path{{eye.x, eye.y, eye.z},
                         {direction.x, direction.y, direction.z},
                         static_cast<std::uint32_t>(i % 1009),
                         static_cast<std::uint32_t>(i / 1009)};
    const auto value = static_cast<double>(trace_ray(scene, path, Lanes::scalar).*channel);
    sums[static_cast<std::size_t>(i) % groups] += value * groups / paths;
    s.second += value * value / paths;
    s.smallest = std::min(s.smallest, value), s.largest = std::max(s.largest, value);
    s.lit += value > 0;
  }
  s.mean = estimate(sums);
  return s;
}

/// Irradiance at `point` from a polygon of radiance 1 wholly above the horizon (Lambert 1760). Each edge and the point
/// span a plane. Sum, over the edges, the angle under which the edge is seen times the component of that plane's unit
/// normal along `normal`; then divide by 2.
inline double lambert_irradiance(const std::vector<dvec3>& polygon, const dvec3& point, const dvec3& normal) {
  double sum = 0;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const dvec3 a = polygon[i] - point, b = polygon[(i + 1) % polygon.size()] - point, c = cross(a, b);
    if (length(c) > 0) sum += std::atan2(length(c), dot(a, b)) * dot(c, normal) / length(c);
  }
  return std::abs(sum) / 2;
}

/// Fresnel's reflectance of unpolarised light, in double precision.
inline double fresnel_exact(double cos_i, double eta) {
  const double sin2_t = (1 - cos_i * cos_i) / (eta * eta);
  if (sin2_t >= 1) return 1;
  const double cos_t = std::sqrt(1 - sin2_t);
  const double s = (cos_i - eta * cos_t) / (cos_i + eta * cos_t), p = (eta * cos_i - cos_t) / (eta * cos_i + cos_t);
  return (s * s + p * p) / 2;
}

}  // namespace glimt
