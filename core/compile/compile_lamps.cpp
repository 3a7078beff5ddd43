#include <algorithm>
#include <bit>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
#include <numeric>

#include "compile/near_lamps.h"

namespace glimt {

using glm::dvec3;

void add_flat_lamp(Lowering& l, const std::vector<dvec3>& v, const dvec3& normal, const Material& material,
                   int first_surface, int last_surface, int row) {
  if (!is_lamp(material)) return;
  const dvec3 radiance = material_info(material.type).radiance(material);
  auto add = [&](const LampShape& shape) { l.lamps.push_back({shape, radiance, first_surface, last_surface, row}); };
  if (is_parallelogram(v)) {
    add(ParallelogramLamp{{v[0], v[1] - v[0], v[3] - v[0], normal}});
  } else {
    for (std::size_t i = 2; i < v.size(); ++i) add(TriangleLamp{{v[0], v[i - 1] - v[0], v[i] - v[0], normal}});
  }
}

void add_sphere_lamp(Lowering& l, const dvec3& center, double radius, const Material& material, int surface) {
  if (!is_lamp(material)) return;
  const RoundLamp round{center, radius};
  const bool by_area = l.scene.render.light_sampling == LightSampling::area;
  l.lamps.push_back({by_area ? LampShape(SphereByAreaLamp{round}) : LampShape(SphereLamp{round}),
                     material_info(material.type).radiance(material), surface, surface, surface});
}

std::vector<AliasEntry> alias_table(const std::vector<double>& probability) {
  const std::size_t n = probability.size();
  std::vector<AliasEntry> table(n, {1.0, 0});
  std::vector<double> scaled(n);
  std::vector<std::size_t> small, large;
  for (std::size_t i = 0; i < n; ++i) {
    scaled[i] = probability[i] * static_cast<double>(n);
    table[i].other = i;
    (scaled[i] < 1 ? small : large).push_back(i);
  }
  while (!small.empty() && !large.empty()) {
    const std::size_t low = small.back(), high = large.back();
    small.pop_back();
    table[low] = {scaled[low], high};
    scaled[high] -= 1 - scaled[low];
    if (scaled[high] < 1) {
      large.pop_back();
      small.push_back(high);
    }
  }
  return table;
}

void lower_lamps(Lowering& l) {
  std::erase_if(l.lamps, [](const LampPiece& p) { return p.radiance == dvec3{0} || area_of(p.shape) == 0; });
  choose_lamp_sampling(l);
  std::vector<double> probability;
  for (const LampPiece& p : l.lamps)
    probability.push_back(area_of(p.shape) * (p.radiance.r + p.radiance.g + p.radiance.b));
  const double total = std::accumulate(probability.begin(), probability.end(), 0.0);
  for (double& p : probability) p /= total;
  const std::vector<AliasEntry> alias = alias_table(probability);

  Table<LampColumn> table(static_cast<int>(l.lamps.size()));
  for (std::size_t i = 0; i < l.lamps.size(); ++i) {
    const LampPiece& p = l.lamps[i];
    const TableRow<LampColumn> row{table, i};
    std::visit([&](const auto& shape) { shape.lower(LampRowWriter{row}); }, p.shape);
    row.set_int(LampColumn::shape, static_cast<std::int32_t>(p.shape.index()));
    row.set_int(LampColumn::first_surface, p.first_surface);
    row.set_int(LampColumn::last_surface, p.last_surface);
    const bool by_area = is_sampled_by_area(p.shape);
    const double area = area_of(p.shape), inverse_choice = (by_area ? area : 1) / probability[i];
    row.set3(LampColumn::weight_r, p.radiance * inverse_choice);
    row.set(LampColumn::inverse_choice, inverse_choice);
    row.set(LampColumn::area_factor, by_area ? 1 : area);
    row.set(LampColumn::alias_threshold, alias[i].threshold);
    row.set_int(LampColumn::alias_other, static_cast<int>(alias[i].other));
    l.out.has_lamp_shape[p.shape.index()] = true;
  }
  for (int surface = 0; surface < l.out.surfaces.rows(); ++surface) {
    const auto piece = std::ranges::find_if(
        l.lamps, [&](const LampPiece& p) { return p.first_surface <= surface && surface <= p.last_surface; });
    const auto row = piece == l.lamps.end() ? -1 : static_cast<int>(piece - l.lamps.begin());
    l.out.surfaces[Column::lamp][surface] = std::bit_cast<float>(row);
  }
  const auto in_tree = [](const LampPiece& p) { return p.first_surface >= first_tree_surface; };
  if (std::ranges::any_of(l.lamps, in_tree)) {
    l.out.tree_lamps.assign(l.out.tree->part.size(), -1);
    for (std::size_t i = 0; i < l.lamps.size(); ++i)
      if (in_tree(l.lamps[i]))
        l.out.tree_lamps[static_cast<std::size_t>(l.lamps[i].first_surface - first_tree_surface)] =
            static_cast<std::int32_t>(i);
  }
  l.out.lamps = std::move(table);
}

}  // namespace glimt
