#include "compile/near_lamps.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <numbers>

#include "scene/geometry/geometry_cache.h"
#include "scene/geometry/mesh_measures.h"

namespace glimt {

using glm::dvec3;

namespace {

/// Of lamps and surfaces: more are not compared with each other.
constexpr std::size_t most_pairs = 1u << 18;
/// Of a lamp's size: where a matt surface is nearer, `auto` samples the lamp by solid angle.
constexpr double near_lamp = 0.2;

}  // namespace

double NearPiece::area() const { return radius > 0 ? 4 * std::numbers::pi * radius * radius : glimt::area_of(outline); }

double NearPiece::bound() const {
  double far = radius;
  for (const dvec3& v : outline) far = std::max(far, length(v - outline[0]));
  return far;
}

std::vector<NearPiece> pieces_in_reach(const Lowering& l) {
  std::vector<NearPiece> all;
  for (const RoomFace& face : l.reach.room)
    all.push_back({face.outline, 0, &l.scene.materials[static_cast<std::size_t>(face.material)], "the room's wall"});
  for (const Polygon* p : l.reach.polygons) all.push_back({p->vertices, 0, &l.material(p->material), p->name});
  for (const Mesh& m : l.reach.meshes)
    if (!is_large(m))
      for (const auto& t : m.triangles) all.push_back({triangle_vertices(m, t), 0, &l.material(m.material), m.name});
  for (const Sphere* s : l.reach.spheres) all.push_back({{s->center}, s->radius, &l.material(s->material), s->name});
  return all;
}

namespace {

double distance_between_segments(const dvec3& a, const dvec3& b, const dvec3& c, const dvec3& d) {
  // Where the lines come nearest, if that is on both; else an end of one is nearest.
  const dvec3 u = b - a, v = d - c, w = a - c;
  const double uu = dot(u, u), uv = dot(u, v), vv = dot(v, v), determinant = uu * vv - uv * uv;
  if (determinant > 1e-12 * uu * vv) {
    const double s = (uv * dot(v, w) - vv * dot(u, w)) / determinant,
                 t = (uu * dot(v, w) - uv * dot(u, w)) / determinant;
    if (s >= 0 && s <= 1 && t >= 0 && t <= 1) return length(w + u * s - v * t);
  }
  return std::min({distance_to_segment(a, c, d), distance_to_segment(b, c, d), distance_to_segment(c, a, b),
                   distance_to_segment(d, a, b)});
}

/// Between two convex polygons.
double distance_between_polygons(const std::vector<dvec3>& a, const std::vector<dvec3>& b) {
  double nearest = std::numeric_limits<double>::infinity();
  for (const dvec3& p : a) nearest = std::min(nearest, distance_to_polygon(p, b));
  for (const dvec3& p : b) nearest = std::min(nearest, distance_to_polygon(p, a));
  for (std::size_t i = 0; i < a.size(); ++i)
    for (std::size_t k = 0; k < b.size(); ++k)
      nearest = std::min(nearest, distance_between_segments(a[i], a[(i + 1) % a.size()], b[k], b[(k + 1) % b.size()]));
  return nearest;
}

/// How near what the lamp lights comes to it, metres; infinite where that is clearly farther than `limit`. Both in
/// world space.
double lit_distance(const LampBody& lamp, const NearPiece& piece, double limit) {
  constexpr double far = std::numeric_limits<double>::infinity();
  const dvec3 &p = lamp.outline[0], first = piece.outline[0];
  double size = lamp.radius;
  for (const dvec3& v : lamp.outline) size = std::max(size, length(v - p));
  if (length(first - p) - piece.bound() - size > limit) return far;
  if (lamp.round())
    return (piece.radius > 0 ? length(p - first) - piece.radius : distance_to_polygon(p, piece.outline)) - lamp.radius;
  // What is in the lamp's plane or behind it gets no light from it.
  if (piece.radius > 0)
    return dot(lamp.normal, first - p) + piece.radius > 1e-6 * size
               ? distance_to_polygon(first, lamp.outline) - piece.radius
               : far;
  const std::vector<dvec3> lit = clip(piece.outline, {-lamp.normal, -dot(lamp.normal, p) - 1e-6 * size});
  return lit.empty() ? far : distance_between_polygons(lit, lamp.outline);
}

bool is_rectangle(const FlatLamp& lamp) {
  return std::abs(dot(lamp.edge_1, lamp.edge_2)) <= 1e-9 * length(lamp.edge_1) * length(lamp.edge_2);
}

/// Whether the lamp of this piece has no other, so that MIS can tell its density.
bool is_whole(const Lowering& l, const LampPiece& piece) {
  return std::ranges::count_if(l.lamps, [&](const LampPiece& other) {
           return other.first_surface <= piece.last_surface && piece.first_surface <= other.last_surface;
         }) == 1;
}

/// The same lamp in shapes that are sampled by solid angle; `split`: in two, where it must be.
std::vector<LampShape> by_solid_angle(const LampShape& shape, bool split) {
  if (const auto* flat = std::get_if<ParallelogramLamp>(&shape)) {
    if (is_rectangle(*flat)) return {RectangleLamp{*flat}};
    if (!split) return {shape};
    const TriangleLamp half{*flat},
        other{{flat->corner + flat->edge_1 + flat->edge_2, -flat->edge_1, -flat->edge_2, flat->normal}};
    return {TriangleBySolidAngleLamp{half}, TriangleBySolidAngleLamp{other}};
  }
  if (const auto* triangle = std::get_if<TriangleLamp>(&shape)) return {TriangleBySolidAngleLamp{*triangle}};
  return {shape};
}

}  // namespace

const NearPiece* nearly_touched(const Lowering& l, const LampPiece& lamp, const std::vector<NearPiece>& pieces,
                                double share) {
  if (l.lamps.size() * pieces.size() > most_pairs) return nullptr;
  const double limit = share * std::sqrt(area_of(lamp.shape));
  LampBody body = body_of(lamp.shape);
  for (dvec3& v : body.outline) v += l.origin;
  const auto near = std::ranges::find_if(pieces, [&](const NearPiece& piece) {
    return is_diffuse(*piece.material) && brightest(*piece.material) > 0 && lit_distance(body, piece, limit) <= limit;
  });
  return near == pieces.end() ? nullptr : &*near;
}

void choose_lamp_sampling(Lowering& l) {
  const Settings& s = l.scene.render;
  const bool automatic = s.light_sampling == LightSampling::automatic;
  if (s.light_sampling != LightSampling::solid_angle && !automatic) return;
  std::vector<const LampPiece*> near;
  if (automatic && s.mis == Mis::off) {
    const std::vector<NearPiece> pieces = pieces_in_reach(l);
    for (const LampPiece& lamp : l.lamps)
      if (is_sampled_by_area(lamp.shape) && nearly_touched(l, lamp, pieces, near_lamp) != nullptr)
        near.push_back(&lamp);
    if (!near.empty()) {
      // It makes up for pieces of one lamp that are chosen by their power, not by how near they are, and takes noise
      // off the others.
      l.out.settings.mis = Mis::on;
      l.out.compiled_in.push_back(
          "MIS and solid-angle sampling, for " + std::to_string(near.size()) +
          (near.size() == 1 ? " piece of a lamp near to what it lights" : " pieces of lamps near to what they light"));
    }
  }
  const bool mis = l.out.settings.mis == Mis::on;
  std::vector<LampPiece> chosen;
  for (const LampPiece& lamp : l.lamps) {
    const bool asked = automatic ? std::ranges::find(near, &lamp) != near.end() : is_sampled_by_area(lamp.shape);
    if (!asked || (mis && !is_whole(l, lamp))) {
      chosen.push_back(lamp);
      continue;
    }
    for (const LampShape& shape : by_solid_angle(lamp.shape, !mis))
      chosen.push_back({shape, lamp.radiance, lamp.first_surface, lamp.last_surface, lamp.row});
  }
  l.lamps = std::move(chosen);
}

}  // namespace glimt
