#pragma once

#include "scene/compiled_scene.h"
#include "scene/reach.h"

/// The parts of compile(): each lowers one kind of object into `out`.
namespace glimt {

/// A row of CompiledScene::surfaces before their number is known.
struct Surface {
  const Material* material;
  glm::dvec3 normal_or_center;  ///< compiled space
  double inverse_radius = 0;
  double eta = 1;
};

/// A piece of a lamp, in compiled space.
struct LampPiece {
  LampShape shape;
  glm::dvec3 p, e1, e2, normal;  ///< sphere: centre, (radius, 0, 0)
  glm::dvec3 radiance;
  int first_surface, last_surface;
};

struct Lowering {
  const Scene& scene;
  Reach reach;
  glm::dvec3 origin{0};  ///< of compiled space, in world space
  std::vector<Surface> surfaces;
  std::vector<LampPiece> lamps;
  CompiledScene out;

  const Material& material(const std::string& name) const {
    return scene.materials[static_cast<std::size_t>(material_index(scene, name))];
  }
  /// Index of the new row.
  int add_surface(const Surface& s) {
    surfaces.push_back(s);
    return static_cast<int>(surfaces.size()) - 1;
  }
};

std::array<float, 3> to_floats(const glm::dvec3& v);

/// True for four vertices of a parallelogram, in order.
bool is_parallelogram(const std::vector<glm::dvec3>& v);

void lower_meshes(Lowering& l);

/// The refractive index of the glass of that object over the index of the medium around it: 1, or that of the smallest
/// glass solid that holds the object.
double relative_ior(const Scene& scene, const Sphere& sphere);
double relative_ior(const Scene& scene, const Mesh& mesh);

/// Pieces of a flat lamp whose front is the side of `normal`; vertices in compiled space.
void add_flat_lamp(Lowering& l, const std::vector<glm::dvec3>& vertices, const glm::dvec3& normal,
                   const Material& material, int first_surface, int last_surface);

/// The lamp table from the pieces gathered, each chosen with a probability in proportion to its power.
void lower_lamps(Lowering& l);

/// Warnings for scenes in which the chosen estimators cannot hold.
void warn(Lowering& l);

}  // namespace glimt
