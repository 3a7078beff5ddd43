#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <numbers>
#include <set>

#include "import/import_parts.h"
#include "mesh/gltf_document.h"
#include "mesh/mesh_file.h"
#include "scene/mesh_from_file.h"
#include "scene/surroundings.h"

namespace glimt {
namespace {

using glm::dvec3;

dvec3 rgb(const std::vector<double>& values, const dvec3& otherwise) {
  return values.size() < 3 ? otherwise : dvec3{values[0], values[1], values[2]};
}

/// A number of an extension of the material.
double extended(const tinygltf::Material& m, const char* extension, const char* key, double otherwise) {
  const auto found = m.extensions.find(extension);
  if (found == m.extensions.end() || !found->second.IsObject() || !found->second.Has(key)) return otherwise;
  const tinygltf::Value& value = found->second.Get(key);
  return value.IsNumber() ? value.GetNumberAsDouble() : otherwise;
}

class GltfImport {
 public:
  explicit GltfImport(const std::filesystem::path& file)
      : file_(file), model_(parse_gltf(read_mesh_bytes(file), file)) {}

  ImportedScene run() {
    scene().name = file_.stem().string();
    for (std::size_t i = 0; i < model_.materials.size(); ++i) add_material(static_cast<int>(i));
    // What wears no material of the file.
    const std::string plain = unused_material_name(scene(), "plain");
    scene().materials.push_back(make_lambertian(plain, dvec3{0.8}));
    scene().meshes.push_back(mesh_of_file(scene(), file_, file_.stem().string(), plain, {}, true));
    drop_unused_material(plain);
    walk_nodes(model_, file_, [&](const tinygltf::Node& node, const glm::dmat4& transform) { look(node, transform); });
    const bool lit = std::ranges::any_of(scene().materials, [](const Material& m) { return m.type == "light"; });
    if (!has_camera_) scene().camera = framing(box_of(scene()));
    if (!lit) {
      add_lit_room(scene());
      if (has_camera_) note("a scene without a lamp", "a lit room around it");
    }
    return std::move(result_);
  }

 private:
  Scene& scene() { return result_.scene; }
  void note(const std::string& what, const std::string& instead) {
    const ImportNote note{file_.filename().string(), what, instead};
    if (noted_.insert(what).second) result_.notes.push_back(note);
  }

  void add_material(int index) {
    const tinygltf::Material& m = model_.materials[static_cast<std::size_t>(index)];
    const std::string name = gltf_material_name(model_, index);
    const tinygltf::PbrMetallicRoughness& pbr = m.pbrMetallicRoughness;
    if (pbr.baseColorTexture.index >= 0 || pbr.metallicRoughnessTexture.index >= 0 || m.emissiveTexture.index >= 0)
      note("material \"" + name + "\": textures", "the factors that they are multiplied by");
    if (m.alphaMode == "BLEND") note("material \"" + name + "\": alpha", "an opaque surface");
    scene().materials.push_back(material_of(m, name));
  }

  Material material_of(const tinygltf::Material& m, const std::string& name) {
    const dvec3 emission =
        rgb(m.emissiveFactor, dvec3{0}) * extended(m, "KHR_materials_emissive_strength", "emissiveStrength", 1);
    if (emission != dvec3{0}) return make_light(name, emission);
    const tinygltf::PbrMetallicRoughness& pbr = m.pbrMetallicRoughness;
    const double alpha = pbr.roughnessFactor * pbr.roughnessFactor;
    if (extended(m, "KHR_materials_transmission", "transmissionFactor", 0) > 0.5)
      return make_glass(name, extended(m, "KHR_materials_ior", "ior", 1.5), alpha);
    const dvec3 colour = rgb(pbr.baseColorFactor, dvec3{1});
    if (pbr.metallicFactor <= 0.5) return make_lambertian(name, colour);
    // With the index 1 + ik a metal reflects k^2 / (4 + k^2) straight back.
    dvec3 k{0};
    for (int i = 0; i < 3; ++i) {
      const double reflected = std::clamp(colour[i], 0.0, 0.999);
      k[i] = 2 * std::sqrt(reflected / (1 - reflected));
    }
    return make_conductor(name, dvec3{1}, k, alpha);
  }

  void drop_unused_material(const std::string& plain) {
    Mesh& mesh = scene().meshes.front();
    if (mesh.parts.empty() || std::ranges::find(mesh.parts, plain, &MeshPart::material) != mesh.parts.end()) return;
    mesh.material = mesh.parts.front().material;
    place_from_file(mesh, scene());
    std::erase_if(scene().materials, [&](const Material& m) { return m.name == plain; });
  }

  void look(const tinygltf::Node& node, const glm::dmat4& transform) {
    if (node.extensions.contains("KHR_lights_punctual"))
      note("the light of node \"" + node.name + "\", which has no size", "nothing");
    if (node.skin >= 0) note("the skin of node \"" + node.name + "\"", "the mesh as it is modelled");
    if (node.camera < 0 || static_cast<std::size_t>(node.camera) >= model_.cameras.size()) return;
    const tinygltf::Camera& camera = model_.cameras[static_cast<std::size_t>(node.camera)];
    if (has_camera_) return note("camera \"" + node.name + "\"", "the first camera");
    if (camera.type != "perspective") return note("camera \"" + node.name + "\" without perspective", "another view");
    has_camera_ = true;
    const glm::dmat3 turn(transform);
    const dvec3 eye(transform[3]);
    scene().camera = {.eye = eye,
                      .look_at = eye - normalize(turn[2]) * std::max(length(eye), 1.0),
                      .up = normalize(turn[1]),
                      .fov_y = std::clamp(camera.perspective.yfov * 180 / std::numbers::pi, 0.001, 179.0)};
    const double aspect = camera.perspective.aspectRatio;
    if (aspect >= 0.1 && aspect <= 10)
      scene().image.width = static_cast<int>(std::lround(scene().image.height * aspect));
  }

  std::filesystem::path file_;
  tinygltf::Model model_;
  ImportedScene result_;
  std::set<std::string> noted_;
  bool has_camera_ = false;
};

}  // namespace

ImportedScene import_gltf(const std::filesystem::path& file) { return GltfImport(file).run(); }

}  // namespace glimt
