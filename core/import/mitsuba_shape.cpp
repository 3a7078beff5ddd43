#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>
#include <numbers>

#include "import/mitsuba_parts.h"
#include "import/placement_of.h"
#include "mesh/mesh_file.h"
#include "scene/fields.h"

namespace glimt {
namespace {

using glm::dvec3;

constexpr int disk_corners = 64, sphere_rows = 32;

dvec3 moved(const glm::dmat4& m, const dvec3& p) { return dvec3(m * glm::dvec4(p, 1)); }
bool mirrors(const glm::dmat4& m) { return determinant(glm::dmat3(m)) < 0; }

struct ShapeParts {
  std::string name, material, type;
  glm::dmat4 to_world;
  bool flipped;  ///< its front is turned around
};

/// What a shape wears: its lamp, or its bsdf.
std::string worn_by(MitsubaImport& in, pugi::xml_node shape, const std::string& name) {
  pugi::xml_node bsdf, emitter;
  for (const pugi::xml_node child : shape.children()) {
    const pugi::xml_node node = in.file.resolved(child);
    const std::string_view kind = node.name();
    if (kind == "bsdf") bsdf = node;
    if (kind == "emitter") emitter = node;
    if (kind == "medium") in.note(node, "medium", "nothing");
  }
  if (!emitter) return bsdf ? import_bsdf(in, bsdf) : default_bsdf(in);
  if (const std::string type = in.file.attribute(emitter, "type"); type != "area")
    in.note(emitter, "emitter " + type + " of a shape", "an area light");
  const dvec3 radiance = colour_of(in, emitter, "radiance", dvec3{1});
  const Material light = make_light({}, radiance);
  for (const Material& known : in.scene().materials) {
    Material same = light;
    same.name = known.name;
    if (same == known) return known.name;
  }
  Material own = light;
  own.name = unused_material_name(in.scene(), name + " light");
  in.scene().materials.push_back(own);
  return own.name;
}

void add_polygon(MitsubaImport& in, const ShapeParts& parts, std::vector<dvec3> outline) {
  for (dvec3& v : outline) v = moved(parts.to_world, v);
  // Mitsuba transforms the normal, which a mirror does not turn around as it does the outline.
  if (mirrors(parts.to_world) != parts.flipped) std::ranges::reverse(outline);
  in.scene().polygons.push_back({unused_name(in.scene().polygons, parts.name), parts.material, std::move(outline)});
}

void add_mesh(MitsubaImport& in, const ShapeParts& parts, std::vector<dvec3> vertices,
              std::vector<std::array<int, 3>> triangles, bool turned, bool smooth) {
  for (dvec3& v : vertices) v = moved(parts.to_world, v);
  if (turned)
    for (auto& t : triangles) std::swap(t[1], t[2]);
  Mesh mesh{.name = unused_name(in.scene().meshes, parts.name), .material = parts.material};
  mesh.smooth = smooth;
  if (smooth) mesh.normals = smooth_normals(vertices, triangles);
  mesh.vertices = std::move(vertices);
  mesh.triangles = std::move(triangles);
  in.scene().meshes.push_back(std::move(mesh));
}

void add_cube(MitsubaImport& in, const ShapeParts& parts) {
  std::vector<dvec3> corners;
  corners.reserve(8);
  for (int i = 0; i < 8; ++i) corners.emplace_back(i & 1 ? 1 : -1, i & 2 ? 1 : -1, i & 4 ? 1 : -1);
  std::vector<std::array<int, 3>> triangles;
  constexpr std::array<std::array<int, 4>, 6> sides{
      {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}}};
  for (const auto& [a, b, c, d] : sides) {
    triangles.push_back({a, b, c});
    triangles.push_back({a, c, d});
  }
  add_mesh(in, parts, corners, triangles, mirrors(parts.to_world) != parts.flipped, false);
}

/// A sphere that a transform may make an ellipsoid of.
void add_ball_mesh(MitsubaImport& in, const ShapeParts& parts, const dvec3& centre, double radius) {
  constexpr int columns = 2 * sphere_rows;
  std::vector<dvec3> vertices{centre + dvec3{0, radius, 0}, centre - dvec3{0, radius, 0}};
  for (int row = 1; row < sphere_rows; ++row)
    for (int column = 0; column < columns; ++column) {
      const double theta = std::numbers::pi * row / sphere_rows, phi = 2 * std::numbers::pi * column / columns;
      vertices.push_back(
          centre + radius * dvec3{std::sin(theta) * std::sin(phi), std::cos(theta), std::sin(theta) * std::cos(phi)});
    }
  const auto at = [&](int row, int column) { return 2 + (row - 1) * columns + column % columns; };
  std::vector<std::array<int, 3>> triangles;
  for (int column = 0; column < columns; ++column) {
    triangles.push_back({0, at(1, column), at(1, column + 1)});
    triangles.push_back({1, at(sphere_rows - 1, column + 1), at(sphere_rows - 1, column)});
    for (int row = 1; row + 1 < sphere_rows; ++row) {
      triangles.push_back({at(row, column), at(row + 1, column), at(row + 1, column + 1)});
      triangles.push_back({at(row, column), at(row + 1, column + 1), at(row, column + 1)});
    }
  }
  add_mesh(in, parts, vertices, triangles, mirrors(parts.to_world) != parts.flipped, true);
}

void add_sphere(MitsubaImport& in, pugi::xml_node shape, const ShapeParts& parts) {
  const pugi::xml_node point = in.file.property(shape, "center");
  const dvec3 centre = point ? in.file.vector(point, 0) : dvec3{0};
  const double radius = in.file.number(shape, "radius", 1);
  const glm::dmat3 linear(parts.to_world);
  const double size = length(linear[0]);
  bool round = true;
  for (int i = 0; i < 3; ++i)
    for (int k = 0; k <= i; ++k)
      round &= std::abs(dot(linear[i], linear[k]) - (i == k ? size * size : 0)) < 1e-6 * size * size;
  const bool is_light = find_material(in.scene(), parts.material)->type == "light";
  if (round && !(parts.flipped && is_light)) {
    in.scene().spheres.push_back({unused_name(in.scene().spheres, parts.name), parts.material,
                                  moved(parts.to_world, centre), std::abs(radius) * size});
    return;
  }
  in.note(shape, round ? "a sphere that shines inwards" : "an ellipsoid", "a mesh of 3968 triangles");
  add_ball_mesh(in, parts, centre, radius);
}

void add_disk(MitsubaImport& in, pugi::xml_node shape, const ShapeParts& parts) {
  in.note(shape, "shape disk", "a polygon of 64 corners and the same area");
  const double step = 2 * std::numbers::pi / disk_corners;
  const double radius = std::sqrt(step / std::sin(step));
  std::vector<dvec3> outline;
  outline.reserve(disk_corners);
  for (int i = 0; i < disk_corners; ++i)
    outline.emplace_back(radius * std::cos(i * step), radius * std::sin(i * step), 0);
  add_polygon(in, parts, std::move(outline));
}

void add_file(MitsubaImport& in, pugi::xml_node shape, const ShapeParts& parts) {
  const std::filesystem::path path = in.file.path_of(in.file.text(shape, "filename"), shape);
  const bool smooth = !in.file.boolean(shape, "face_normals", false);
  if (parts.type == "ply" ? path.extension() != ".ply" : path.extension() != ".obj")
    in.file.fail(shape, "names " + path.filename().string() + " as " + parts.type);
  try {
    const auto placement = placement_of(parts.to_world);
    const bool is_light = find_material(in.scene(), parts.material)->type == "light";
    // Ours keeps its front in a mirror.
    const bool turned = mirrors(parts.to_world) != parts.flipped && is_light;
    if (placement && !turned) {
      in.scene().meshes.push_back(mesh_of_file(in.scene(), path, parts.name, parts.material, *placement, smooth));
      return;
    }
    if (!placement) in.note(shape, "a sheared mesh", "its triangles in the scene file");
    const auto data = load_mesh(path);
    add_mesh(in, parts, data->vertices, data->triangles, parts.flipped, smooth);
  } catch (const MeshFileError& error) {
    in.file.fail(shape, error.what());
  }
}

}  // namespace

void import_shape(MitsubaImport& in, pugi::xml_node shape) {
  const std::string type = in.file.attribute(shape, "type"), id = in.file.attribute(shape, "id");
  constexpr std::array<std::string_view, 6> known{"obj", "ply", "rectangle", "cube", "sphere", "disk"};
  if (std::ranges::find(known, type) == known.end()) return in.note(shape, "shape " + type, "nothing");
  ShapeParts parts{.name = id.empty() ? type : id,
                   .material = {},
                   .type = type,
                   .to_world = in.file.transform(shape, "to_world"),
                   .flipped = in.file.boolean(shape, "flip_normals", false)};
  parts.material = worn_by(in, shape, parts.name);
  const bool open = type == "rectangle" || type == "disk";
  if (Material& m = *std::ranges::find(in.scene().materials, parts.material, &Material::name); open && transmits(m)) {
    in.note(shape, "glass on an open shape", "nothing");
    return;
  }
  if (type == "rectangle")
    add_polygon(in, parts, {{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}});
  else if (type == "cube")
    add_cube(in, parts);
  else if (type == "sphere")
    add_sphere(in, shape, parts);
  else if (type == "disk")
    add_disk(in, shape, parts);
  else
    add_file(in, shape, parts);
}

}  // namespace glimt
