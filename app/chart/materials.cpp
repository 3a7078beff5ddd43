#include "chart/materials.h"

#include <algorithm>

#include "scene/fields.h"

namespace glimt {

bool is_used(const Scene& scene, const std::string& material) {
  const auto used = [&](const auto& objects) {
    return std::ranges::any_of(objects, [&](const auto& object) { return object.material == material; });
  };
  const auto worn = [&](const Mesh& mesh) {
    if (mesh.parts.empty()) return mesh.material == material;
    return std::ranges::find(mesh.parts, material, &MeshPart::material) != mesh.parts.end();
  };
  return used(scene.spheres) || used(scene.polygons) || std::ranges::any_of(scene.meshes, worn);
}

bool has_specular(const Scene& scene) {
  return std::ranges::any_of(scene.materials,
                             [&](const Material& m) { return is_specular(m) && is_used(scene, m.name); });
}

}  // namespace glimt
