#include "chart/materials.h"

#include <algorithm>

namespace glimt {

bool has_material(const Scene& scene, bool (*is)(const Material&)) {
  const auto used = [&](const auto& objects) {
    return std::ranges::any_of(objects, [&](const auto& object) {
      const Material* material = find_material(scene, object.material);
      return material && is(*material);
    });
  };
  return used(scene.spheres) || used(scene.polygons) || used(scene.meshes);
}

bool has_specular(const Scene& scene) { return has_material(scene, is_specular); }

}  // namespace glimt
