#include <algorithm>
#include <bit>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>
#include <numbers>

#include "compile/lowering.h"

namespace glimt {

using glm::dvec3;

BoundingSphere bounding_sphere(const std::vector<dvec3>& vertices) {
  dvec3 low{std::numeric_limits<double>::infinity()}, high = -low;
  for (const dvec3& v : vertices) {
    low = min(low, v);
    high = max(high, v);
  }
  const dvec3 center = (low + high) / 2.0;
  double radius = 0;
  for (const dvec3& v : vertices) radius = std::max(radius, length(v - center));
  return {center, radius};
}

void add_object(Lowering& l, const Material& material, const BoundingSphere& bounds, int first_surface,
                int last_surface) {
  if (is_specular(material)) l.targets.push_back({bounds, first_surface, last_surface});
  const dvec3 radiance = material_info(material.type).radiance(material);
  if (radiance != dvec3{0}) l.emitting.push_back({radiance, first_surface, last_surface});
}

namespace {

/// A rough guess, never 0 where some light arrives, of the integral of the cosine at the lamp over the directions to
/// the target, steradians.
double seen_cosine(const LampPiece& lamp, const BoundingSphere& target) {
  const LampBody body = body_of(lamp.shape);
  const bool sphere = body.round();
  const dvec3 way = target.center - body.middle();
  const double distance = length(way);
  const double height = sphere ? distance : dot(body.normal, way);
  if (!sphere && height <= -target.radius) return 0;
  const double sin2 = std::min(1.0, target.radius * target.radius / std::max(distance * distance, 1e-300));
  const double cone = 2 * std::numbers::pi * sin2 / (1 + std::sqrt(1 - sin2));
  const double cosine = sphere ? 0.25 : std::max(height / distance, 0.1);
  return std::min(cone * cosine, std::numbers::pi);
}

}  // namespace

void lower_aims(Lowering& l) {
  CompiledScene& out = l.out;
  for (int surface = 0; surface < out.surfaces.rows(); ++surface)
    out.surfaces[Column::target][surface] = std::bit_cast<float>(-1);
  for (std::size_t k = 0; k < l.targets.size(); ++k)
    for (int s = l.targets[k].first_surface; s <= l.targets[k].last_surface; ++s)
      out.surfaces[Column::target][s] = std::bit_cast<float>(static_cast<std::int32_t>(k));

  struct Aim {
    std::size_t lamp, target;
    double flux;  ///< guessed, all channels
  };
  std::vector<Aim> aims;
  double flux = 0, flux_times_radiance = 0;
  for (std::size_t i = 0; i < l.lamps.size(); ++i)
    for (std::size_t k = 0; k < l.targets.size(); ++k) {
      const dvec3& radiance = l.lamps[i].radiance;
      const double sum = radiance.r + radiance.g + radiance.b;
      const double guess = sum * area_of(l.lamps[i].shape) * seen_cosine(l.lamps[i], l.targets[k].bounds);
      if (!(guess > 0)) continue;
      aims.push_back({i, k, guess});
      flux += guess;
      flux_times_radiance += guess * sum;
    }
  const Settings& settings = l.scene.render;
  // Light paths do not know what a cutaway hides from the camera.
  if (aims.empty() || settings.light_paths == 0 || settings.caustics == Caustics::off || out.cutaway) return;
  out.light_paths = static_cast<int>(std::ceil(settings.light_paths * out.width * out.height));
  out.light_path_noise = static_cast<float>(flux * flux / (flux_times_radiance * std::numbers::pi * out.light_paths));

  std::vector<double> probability;
  probability.reserve(aims.size());
  for (const Aim& aim : aims) probability.push_back(aim.flux / flux);
  const std::vector<AliasEntry> alias = alias_table(probability);
  out.aims = Table<AimColumn>(static_cast<int>(aims.size()));
  for (std::size_t i = 0; i < aims.size(); ++i) {
    const LampPiece& lamp = l.lamps[aims[i].lamp];
    const BoundingSphere& bounds = l.targets[aims[i].target].bounds;
    const TableRow<AimColumn> row{out.aims, i};
    row.set_int(AimColumn::lamp, static_cast<std::int32_t>(aims[i].lamp));
    row.set3(AimColumn::center_x, bounds.center);
    row.set(AimColumn::radius, bounds.radius);
    row.set_int(AimColumn::target, static_cast<std::int32_t>(aims[i].target));
    row.set3(AimColumn::weight_r, lamp.radiance * (area_of(lamp.shape) / probability[i] / out.light_paths));
    row.set(AimColumn::alias_threshold, alias[i].threshold);
    row.set_int(AimColumn::alias_other, static_cast<std::int32_t>(alias[i].other));
  }
}

}  // namespace glimt
