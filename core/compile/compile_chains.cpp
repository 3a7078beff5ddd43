#include <algorithm>
#include <bit>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "compile/lowering.h"
#include "material/lobes.h"
#include "scene/geometry/mesh_measures.h"

namespace glimt {

using glm::dvec3;

namespace {

/// Each costs every connection some time. Over the smaller ones caustics are found by chance.
constexpr std::size_t most_spheres = 8;

/// Whether something lies inside a ball or cuts it; what only touches it does not.
bool is_empty(const Lowering& l, const Sphere& ball) {
  const double least = ball.radius * (1 - 1e-6);
  const auto away = [&](const std::vector<dvec3>& outline) {
    return distance_to_polygon(ball.center, outline) >= least;
  };
  for (const Sphere* s : l.reach.spheres) {
    const double distance = length(s->center - ball.center);
    const bool around = distance + least <= s->radius;
    if (s != &ball && !around && distance < s->radius + least) return false;
  }
  for (const Polygon* p : l.reach.polygons)
    if (!away(p->vertices)) return false;
  for (const Mesh& m : l.reach.meshes) {
    const Box box = box_of(m);
    if (length(max(max(box.low - ball.center, ball.center - box.high), dvec3{0})) >= ball.radius) continue;
    for (const auto& t : m.triangles)
      if (!away(triangle_vertices(m, t))) return false;
  }
  return true;
}

bool is_in_room(const Lowering& l, const Sphere& ball) {
  return std::ranges::all_of(l.reach.room, [&](const RoomFace& face) {
    return face.inside.d - dot(face.inside.n, ball.center) >= ball.radius * (1 - 1e-6);
  });
}

}  // namespace

void lower_chains(Lowering& l) {
  const Settings& s = l.scene.render;
  if (s.sphere_connections == SphereConnections::off || s.light_sampling == LightSampling::none ||
      s.caustics == Caustics::off || l.out.lamps.rows() == 0)
    return;
  std::vector<ChainSphere>& chains = l.out.chain_spheres;
  for (const auto& [sphere, surface] : l.facing_spheres) {
    const auto kind = std::bit_cast<std::int32_t>(l.out.surfaces[Column::kind][surface]);
    if ((lobe_of_kind(kind) & connecting_lobes) == 0 || !is_specular(l.material(sphere->material))) continue;
    const bool glass = (lobe_of_kind(kind) & transmitting_lobes) != 0;
    if (is_in_room(l, *sphere))
      chains.push_back({to_floats(sphere->center - l.origin), static_cast<float>(sphere->radius), surface, glass,
                        glass && is_empty(l, *sphere)});
  }
  std::ranges::stable_sort(chains, std::ranges::greater{}, &ChainSphere::radius);
  chains.resize(std::min(chains.size(), most_spheres));
  for (const ChainSphere& c : chains)
    l.out.surfaces[Column::chain][c.surface] = std::bit_cast<float>(c.refracts ? 2 : 1);
}

}  // namespace glimt
