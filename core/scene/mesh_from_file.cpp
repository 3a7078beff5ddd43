#include "scene/mesh_from_file.h"

#include <cmath>
#include <utility>

#include "scene/fields.h"

namespace glimt {
namespace {

bool is_usable(const Placement& placement) {
  for (const glm::dvec3& v : {placement.scale, placement.rotate, placement.translate})
    for (int i = 0; i < 3; ++i)
      if (!(std::abs(v[i]) <= max_coordinate)) return false;
  return placement.scale.x != 0 && placement.scale.y != 0 && placement.scale.z != 0;
}

std::vector<MeshPart> parts_of(const MeshFile& file, const Scene& scene, const std::string& material) {
  std::vector<MeshPart> parts;
  for (const MeshGroup& group : file.data->groups) {
    const auto named = file.materials.find(group.material);
    const std::string& own = named != file.materials.end()          ? named->second
                             : find_material(scene, group.material) ? group.material
                                                                    : material;
    if (!parts.empty() && parts.back().material == own)
      parts.back().count += group.count;
    else
      parts.push_back({own, group.first, group.count});
  }
  if (parts.size() == 1 && parts[0].material == material) parts.clear();
  return parts;
}

}  // namespace

void place_from_file(Mesh& mesh, const Scene& scene) {
  const MeshFile& file = *mesh.file;
  PlacedMesh placed = place(*file.data, is_usable(file.placement) ? file.placement : Placement{}, mesh.smooth);
  mesh.vertices = std::move(placed.vertices);
  mesh.triangles = std::move(placed.triangles);
  mesh.normals = std::move(placed.normals);
  name_parts(mesh, scene);
}

void name_parts(Mesh& mesh, const Scene& scene) { mesh.parts = parts_of(*mesh.file, scene, mesh.material); }

}  // namespace glimt
