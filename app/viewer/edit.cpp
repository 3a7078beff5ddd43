#include "viewer/edit.h"

#include <algorithm>
#include <string>
#include <utility>

namespace glimt {
namespace {

/// How many things of the scene wear the material.
std::size_t users(const Scene& scene, const std::string& material) {
  const auto count = [&](const auto& things) {
    return static_cast<std::size_t>(
        std::count_if(things.begin(), things.end(), [&](const auto& thing) { return thing.material == material; }));
  };
  return count(scene.spheres) + count(scene.polygons) + count(scene.meshes);
}

std::string unused_name(const Scene& scene, const std::string& wish) {
  std::string name = wish;
  for (int n = 2; find_material(scene, name) != nullptr; ++n) name = wish + "-" + std::to_string(n);
  return name;
}

}  // namespace

void set_sphere_material(Scene& scene, std::size_t sphere, Material material) {
  Sphere& target = scene.spheres.at(sphere);
  if (users(scene, target.material) > 1) {
    material.name = unused_name(scene, target.name.empty() ? "sphere-" + std::to_string(sphere) : target.name);
    target.material = material.name;
    scene.materials.push_back(std::move(material));
    return;
  }
  const auto own = std::find_if(scene.materials.begin(), scene.materials.end(),
                                [&](const Material& m) { return m.name == target.material; });
  material.name = own->name;
  *own = std::move(material);
}

}  // namespace glimt
