#include "import/import_parts.h"
#include "scene/mesh_from_file.h"
#include "scene/surroundings.h"

namespace glimt {

ImportedScene import_mesh(const std::filesystem::path& file) {
  ImportedScene result;
  Scene& scene = result.scene;
  scene.name = file.stem().string();
  scene.materials.push_back(make_lambertian("clay", {0.7, 0.6, 0.5}));
  scene.meshes.push_back(mesh_of_file(scene, file, file.stem().string(), "clay", {}, false));
  Mesh& mesh = scene.meshes.back();
  mesh.smooth = !mesh.file->data->normals.empty();
  if (mesh.smooth) place_from_file(mesh, scene);
  scene.camera = framing(box_of(scene));
  add_lit_room(scene);
  return result;
}

}  // namespace glimt
