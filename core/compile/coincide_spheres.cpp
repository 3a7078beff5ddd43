#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <map>
#include <numeric>
#include <set>

#include "compile/coincide.h"
#include "scene/fields.h"
#include "scene/file/text.h"
#include "scene/surroundings.h"

namespace glimt {

bool separate_coincident_spheres(Scene& scene, const Reach& reach, CoincidenceNotes& notes) {
  const Box box = box_of(scene);
  const auto size = [&](const Sphere& s) {
    return local_size(box, length(s.center - (box.low + box.high) / 2.0) + s.radius);
  };
  std::vector<std::size_t> order(scene.spheres.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::stable_sort(order, {}, [&](std::size_t i) { return scene.spheres[i].center.x; });
  // By the first of each group.
  std::map<std::size_t, std::set<std::size_t>> groups;
  for (std::size_t i = 0; i < order.size(); ++i)
    for (std::size_t k = i + 1; k < order.size(); ++k) {
      const auto [low, high] = std::minmax({order[i], order[k]});
      const Sphere &a = scene.spheres[low], &b = scene.spheres[high];
      if (scene.spheres[order[k]].center.x - scene.spheres[order[i]].center.x > coincident_distance * size(a)) break;
      if (std::max(length(a.center - b.center), std::abs(a.radius - b.radius)) <= coincident_distance * size(a))
        groups[low].insert(high);
    }
  std::set<std::size_t> repeated;
  std::string first_repeated, first_pair;
  std::size_t pairs = 0;
  for (const auto& [first, others] : groups) {
    if (repeated.contains(first)) continue;
    std::vector<std::size_t> shells{first};
    for (const std::size_t i : others) {
      if (repeated.contains(i)) continue;
      const auto same = std::ranges::find_if(
          shells, [&](std::size_t k) { return scene.spheres[k].material == scene.spheres[i].material; });
      if (same == shells.end()) {
        shells.push_back(i);
        continue;
      }
      if (repeated.empty())
        first_repeated = toml_string(scene.spheres[i].name) + ", the same as " + toml_string(scene.spheres[*same].name);
      repeated.insert(i);
    }
    if (shells.size() < 2) continue;
    const auto level = [&](std::size_t i) {
      const Material& m = *find_material(scene, scene.spheres[i].material);
      return is_lamp(m) ? 2 : transmits(m) ? 1 : 0;
    };
    std::ranges::stable_sort(shells, {}, level);
    const bool around =
        reach.inside && length(*reach.inside - scene.spheres[first].center) < scene.spheres[first].radius;
    for (std::size_t k = 1; k < shells.size(); ++k) {
      if (pairs++ == 0)
        first_pair = toml_string(scene.spheres[shells[0]].name) + " and " + toml_string(scene.spheres[shells[k]].name);
      scene.spheres[shells[k]].radius = scene.spheres[shells[0]].radius + static_cast<double>(k) * least_gap *
                                                                              size(scene.spheres[first]) *
                                                                              (around ? -1 : 1);
    }
  }
  if (!repeated.empty())
    notes.warnings.push_back(std::to_string(repeated.size()) + (repeated.size() == 1 ? " sphere is" : " spheres are") +
                             " there twice and left out once; the first: " + first_repeated);
  if (pairs > 0)
    notes.told.push_back(std::to_string(pairs) + (pairs == 1 ? " pair" : " pairs") +
                         " of spheres that coincide, moved apart; the first: " + first_pair);
  std::size_t next = 0;
  std::erase_if(scene.spheres, [&](const Sphere&) { return repeated.contains(next++); });
  return !repeated.empty() || pairs > 0;
}

}  // namespace glimt
