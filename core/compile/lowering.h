#pragma once

#include "compile/build_tree.h"
#include "compile/compiled_scene.h"
#include "compile/reach.h"
#include "lamp/list.h"
#include "scene/fields.h"

/// The parts of compile(): each lowers one kind of object into `out`.
namespace glimt {

/// A row of CompiledScene::surfaces before their number is known.
struct Surface {
  const Material* material;
  glm::dvec3 normal_or_center;  ///< compiled space
  double inverse_radius = 0;
  double eta = 1;
};

/// A piece of a lamp: a row of the lamp table.
struct LampPiece {
  LampShape shape;
  glm::dvec3 radiance;
  int first_surface, last_surface;  ///< its own, which cannot hide it
  int row;                          ///< in the surface table, of one of them
  bool looked_for = false;          ///< where it is seen in the image is known; see find_lamp_images()
};

/// A ball around something, in compiled space.
struct BoundingSphere {
  glm::dvec3 center;
  double radius;
};

/// A mirror or glass that light paths may be aimed at.
struct Target {
  BoundingSphere bounds;
  int first_surface, last_surface;
};

/// The surfaces of an object that is a lamp or glows.
struct Emitting {
  glm::dvec3 radiance;
  int first_surface, last_surface;
};

/// A sphere that is met from outside.
struct FacingSphere {
  const Sphere* sphere;
  int surface;
};

struct Lowering {
  const Scene& scene;
  Reach reach;
  glm::dvec3 origin{0};  ///< of compiled space, in world space
  std::vector<Surface> surfaces;
  std::vector<LampPiece> lamps;
  std::vector<Target> targets;
  std::vector<Emitting> emitting;
  std::vector<FacingSphere> facing_spheres;
  std::vector<TreePart> tree_parts;
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

/// Which shapes go into a tree instead of into lists.
struct TreePlan {
  bool polygons = false, triangles = false, small_solids = false;

  /// Whether the mesh may become a solid, if it is closed and convex.
  bool may_be_solid(const Mesh& mesh) const;
};
/// By how many there are of each; see compile().
TreePlan plan_tree(const Lowering& l, std::size_t most_listed);

/// A polygon, but for lamps, whose row in the surface table is `row`.
void add_to_tree(Lowering& l, const Polygon& polygon, int row);
/// The triangles of a mesh.
void add_to_tree(Lowering& l, const Mesh& mesh, int row, bool inside_out);

/// Closed convex meshes, other meshes, and the polygons that belong into the tree.
void lower_meshes(Lowering& l, const TreePlan& plan);

/// The refractive index of the glass of that object over the index of the medium around it: 1, or that of the smallest
/// glass solid that holds the object.
double relative_ior(const Scene& scene, const Sphere& sphere);
double relative_ior(const Scene& scene, const Mesh& mesh);

/// Pieces of a flat lamp whose front is the side of `normal`; vertices in compiled space.
void add_flat_lamp(Lowering& l, const std::vector<glm::dvec3>& vertices, const glm::dvec3& normal,
                   const Material& material, int first_surface, int last_surface, int row);

void add_sphere_lamp(Lowering& l, const glm::dvec3& center, double radius, const Material& material, int surface);

/// The lamp table from the pieces gathered, each chosen with a probability in proportion to its power.
void lower_lamps(Lowering& l);

struct AliasEntry {
  double threshold;
  std::size_t other;
};
/// Vose, "A linear algorithm for generating random numbers with a given distribution" (1991).
std::vector<AliasEntry> alias_table(const std::vector<double>& probability);

BoundingSphere bounding_sphere(const std::vector<glm::dvec3>& vertices);
/// Notes an object for light paths if it is specular, and for lower_chance() if it emits.
void add_object(Lowering& l, const Material& material, const BoundingSphere& bounds, int first_surface,
                int last_surface);
/// The table that light paths begin from, and how many there are; after lower_lamps().
void lower_aims(Lowering& l);

/// The spheres over which diffuse surfaces are connected to lamps; after lower_lamps().
void lower_chains(Lowering& l);

/// Pixels that look at edges of lamps.
void mark_lamp_edges(Lowering& l);

/// Where in the image small lamps are seen.
void find_lamp_images(Lowering& l);

/// Which light is left to chance, also in words; after all techniques have been lowered.
void lower_chance(Lowering& l);

/// Warnings for scenes in which the chosen estimators cannot hold.
void warn(Lowering& l);

}  // namespace glimt
