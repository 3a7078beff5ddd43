#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/mat2x2.hpp>
#include <glm/matrix.hpp>
#include <limits>

#include "compile/lowering.h"
#include "scene/camera_view.h"
#include "scene/geometry/geometry_cache.h"
#include "scene/geometry/mesh_measures.h"
#include "scene/pick.h"

/// Finds where the camera sees small lamps, straight or by way of mirrors and glass: Newton's method for the place in
/// the image whose ray meets the middle of the lamp. What it does not find is left to chance, so nothing here decides
/// what a picture shows.
namespace glimt {

using glm::dvec2;
using glm::dvec3;

namespace {

constexpr double small_lamp = 1;              ///< radius as seen straight, pixels: camera rays find larger ones
constexpr std::size_t most_lamps = 64;        ///< of more, chance finds one or another
constexpr std::size_t most_images = 16;       ///< each costs every camera ray a comparison
constexpr std::size_t most_tests = 1u << 22;  ///< of rays against shapes, so that edits stay swift
constexpr int most_surfaces = 8, most_steps = 20;

dvec3 normal_at(const Scene& scene, const ObjectId& object, const dvec3& p) {
  if (object.kind == ObjectKind::sphere) return normalize(p - scene.spheres[object.index].center);
  if (object.kind == ObjectKind::polygon) return plane_of(scene.polygons[object.index].vertices).n;
  const Mesh& mesh = scene.meshes[object.index];
  const auto nearest = std::ranges::min_element(
      mesh.triangles, {}, [&](const auto& t) { return distance_to_polygon(p, triangle_vertices(mesh, t)); });
  return plane_of(triangle_vertices(mesh, *nearest)).n * (signed_volume(mesh) < 0 ? -1.0 : 1.0);
}

double ior_of(const Scene& scene, const ObjectId& object) {
  return object.kind == ObjectKind::sphere ? relative_ior(scene, scene.spheres[object.index])
                                           : relative_ior(scene, scene.meshes[object.index]);
}

/// The way on from a mirror or through glass; nothing where all is reflected inside. `n`: outward.
std::optional<dvec3> way_on(const dvec3& d, const dvec3& n, bool glass, double ior) {
  if (!glass) return d - n * (2 * dot(d, n));
  const bool enters = dot(d, n) < 0;
  const dvec3 up = enters ? n : -n;
  const double ratio = enters ? 1 / ior : ior, cos = -dot(d, up), square = 1 - ratio * ratio * (1 - cos * cos);
  if (square < 0) return {};
  return d * ratio + up * (ratio * cos - std::sqrt(square));
}

class Search {
 public:
  explicit Search(const Lowering& l) : scene_(l.scene), view_(scene_.camera, scene_.image), lift_(l.reach.tolerance) {}

  const CameraView& view() const { return view_; }

  /// From a camera ray to a point, where it comes nearest.
  dvec3 miss(const dvec2& place, const dvec3& target, double radius) const {
    WorldRay ray{view_.eye, normalize(view_.direction(place))};
    dvec3 least{std::numeric_limits<double>::infinity()};
    for (int k = 0; k < most_surfaces; ++k) {
      const auto hit = pick(scene_, ray);
      const double end = hit ? hit->distance : std::numeric_limits<double>::infinity();
      const double along = std::clamp(dot(target - ray.origin, ray.direction), 0.0, end + radius);
      const dvec3 way = target - (ray.origin + ray.direction * along);
      if (!(dot(way, way) >= dot(least, least))) least = way;
      const Material* material = hit ? find_material(scene_, material_name_of(scene_, hit->object)) : nullptr;
      if (material == nullptr || !is_specular(*material)) break;
      const bool glass = transmits(*material);
      const dvec3 p = ray.origin + ray.direction * hit->distance;
      const auto on =
          way_on(ray.direction, normal_at(scene_, hit->object, p), glass, glass ? ior_of(scene_, hit->object) : 1);
      if (!on) break;
      ray = {p + *on * lift_, normalize(*on)};
    }
    return least;
  }

  /// Around the image of a ball, by Newton's method from `place`, in pixels.
  std::optional<LampImage> image(dvec2 place, const dvec3& center, double radius) const {
    constexpr double h = 1e-5;
    const double margin = 0x1p-18 * std::max(scene_.image.width, scene_.image.height);
    for (int step = 0; step < most_steps; ++step) {
      const dvec3 here = miss(place, center, radius);
      const dvec3 dx = (miss(place + dvec2{h, 0}, center, radius) - here) / h,
                  dy = (miss(place + dvec2{0, h}, center, radius) - here) / h;
      const glm::dmat2 square{{dot(dx, dx), dot(dx, dy)}, {dot(dx, dy), dot(dy, dy)}};
      if (!(std::abs(determinant(square)) > 1e-12 * dot(dx, dx) * dot(dy, dy))) return {};
      const glm::dmat2 inverse = glm::inverse(square);
      const dvec2 by = inverse * dvec2{dot(dx, here), dot(dy, here)};
      const dvec2 half{1.25 * radius * std::sqrt(inverse[0][0]) + margin,
                       1.25 * radius * std::sqrt(inverse[1][1]) + margin};
      if (std::abs(by.x) < 0.1 * half.x && std::abs(by.y) < 0.1 * half.y) {
        if (length(here) > radius || half.x > 2 * small_lamp || half.y > 2 * small_lamp) return {};
        return LampImage{place.x - half.x, place.y - half.y, place.x + half.x, place.y + half.y};
      }
      const double far = 0.25 * scene_.image.width;
      place -= by * std::min(1.0, far / length(by));
      if (!(std::abs(place.x) < 4.0 * scene_.image.width && std::abs(place.y) < 4.0 * scene_.image.height)) return {};
    }
    return {};
  }

 private:
  const Scene& scene_;
  CameraView view_;
  double lift_;  ///< off a surface, metres
};

/// Points to look at first, so that Newton's method finds each image: the lamp, where flat mirrors show it, and faces
/// of glass.
std::vector<dvec3> first_looks(const Lowering& l, const dvec3& lamp) {
  std::vector<dvec3> looks{lamp};
  std::vector<HalfSpace> mirrors;
  for (const Polygon& p : l.scene.polygons)
    if (is_specular(l.material(p.material))) mirrors.push_back(plane_of(p.vertices));
  for (const Mesh& m : l.scene.meshes) {
    const Material& material = l.material(m.material);
    if (!is_specular(material)) continue;
    for (const auto& t : m.triangles) {
      const std::vector<dvec3> v = triangle_vertices(m, t);
      if (!transmits(material)) {
        mirrors.push_back(plane_of(v));
      } else {
        looks.push_back((v[0] + v[1] + v[2]) / 3.0);
      }
    }
  }
  for (const Sphere& s : l.scene.spheres)
    if (is_specular(l.material(s.material))) looks.push_back(s.center);
  const auto mirrored = [](const dvec3& p, const HalfSpace& h) { return p - h.n * (2 * (dot(h.n, p) - h.d)); };
  for (const HalfSpace& first : mirrors) {
    looks.push_back(mirrored(lamp, first));
    for (const HalfSpace& second : mirrors) looks.push_back(mirrored(mirrored(lamp, first), second));
  }
  return looks;
}

bool overlap(const LampImage& a, const LampImage& b) {
  return a.x0 < b.x1 && b.x0 < a.x1 && a.y0 < b.y1 && b.y0 < a.y1;
}

/// Adds a rectangle; those that overlap become one around both.
void add_image(std::vector<LampImage>& images, LampImage image) {
  for (auto other = images.begin(); other != images.end();) {
    if (!overlap(image, *other)) {
      ++other;
      continue;
    }
    image = {std::min(image.x0, other->x0), std::min(image.y0, other->y0), std::max(image.x1, other->x1),
             std::max(image.y1, other->y1)};
    images.erase(other);
    other = images.begin();
  }
  images.push_back(image);
}

std::size_t shapes_in(const Scene& scene) {
  std::size_t count = scene.spheres.size() + scene.polygons.size();
  for (const Mesh& m : scene.meshes) count += m.triangles.size();
  return count;
}

}  // namespace

void find_lamp_images(Lowering& l) {
  const Settings& settings = l.scene.render;
  // What one asks for with these is another picture.
  if (settings.sampler == Sampler::centres || settings.caustics == Caustics::only) return;
  const Search search(l);
  std::vector<LampImage>& images = l.out.lamp_images;
  std::size_t lamps = 0, tests = 0;
  const std::size_t tests_each = shapes_in(l.scene) * most_surfaces * most_steps * 3;
  if (std::ranges::any_of(l.scene.meshes, is_large)) return;
  for (LampPiece& lamp : l.lamps) {
    const LampBody body = body_of(lamp.shape);
    const dvec3 center = body.middle() + l.origin;
    double radius = body.radius;
    for (const dvec3& v : body.outline) radius = std::max(radius, length(v - body.middle()));
    const double distance = length(center - search.view().eye);
    if (radius > small_lamp * distance * search.view().pixel || ++lamps > most_lamps) continue;
    lamp.looked_for = true;
    for (const dvec3& look : first_looks(l, center)) {
      const auto place = search.view().project(look);
      if (!place) continue;
      if ((tests += tests_each) > most_tests + tests_each) {
        lamp.looked_for = false;
        break;
      }
      const auto image = search.image(*place, center, radius);
      if (image && image->x1 > 0 && image->y1 > 0 && image->x0 < l.out.width && image->y0 < l.out.height)
        add_image(images, *image);
    }
  }
  if (images.size() > most_images) {
    images.resize(most_images);
    for (LampPiece& lamp : l.lamps) lamp.looked_for = false;
  }
  if (!images.empty())
    l.out.compiled_in.push_back(std::to_string(images.size()) + (images.size() == 1 ? " place" : " places") +
                                " in the image where small lamps are seen, looked at with more rays");
}

}  // namespace glimt
