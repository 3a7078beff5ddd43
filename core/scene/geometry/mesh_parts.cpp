#include "scene/geometry/mesh_parts.h"

#include <algorithm>
#include <utility>

namespace glimt {
namespace {

/// Adds triangles of `whole` to `triangles`, and their vertices where they have none in `place` yet.
class PartBuilder {
 public:
  explicit PartBuilder(const Mesh& whole) : whole_(whole), place_(whole.vertices.size(), -1) {}

  void add(const MeshPart& part) {
    for (int i = part.first; i < part.first + part.count; ++i) {
      std::array<int, 3> triangle = whole_.triangles[static_cast<std::size_t>(i)];
      for (int& corner : triangle) corner = added(corner);
      triangles_.push_back(triangle);
    }
  }

  Mesh finish(const std::string& material) {
    Mesh mesh{.name = whole_.name, .material = material};
    mesh.vertices = std::move(vertices_);
    mesh.triangles = std::move(triangles_);
    mesh.normals = std::move(normals_);
    mesh.smooth = whole_.smooth;
    return mesh;
  }

 private:
  int added(int vertex) {
    const auto from = static_cast<std::size_t>(vertex);
    if (place_[from] < 0) {
      place_[from] = static_cast<int>(vertices_.size());
      vertices_.push_back(whole_.vertices[from]);
      if (!whole_.normals.empty()) normals_.push_back(whole_.normals[from]);
    }
    return place_[from];
  }

  const Mesh& whole_;
  std::vector<int> place_;
  std::vector<glm::dvec3> vertices_, normals_;
  std::vector<std::array<int, 3>> triangles_;
};

}  // namespace

std::vector<Mesh> by_material(const Mesh& mesh) {
  if (mesh.parts.empty()) return {mesh};
  std::vector<Mesh> meshes;
  std::vector<std::string> done;
  for (const MeshPart& part : mesh.parts) {
    if (std::ranges::find(done, part.material) != done.end()) continue;
    done.push_back(part.material);
    PartBuilder builder(mesh);
    for (const MeshPart& other : mesh.parts)
      if (other.material == part.material) builder.add(other);
    meshes.push_back(builder.finish(part.material));
  }
  return meshes;
}

}  // namespace glimt
