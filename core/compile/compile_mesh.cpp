#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <iterator>

#include "compile/lowering.h"
#include "scene/file/text.h"
#include "scene/geometry/mesh_measures.h"

namespace glimt {

using glm::dvec3;

namespace {

bool same_plane(const HalfSpace& a, const HalfSpace& b, double tolerance) {
  return dot(a.n, b.n) > 1 - 1e-9 && std::abs(a.d - b.d) <= tolerance;
}

/// Those of more are not looked at, which would take long.
constexpr std::size_t most_solid_triangles = 1024;

/// The planes of a closed convex mesh, n outward; empty where it is not one.
std::vector<HalfSpace> convex_planes(const Mesh& mesh) {
  if (mesh.triangles.size() > most_solid_triangles || !is_closed(mesh)) return {};
  dvec3 middle{0};
  for (const dvec3& v : mesh.vertices) middle += v / static_cast<double>(mesh.vertices.size());
  double size = 0;
  for (const dvec3& v : mesh.vertices) size = std::max(size, length(v - middle));
  const double tolerance = 1e-9 * (size + length(middle));
  std::vector<HalfSpace> planes;
  for (const auto& t : mesh.triangles) {
    HalfSpace h = plane_of(triangle_vertices(mesh, t));
    if (dot(h.n, middle) > h.d) h = {-h.n, -h.d};
    for (const dvec3& v : mesh.vertices)
      if (dot(h.n, v) > h.d + tolerance) return {};
    if (std::none_of(planes.begin(), planes.end(), [&](const HalfSpace& p) { return same_plane(p, h, tolerance); }))
      planes.push_back(h);
  }
  // Fewer bound nothing.
  return planes.size() < 4 ? std::vector<HalfSpace>{} : planes;
}

/// Lamps of more triangles go into the tree, where there is one.
constexpr std::size_t most_listed_lamps = 64;

/// Where a solid stands on a side of the room, the room's plane does the work: with both, rounding would choose.
bool in_wall(const Lowering& l, const HalfSpace& face) {
  return std::ranges::any_of(l.reach.room,
                             [&](const RoomFace& wall) { return same_plane(wall.inside, face, l.reach.tolerance); });
}

/// Closed convex meshes become planes where that gives the same hits. Returns false where it does not.
bool lower_convex(Lowering& l, const Mesh& mesh, const Material& material, double eta, int first_surface) {
  const std::vector<HalfSpace> planes = convex_planes(mesh);
  if (planes.empty()) return false;
  const bool glass = transmits(material);
  const auto& inside = l.reach.inside;
  const bool around =
      inside && std::ranges::all_of(planes, [&](const HalfSpace& h) { return dot(h.n, *inside) < h.d; });
  if (around && !glass) return false;                              // opaque solids of planes are hit from outside only
  if (is_lamp(material) && signed_volume(mesh) < 0) return false;  // shines inwards

  Solid solid{static_cast<int>(l.out.solid_planes.size()), 0, first_surface, 0, glass};
  for (const HalfSpace& h : planes) {
    if (in_wall(l, h)) {
      l.out.left_out.push_back("a face of " + toml_string(mesh.name) + ", in the plane of a wall");
      continue;
    }
    const int surface = l.add_surface({&material, h.n, 0, eta});
    const auto n = to_floats(h.n);
    l.out.solid_planes.push_back({n[0], n[1], n[2], static_cast<float>(h.d - dot(h.n, l.origin)), surface});
  }
  solid.last = static_cast<int>(l.out.solid_planes.size());
  solid.last_surface = static_cast<int>(l.surfaces.size()) - 1;
  l.out.solids.push_back(solid);
  l.out.compiled_in.push_back(toml_string(mesh.name) + " as " + std::to_string(solid.last - solid.first) + " planes");
  return true;
}

void lower_triangles(Lowering& l, const Mesh& mesh, const Material& material, double eta, bool inside_out) {
  for (const auto& t : mesh.triangles) {
    const std::vector<dvec3> v = triangle_vertices(mesh, t);
    const dvec3 n = plane_of(v).n * (inside_out ? -1.0 : 1.0);
    const int surface = l.add_surface({&material, n, 0, eta});
    l.out.triangles.push_back({to_floats(v[0] - l.origin), to_floats(v[1] - v[0]), to_floats(v[2] - v[0]), surface});
  }
  l.out.compiled_in.push_back(toml_string(mesh.name) + " as " + std::to_string(mesh.triangles.size()) + " triangles");
}

void add_lamp_triangles(Lowering& l, const Mesh& mesh, const Material& material, int row, auto surfaces_of) {
  if (!is_lamp(material)) return;
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    std::vector<dvec3> v = triangle_vertices(mesh, mesh.triangles[i]);
    const dvec3 n = plane_of(v).n;
    for (dvec3& p : v) p -= l.origin;
    const auto [first, last] = surfaces_of(static_cast<int>(i));
    add_flat_lamp(l, v, n, material, first, last, row);
  }
}

/// Without the triangles that lie in walls.
void drop_in_walls(const Lowering& l, Mesh& mesh) {
  const auto hidden = [&](const auto& t) {
    const HalfSpace plane = plane_of(triangle_vertices(mesh, t));
    return in_wall(l, plane) || in_wall(l, {-plane.n, -plane.d});
  };
  // What comes near to no wall is in none.
  const auto near = [&](const RoomFace& wall) {
    const Box box = box_of(mesh);
    const dvec3 n = wall.inside.n, farthest{n.x > 0 ? box.high.x : box.low.x, n.y > 0 ? box.high.y : box.low.y,
                                            n.z > 0 ? box.high.z : box.low.z};
    return dot(n, farthest) > wall.inside.d - 2 * l.reach.tolerance;
  };
  if (std::ranges::any_of(l.reach.room, near) && std::ranges::any_of(mesh.triangles, hidden)) {
    std::vector<std::array<int, 3>> rest;
    std::ranges::remove_copy_if(mesh.triangles, std::back_inserter(rest), hidden);
    mesh.triangles = std::move(rest);
  }
}

}  // namespace

void lower_meshes(Lowering& l, const TreePlan& plan) {
  struct TreeLamp {
    const Mesh* mesh;
    const Material* material;
    std::size_t part;
  };
  std::vector<TreeLamp> tree_lamps;
  for (Mesh& mesh : l.reach.meshes) {
    const Material& material = l.material(mesh.material);
    const double eta = transmits(material) ? relative_ior(l.scene, mesh) : 1;
    const int first_surface = static_cast<int>(l.surfaces.size());
    const bool convex = plan.may_be_solid(mesh) && lower_convex(l, mesh, material, eta, first_surface);
    const bool inside_out = transmits(material) && signed_volume(mesh) < 0;
    if (!convex) drop_in_walls(l, mesh);
    const std::size_t listed = is_lamp(material) ? most_listed_lamps : 0;
    const bool in_tree = !convex && plan.triangles && mesh.triangles.size() > listed;
    if (in_tree) {
      l.add_surface({&material, dvec3{0}, 0, eta});
      add_to_tree(l, mesh, first_surface, inside_out);
    } else if (!convex) {
      lower_triangles(l, mesh, material, eta, inside_out);
    }
    const int last_surface = static_cast<int>(l.surfaces.size()) - 1;
    BoundingSphere bounds{};
    if (is_specular(material)) {
      std::vector<dvec3> vertices = mesh.vertices;
      for (dvec3& v : vertices) v -= l.origin;
      bounds = bounding_sphere(vertices);
    }
    add_object(l, material, bounds, first_surface, last_surface);
    if (in_tree && is_lamp(material)) {
      tree_lamps.push_back({&mesh, &material, l.tree_parts.size() - 1});
      continue;
    }
    // A convex lamp cannot hide its own front; other meshes can, but for the triangle itself.
    add_lamp_triangles(l, mesh, material, first_surface, [&](int i) {
      return convex ? std::pair(first_surface, last_surface) : std::pair(first_surface + i, first_surface + i);
    });
  }
  if (l.tree_parts.empty()) return;
  l.out.tree = tree_of(l.tree_parts, l.origin);
  const TriangleTree& tree = *l.out.tree;
  for (const auto& [mesh, material, part] : tree_lamps) {
    std::vector<int> surface_of(mesh->triangles.size());
    for (std::size_t place = 0; place < tree.part.size(); ++place)
      if (tree.part[place] == static_cast<std::int32_t>(part))
        surface_of[static_cast<std::size_t>(tree.triangle[place])] = first_tree_surface + static_cast<int>(place);
    add_lamp_triangles(l, *mesh, *material, l.out.tree_rows[part], [&](int i) {
      const int own = surface_of[static_cast<std::size_t>(i)];
      return std::pair(own, own);
    });
  }
}

}  // namespace glimt
