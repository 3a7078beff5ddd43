#include "scene/scene.h"

#include <algorithm>

namespace glimt {

const Material* find_material(const Scene& scene, const std::string& name) {
  const auto it = std::ranges::find(scene.materials, name, &Material::name);
  return it == scene.materials.end() ? nullptr : &*it;
}

}  // namespace glimt
