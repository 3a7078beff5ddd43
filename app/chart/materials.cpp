#include "chart/materials.h"

#include <algorithm>

#include "scene/fields.h"

namespace glimt {

bool is_used(const Scene& scene, const std::string& material) {
  const auto used = [&](const auto& objects) {
    return std::ranges::any_of(objects, [&](const auto& object) { return object.material == material; });
  };
  return used(scene.spheres) || used(scene.polygons) || used(scene.meshes);
}

bool has_specular(const Scene& scene) {
  return std::ranges::any_of(scene.materials,
                             [&](const Material& m) { return is_specular(m) && is_used(scene, m.name); });
}

}  // namespace glimt
