#include <string>

#include "scene/fields.h"
#include "scene/geometry/mesh_measures.h"
#include "scene/geometry/solid_overlap.h"
#include "scene/validate/validate_parts.h"

namespace glimt {
namespace {

bool is_glass(const Scene& scene, const std::string& material) { return transmits(*find_material(scene, material)); }

void check_pair(const auto& a, const std::string& a_called, const auto& b, const std::string& b_called,
                const std::string& path, Problems& problems) {
  if (overlap(a, b))
    problems.push_back(
        {path, a_called + " and " + b_called +
                   " are both of glass and overlap; allowed are glass solids that stay apart, touch, or lie one "
                   "wholly within the other"});
}

}  // namespace

void check_glass(const Scene& scene, Problems& problems) {
  for (std::size_t i = 0; i < scene.polygons.size(); ++i)
    if (const Polygon& polygon = scene.polygons[i]; is_glass(scene, polygon.material))
      problems.push_back(
          {element("polygon", i) + ".material", called("polygon", polygon.name, i) +
                                                    ": a polygon is open and cannot be of glass; allowed are spheres "
                                                    "and closed meshes"});

  std::vector<std::size_t> spheres, meshes;
  for (std::size_t i = 0; i < scene.spheres.size(); ++i)
    if (is_glass(scene, scene.spheres[i].material)) spheres.push_back(i);
  for (std::size_t i = 0; i < scene.meshes.size(); ++i) {
    if (!is_glass(scene, scene.meshes[i].material)) continue;
    if (is_closed(scene.meshes[i]))
      meshes.push_back(i);
    else
      problems.push_back(
          {element("mesh", i) + ".material",
           called("mesh", scene.meshes[i].name, i) +
               ": the mesh is open and cannot be of glass; allowed are meshes whose every edge is shared by two "
               "triangles that run along it in opposite directions"});
  }

  const auto sphere_called = [&](std::size_t i) { return called("sphere", scene.spheres[i].name, i); };
  const auto mesh_called = [&](std::size_t i) { return called("mesh", scene.meshes[i].name, i); };
  for (std::size_t k = 0; k < spheres.size(); ++k)
    for (std::size_t m = 0; m < k; ++m)
      check_pair(scene.spheres[spheres[m]], sphere_called(spheres[m]), scene.spheres[spheres[k]],
                 sphere_called(spheres[k]), element("sphere", spheres[k]), problems);
  for (std::size_t k = 0; k < meshes.size(); ++k) {
    const std::string path = element("mesh", meshes[k]), name = mesh_called(meshes[k]);
    for (const std::size_t i : spheres)
      check_pair(scene.spheres[i], sphere_called(i), scene.meshes[meshes[k]], name, path, problems);
    for (std::size_t m = 0; m < k; ++m)
      check_pair(scene.meshes[meshes[m]], mesh_called(meshes[m]), scene.meshes[meshes[k]], name, path, problems);
  }
}

}  // namespace glimt
