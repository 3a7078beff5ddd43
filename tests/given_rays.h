#pragma once

#include <glm/geometric.hpp>

#include "compile/compiled_scene.h"
#include "kernel/entry/kernels.h"
#include "scene_parts.h"
#include "statistics_helpers.h"

namespace glimt {

/// Green radiance of one path along the ray from `eye` in the unit direction `w`.
inline double trace_green(const CompiledScene& scene, const dvec3& eye, const dvec3& w, int pixel, int sample,
                          Lanes lanes = Lanes::scalar) {
  const GivenPath path{
      {eye.x, eye.y, eye.z}, {w.x, w.y, w.z}, static_cast<std::uint32_t>(pixel), static_cast<std::uint32_t>(sample)};
  return static_cast<double>(trace_ray(scene, path, lanes).g);
}

/// Green radiance along the ray from `eye` to `point`, from 16 groups of paths. All samples of a pixel are in one
/// group, because they may share a sequence. So the groups are independent.
inline Estimate radiance_at(const CompiledScene& scene, const dvec3& eye, const dvec3& point, int paths) {
  constexpr int samples = 64;  ///< per pixel
  const dvec3 w = normalize(point - eye);
  std::vector<double> groups(16);
  const int each = (paths + 15) / 16;
  for (int g = 0; g < 16; ++g)
    for (int i = 0; i < each; ++i)
      groups[static_cast<std::size_t>(g)] += trace_green(scene, eye, w, g + 16 * (i / samples), i % samples) / each;
  return estimate(groups);
}

}  // namespace glimt
