#include <algorithm>
#include <bit>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <limits>
#include <numbers>

#include "compile/coincide.h"
#include "compile/eye.h"
#include "compile/lowering.h"
#include "material/lobes.h"
#include "scene/file/scene_file.h"
#include "scene/file/text.h"
#include "scene/geometry/mend.h"
#include "scene/geometry/mesh_measures.h"
#include "scene/surroundings.h"
#include "scene/validate/validate.h"

namespace glimt {

using glm::dvec3;

constexpr double infinity = std::numeric_limits<double>::infinity();

std::array<float, 3> to_floats(const dvec3& v) {
  return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)};
}

bool is_parallelogram(const std::vector<dvec3>& v) {
  return v.size() == 4 && length(v[0] + v[2] - v[1] - v[3]) <= 1e-9 * length(v[2] - v[0]);
}

namespace {

PinholeCamera lower_camera(const Scene& scene, const dvec3& origin) {
  const Camera& c = scene.camera;
  const dvec3 forward = normalize(c.look_at - c.eye);
  const dvec3 right = normalize(cross(forward, c.up));
  const dvec3 up = cross(right, forward);
  // A pixel's size on the plane at distance 1.
  const double pixel = 2 * std::tan(glm::radians(c.fov_y) / 2) / scene.image.height;
  const dvec3 corner = forward - right * (pixel * scene.image.width / 2) + up * (pixel * scene.image.height / 2);
  return {to_floats(c.eye - origin), to_floats(corner),  to_floats(right * pixel),
          to_floats(up * -pixel),    to_floats(forward), static_cast<float>(pixel * pixel)};
}

/// Centre of the bounding box of what is kept.
dvec3 centre_of(const Reach& reach) {
  dvec3 low{infinity}, high{-infinity};
  auto include = [&](const dvec3& v) {
    low = min(low, v);
    high = max(high, v);
  };
  for (const RoomFace& face : reach.room) std::for_each(face.outline.begin(), face.outline.end(), include);
  if (reach.room.empty()) {
    for (const Polygon* p : reach.polygons) std::for_each(p->vertices.begin(), p->vertices.end(), include);
    for (const Mesh& m : reach.meshes) include(box_of(m).low), include(box_of(m).high);
    for (const Sphere* s : reach.spheres) {
      include(s->center - s->radius);
      include(s->center + s->radius);
    }
  }
  return low.x <= high.x ? (low + high) / 2.0 : dvec3{0};
}

/// The nearest point of a grid that is no wider than `most`, so that a small move of an object does not move the tree.
dvec3 on_grid(const dvec3& point, double most) {
  const double step = std::exp2(std::floor(std::log2(most)));
  return round(point / step) * step;
}

std::vector<dvec3> moved(std::vector<dvec3> vertices, const dvec3& origin) {
  for (dvec3& v : vertices) v -= origin;
  return vertices;
}

/// Parallel faces share a slab, so that one pair of products and one quotient serve both.
void lower_room(Lowering& l) {
  const std::vector<RoomFace>& faces = l.reach.room;
  std::vector<bool> done(faces.size());
  auto add = [&](std::size_t k) {
    const RoomFace& face = faces[k];
    done[k] = true;
    const Material& material = l.scene.materials[static_cast<std::size_t>(face.material)];
    const dvec3 front = face.front ? -face.inside.n : face.inside.n;
    const int surface = l.add_surface({&material, front});
    const std::vector<dvec3> outline = moved(face.outline, l.origin);
    add_object(l, material, bounding_sphere(outline), surface, surface);
    if (face.front) add_flat_lamp(l, outline, front, material, surface, surface, surface);
    return surface;
  };
  for (std::size_t i = 0; i < faces.size(); ++i) {
    if (done[i]) continue;
    const auto [n, hi] = faces[i].inside;
    // A face without a partner gets one so far outside the room that no ray reaches it.
    double lo = hi;
    for (const RoomFace& face : faces)
      for (const dvec3& v : face.outline) lo = std::min(lo, dot(n, v));
    lo -= hi - lo;
    const int surface_hi = add(i);
    int surface_lo = surface_hi;
    for (std::size_t k = i + 1; k < faces.size(); ++k) {
      if (done[k] || dot(n, faces[k].inside.n) > -1 + 1e-14) continue;
      lo = -faces[k].inside.d;
      surface_lo = add(k);
      break;
    }
    const auto f = to_floats(n);
    const double middle = (hi + lo) / 2 - dot(n, l.origin);
    l.out.room.push_back(
        {f[0], f[1], f[2], static_cast<float>(middle), static_cast<float>((hi - lo) / 2), surface_lo, surface_hi});
  }
  if (!faces.empty())
    l.out.compiled_in.push_back("a closed convex room of " + std::to_string(faces.size()) + " faces as " +
                                std::to_string(l.out.room.size()) + " pairs of planes");
}

void lower_polygon(Lowering& l, const Polygon& polygon, bool into_tree) {
  const std::vector<dvec3> v = moved(polygon.vertices, l.origin);
  const auto [n, d] = plane_of(v);
  const Material& material = l.material(polygon.material);
  const int surface = l.add_surface({&material, n});
  add_flat_lamp(l, v, n, material, surface, surface, surface);
  add_object(l, material, bounding_sphere(v), surface, surface);
  if (into_tree && !is_lamp(material)) {
    add_to_tree(l, polygon, surface);
    return;
  }
  const auto f = to_floats(n);
  const int first_bound = static_cast<int>(l.out.polygon_bounds.size());
  auto bound = [&](const dvec3& b, double lo, double hi) {
    const auto bf = to_floats(b);
    l.out.polygon_bounds.push_back({bf[0], bf[1], bf[2], static_cast<float>(lo), static_cast<float>(hi)});
  };
  if (is_parallelogram(v)) {
    // b1.(x - v0) = s and b2.(x - v0) = t for x = v0 + s e1 + t e2.
    const dvec3 e1 = v[1] - v[0], e2 = v[3] - v[0];
    const dvec3 b1 = cross(e2, n) / dot(e1, cross(e2, n));
    const dvec3 b2 = cross(e1, n) / dot(e2, cross(e1, n));
    bound(b1, dot(b1, v[0]), dot(b1, v[0]) + 1);
    bound(b2, dot(b2, v[0]), dot(b2, v[0]) + 1);
  } else {
    for (std::size_t i = 0; i < v.size(); ++i) {
      const dvec3 inward = normalize(cross(n, v[(i + 1) % v.size()] - v[i]));
      bound(inward, dot(inward, v[i]), infinity);
    }
  }
  l.out.polygons.push_back(
      {f[0], f[1], f[2], static_cast<float>(d), first_bound, static_cast<int>(l.out.polygon_bounds.size()), surface});
}

void lower_sphere(Lowering& l, const Sphere& sphere) {
  const Material& material = l.material(sphere.material);
  const bool glass = transmits(material);
  const dvec3 c = sphere.center - l.origin;
  const int surface = l.add_surface({&material, c, 1 / sphere.radius, glass ? relative_ior(l.scene, sphere) : 1});
  const auto f = to_floats(c);
  const bool around = l.reach.inside && length(*l.reach.inside - sphere.center) < sphere.radius;
  auto& list = glass ? l.out.glass_spheres : around ? l.out.shells : l.out.spheres;
  list.push_back({f[0], f[1], f[2], static_cast<float>(sphere.radius * sphere.radius), surface});
  add_object(l, material, {c, sphere.radius}, surface, surface);
  if (glass || !around) l.facing_spheres.push_back({&sphere, surface});
  if (!around) add_sphere_lamp(l, c, sphere.radius, material, surface);
}

void fill_surfaces(Lowering& l) {
  Table<Column> table(static_cast<int>(l.surfaces.size()), static_cast<int>(Column::count) + own_columns);
  for (std::size_t i = 0; i < l.surfaces.size(); ++i) {
    const Surface& s = l.surfaces[i];
    const Material& m = *s.material;
    const TableRow<Column> row{table, i};
    const MaterialInfo& info = material_info(m.type);
    const dvec3 radiance = info.radiance(m);
    const ChosenLobe lobe = lower(m);
    row.set3(Column::normal_x, s.normal_or_center);
    row.set(Column::inverse_radius, s.inverse_radius);
    row.set_int(Column::kind, lobe.kind);
    row.set3(Column::reflectance_r, info.albedo(m));
    row.set3(Column::emission_r, radiance);
    row.set(Column::eta, s.eta);
    for (std::size_t k = 0; k < lobe.columns.size(); ++k)
      row.set(lobe_column(lobe.first_column + static_cast<int>(k)), lobe.columns[k]);
    l.out.lobes |= lobe.bit;
    l.out.has_glow |= !info.emits && radiance != dvec3{0};
    l.out.max_radiance = std::max({l.out.max_radiance, radiance.r, radiance.g, radiance.b});
  }
  l.out.surfaces = std::move(table);
  l.out.has_glass = (l.out.lobes & transmitting_lobes) != 0;
}

/// "249,000"
std::string grouped(std::size_t n) {
  std::string text = std::to_string(n);
  for (std::size_t place = text.size(); place > 3; place -= 3) text.insert(place - 3, ",");
  return text;
}

/// What the kernel does and leaves out in this scene, in words.
void describe(Lowering& l) {
  CompiledScene& out = l.out;
  auto count = [&](std::size_t n, const char* one, const char* many) {
    if (n != 0) out.compiled_in.push_back(std::to_string(n) + " " + (n == 1 ? one : many));
  };
  count(out.spheres.size(), "sphere, seen from outside", "spheres, seen from outside");
  count(out.shells.size(), "sphere around the camera", "spheres around the camera");
  count(out.glass_spheres.size(), "glass sphere", "glass spheres");
  count(out.polygons.size(), "polygon", "polygons");
  if (out.tree)
    out.compiled_in.push_back("a tree of " + grouped(out.tree->triangles) + " triangles, " +
                              number_text(std::round(static_cast<double>(out.tree->bytes()) / 1e5) / 10) +
                              " MB, built in " + number_text(std::round(out.tree->build_seconds * 10) / 10) + " s");
  count(out.chain_spheres.size(), "sphere that caustics are connected over",
        "spheres that caustics are connected over");
  count(static_cast<std::size_t>(out.lamps.rows()), "piece of a lamp", "pieces of lamps");
  auto feature = [&](bool used, std::string_view what) { (used ? out.compiled_in : out.left_out).emplace_back(what); };
  for_each_lobe([&]<class L>() {
    if constexpr (requires { L::feature; }) feature((out.lobes & lobe_bit<L>) != 0, L::feature);
  });
  feature(out.has_glow, "glowing surfaces");
  if (out.cutaway) out.compiled_in.emplace_back("a cutaway, and so caustics by chance alone");
  if (!out.room.empty() && !out.room_hides_lamps) out.left_out.emplace_back("shadow tests against the room");
}

}  // namespace

CompiledScene compile(const Scene& as_edited, std::size_t most_listed) {
  if (const std::vector<Problem> problems = validate(as_edited); !problems.empty())
    throw SceneError(problems.front().path + ": " + problems.front().message);
  // What is rendered is in places not what was edited.
  auto [scene, warnings] = mend(as_edited);
  CoincidenceNotes notes;
  move_eye_off_surfaces(scene, warnings);
  Reach reach = find_reach(scene);
  if (separate_coincident(scene, reach, notes)) gather_objects(scene, reach);
  Lowering l{scene, std::move(reach), {}, {}, {}, {}, {}, {}, {}, {}};
  const TreePlan plan = plan_tree(l, most_listed);
  l.origin = centre_of(l.reach);
  if (plan.triangles) l.origin = on_grid(l.origin, size_of(scene) / 16);
  l.out.settings = scene.render;
  l.out.width = scene.image.width;
  l.out.height = scene.image.height;
  l.out.camera = lower_camera(scene, l.origin);
  l.out.origin = {l.origin.x, l.origin.y, l.origin.z};
  l.out.cutaway = scene.camera.cutaway == Cutaway::on;
  l.out.camera_outside = l.reach.camera_outside;
  l.out.room_hides_lamps = l.reach.lamp_pierces_room;
  l.out.left_out = l.reach.left_out;
  l.out.compiled_in = std::move(notes.told);
  l.out.warnings = std::move(warnings);
  l.out.warnings.insert(l.out.warnings.end(), notes.warnings.begin(), notes.warnings.end());
  l.out.warnings.insert(l.out.warnings.end(), l.reach.warnings.begin(), l.reach.warnings.end());
  lower_room(l);
  l.out.room_surfaces = static_cast<int>(l.surfaces.size());
  for (const Polygon* p : l.reach.polygons) lower_polygon(l, *p, plan.polygons);
  lower_meshes(l, plan);
  for (const Sphere* s : l.reach.spheres) lower_sphere(l, *s);
  fill_surfaces(l);
  lower_lamps(l);
  lower_aims(l);
  lower_chains(l);
  mark_lamp_edges(l);
  find_lamp_images(l);
  describe(l);
  lower_chance(l);
  warn(l);
  return std::move(l.out);
}

}  // namespace glimt
