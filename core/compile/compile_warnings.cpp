#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <numbers>

#include "compile/lowering.h"
#include "scene/file/text.h"
#include "scene/geometry/mesh_measures.h"

/// Where the chosen estimators cannot hold. Each criterion is one that a person can check in the scene; the tests in
/// tests/stability/ show what happens beyond it.
namespace glimt {

using glm::dvec3;

namespace {

/// Reflectance from which on constant roulette has infinite variance: weights grow by rho / 0.75 at each hit, and rho^2
/// / 0.75 > 1 makes the sum of their squares diverge.
constexpr double constant_limit = 0.866;
/// The same for roulette by throughput, whose survival is at most 0.99.
constexpr double throughput_limit = 0.995;
/// Of a lamp's size: a reflecting surface nearer than this is as good as touched.
constexpr double near_lamp = 0.01;
/// Of all surfaces: chance finds smaller lamps about once in more than ten thousand tries.
constexpr double tiny_lamps = 1e-4;
/// Of lamps and surfaces: more are not compared with each other, so that edits stay swift.
constexpr std::size_t most_pairs = 1u << 18;

const Material& material_of(const Lowering& l, int index) { return l.scene.materials[static_cast<std::size_t>(index)]; }

double brightest(const Material& m) {
  const dvec3 albedo = material_info(m.type).albedo(m);
  return std::max({albedo.r, albedo.g, albedo.b});
}

/// A flat or round piece of what is in reach, in world space.
struct Piece {
  std::vector<dvec3> outline;  ///< of a sphere its centre
  double radius;               ///< of a sphere, else 0
  const Material* material;
  std::string_view name;

  double area() const { return radius > 0 ? 4 * std::numbers::pi * radius * radius : glimt::area_of(outline); }
  /// Of a ball about outline[0] that holds it.
  double bound() const {
    double far = radius;
    for (const dvec3& v : outline) far = std::max(far, length(v - outline[0]));
    return far;
  }
};

std::vector<Piece> pieces_in_reach(const Lowering& l) {
  std::vector<Piece> all;
  for (const RoomFace& face : l.reach.room)
    all.push_back({face.outline, 0, &material_of(l, face.material), "the room's wall"});
  for (const Polygon* p : l.reach.polygons) all.push_back({p->vertices, 0, &l.material(p->material), p->name});
  for (const Mesh& m : l.reach.meshes)
    for (const auto& t : m.triangles) all.push_back({triangle_vertices(m, t), 0, &l.material(m.material), m.name});
  for (const Sphere* s : l.reach.spheres) all.push_back({{s->center}, s->radius, &l.material(s->material), s->name});
  return all;
}

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

/// From a point to a convex polygon.
double distance_between_polygons(const std::vector<dvec3>& a, const std::vector<dvec3>& b) {
  double nearest = std::numeric_limits<double>::infinity();
  for (const dvec3& p : a) nearest = std::min(nearest, distance_to_polygon(p, b));
  for (const dvec3& p : b) nearest = std::min(nearest, distance_to_polygon(p, a));
  for (std::size_t i = 0; i < a.size(); ++i)
    for (std::size_t k = 0; k < b.size(); ++k)
      nearest = std::min(nearest, distance_between_segments(a[i], a[(i + 1) % a.size()], b[k], b[(k + 1) % b.size()]));
  return nearest;
}

/// How near what the lamp lights comes to it, metres; infinite where that is clearly farther than `limit`.
double lit_distance(const LampPiece& lamp, const dvec3& origin, const Piece& piece, double limit) {
  constexpr double far = std::numeric_limits<double>::infinity();
  const dvec3 p = lamp.p + origin, first = piece.outline[0];
  const double size = lamp.shape == LampShape::sphere_by_area ? lamp.e1.x : length(lamp.e1) + length(lamp.e2);
  if (length(first - p) - piece.bound() - size > limit) return far;
  if (lamp.shape == LampShape::sphere_by_area)
    return (piece.radius > 0 ? length(p - first) - piece.radius : distance_to_polygon(p, piece.outline)) - lamp.e1.x;
  std::vector<dvec3> outline{p, p + lamp.e1, p + lamp.e1 + lamp.e2, p + lamp.e2};
  if (lamp.shape == LampShape::triangle) outline.erase(outline.begin() + 2);
  // What is in the lamp's plane or behind it gets no light from it.
  if (piece.radius > 0)
    return dot(lamp.normal, first - p) + piece.radius > 1e-6 * size ? distance_to_polygon(first, outline) - piece.radius
                                                                    : far;
  const std::vector<dvec3> lit = clip(piece.outline, {-lamp.normal, -dot(lamp.normal, p) - 1e-6 * size});
  return lit.empty() ? far : distance_between_polygons(lit, outline);
}

void warn_of_near_lamps(Lowering& l, const std::vector<Piece>& pieces) {
  const Settings& s = l.out.settings;
  if (s.light_sampling == LightSampling::none || s.mis == Mis::on || l.lamps.size() * pieces.size() > most_pairs)
    return;
  for (const LampPiece& lamp : l.lamps) {
    if (lamp.shape == LampShape::sphere || lamp.shape == LampShape::rectangle) continue;
    const double limit = near_lamp * std::sqrt(area_of(lamp));
    for (const Piece& piece : pieces) {
      if (!is_diffuse(*piece.material) || brightest(*piece.material) == 0 ||
          lit_distance(lamp, l.origin, piece, limit) > limit)
        continue;
      l.out.warnings.push_back(
          "a lamp that is sampled by area touches or nearly touches " + toml_string(piece.name) +
          ": the noise in the corner between them will not go away; choose light_sampling = \"solid-angle\" (for "
          "rectangles and spheres) or mis = \"on\"");
      return;
    }
  }
}

void warn_of_tiny_lamps(Lowering& l, const std::vector<Piece>& pieces) {
  if (l.out.settings.light_sampling != LightSampling::none || l.lamps.empty()) return;
  double lamps = 0, all = 0;
  for (const LampPiece& lamp : l.lamps) lamps += area_of(lamp);
  for (const Piece& piece : pieces) all += piece.area();
  if (lamps < tiny_lamps * all)
    l.out.warnings.emplace_back(
        "without light sampling, lamps that make up less than 1/10000 of all surfaces are hardly ever found: the image "
        "will be dark with a few bright dots; choose light_sampling = \"auto\"");
}

void warn_of_roulette(Lowering& l) {
  if (l.out.settings.roulette == Roulette::constant) {
    const bool bright = std::any_of(l.surfaces.begin(), l.surfaces.end(), [](const Surface& s) {
      return is_diffuse(*s.material) && brightest(*s.material) > constant_limit;
    });
    if (bright)
      l.out.warnings.emplace_back(
          "constant roulette (survival 0.75) has infinite variance where a reflectance is above 0.866 = sqrt(0.75): "
          "the "
          "noise will not go away; choose roulette = \"throughput\"");
    return;
  }
  // What of the light that falls on the room's walls is reflected, if it comes from everywhere alike.
  double reflected = 0, all = 0;
  for (const RoomFace& face : l.reach.room) {
    const Material& m = material_of(l, face.material);
    const double area = glimt::area_of(face.outline);
    all += area;
    reflected += brightest(m) * area;
  }
  if (reflected > throughput_limit * all)
    l.out.warnings.emplace_back(
        "the room's walls reflect more than 0.995 of the light: roulette, by which at most 0.99 of the paths go on, "
        "has "
        "infinite variance there, and the noise will not go away");
}

}  // namespace

void warn(Lowering& l) {
  const Settings& s = l.out.settings;
  if (l.out.max_radiance == 0) l.out.warnings.emplace_back("nothing in reach emits light: the image will be black");
  const std::vector<Piece> pieces = pieces_in_reach(l);
  warn_of_near_lamps(l, pieces);
  warn_of_tiny_lamps(l, pieces);
  warn_of_roulette(l);
  if (s.mis == Mis::on && s.light_sampling == LightSampling::none)
    l.out.warnings.emplace_back("mis = \"on\" changes nothing without light sampling");
  const int side = static_cast<int>(std::ceil(std::sqrt(s.spp)));
  if (s.sampler == Sampler::centres && side * side != s.spp)
    l.out.warnings.push_back("sampler = \"centres\" with " + std::to_string(s.spp) +
                             " samples a pixel, no square number, leaves out some of its " + std::to_string(side) +
                             "x" + std::to_string(side) + " sub-pixels");
}

}  // namespace glimt
