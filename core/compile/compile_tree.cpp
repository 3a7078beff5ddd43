#include "compile/lowering.h"

#include <algorithm>

namespace glimt {
namespace {

/// Fewer polygons, and planes of solids, than this stay in their lists beside a tree.
constexpr std::size_t few = 64;
/// Closed convex meshes of up to so many triangles count as solids.
constexpr std::size_t small_solid = 32;

}  // namespace

TreePlan plan_tree(const Lowering& l, std::size_t most_listed) {
  std::size_t triangles = 0, solids = 0;
  for (const Mesh& m : l.reach.meshes) (m.triangles.size() <= small_solid ? solids : triangles) += m.triangles.size();
  const std::size_t polygons = l.reach.polygons.size();
  const bool smooth = std::ranges::any_of(l.reach.meshes, [](const Mesh& m) { return m.smooth; });
  if (triangles + solids + polygons <= most_listed && !smooth) return {};
  return {.polygons = polygons > few, .triangles = true, .small_solids = solids > few};
}

bool TreePlan::may_be_solid(const Mesh& mesh) const {
  return !triangles || (!small_solids && !mesh.smooth && mesh.triangles.size() <= small_solid);
}

void add_to_tree(Lowering& l, const Polygon& polygon, int row) {
  std::vector<std::array<int, 3>> fan;
  for (int i = 1; i + 1 < static_cast<int>(polygon.vertices.size()); ++i) fan.push_back({0, i, i + 1});
  l.tree_parts.push_back({polygon.vertices, std::move(fan), {}});
  l.out.tree_rows.push_back(row);
}

void add_to_tree(Lowering& l, const Mesh& mesh, int row, bool inside_out) {
  const bool smooth = mesh.smooth && !is_lamp(l.material(mesh.material));
  l.tree_parts.push_back({mesh.vertices, mesh.triangles, mesh.normals, smooth, inside_out});
  l.out.tree_rows.push_back(row);
}

}  // namespace glimt
