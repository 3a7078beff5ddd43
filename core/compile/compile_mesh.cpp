#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "compile/lowering.h"
#include "scene/file/text.h"
#include "scene/geometry/mesh_measures.h"

namespace glimt {

using glm::dvec3;

namespace {

bool same_plane(const HalfSpace& a, const HalfSpace& b, double tolerance) {
  return dot(a.n, b.n) > 1 - 1e-9 && std::abs(a.d - b.d) <= tolerance;
}

/// The planes of a closed convex mesh, n outward; empty where it is not one.
std::vector<HalfSpace> convex_planes(const Mesh& mesh) {
  if (!is_closed(mesh)) return {};
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

}  // namespace

void lower_meshes(Lowering& l) {
  for (Mesh& mesh : l.reach.meshes) {
    const Material& material = l.material(mesh.material);
    const double eta = transmits(material) ? relative_ior(l.scene, mesh) : 1;
    const int first_surface = static_cast<int>(l.surfaces.size());
    const bool convex = lower_convex(l, mesh, material, eta, first_surface);
    if (!convex) {
      const bool inside_out = transmits(material) && signed_volume(mesh) < 0;
      std::erase_if(mesh.triangles, [&](const auto& t) {
        const HalfSpace plane = plane_of(triangle_vertices(mesh, t));
        return in_wall(l, plane) || in_wall(l, {-plane.n, -plane.d});
      });
      lower_triangles(l, mesh, material, eta, inside_out);
    }
    const int last_surface = static_cast<int>(l.surfaces.size()) - 1;
    std::vector<dvec3> vertices = mesh.vertices;
    for (dvec3& v : vertices) v -= l.origin;
    add_object(l, material, bounding_sphere(vertices), first_surface, last_surface);
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
      std::vector<dvec3> v = triangle_vertices(mesh, mesh.triangles[i]);
      const dvec3 n = plane_of(v).n;
      for (dvec3& p : v) p -= l.origin;
      // A convex lamp cannot hide its own front; other meshes can, but for the triangle itself.
      const int own = first_surface + static_cast<int>(i);
      add_flat_lamp(l, v, n, material, convex ? first_surface : own, convex ? last_surface : own);
    }
  }
}

}  // namespace glimt
