#include "scene/geometry/mend.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <deque>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <iterator>
#include <set>
#include <unordered_map>

#include "scene/file/text.h"
#include "scene/geometry/convex_pieces.h"
#include "scene/geometry/geometry_cache.h"
#include "scene/geometry/mesh_measures.h"
#include "scene/geometry/mesh_parts.h"

namespace glimt {
namespace {

using glm::dvec3;
using Corners = std::array<int, 3>;

/// Of a mesh's size: vertices nearer than this are one. Exporters that repeat the corners of a face write single
/// precision.
constexpr double weld_tolerance = 0x1p-20;

/// Things of one kind that were mended.
struct Tally {
  std::size_t count = 0;
  std::string first;

  void add(std::size_t n, const std::string& place) {
    if (count == 0) first = place;  // without any, the next takes its place
    count += n;
  }
  void tell(std::vector<std::string>& told, const char* one, const char* many) const {
    if (count > 0) told.push_back(std::to_string(count) + " " + (count == 1 ? one : many) + "; the first: " + first);
  }
};

struct Tallies {
  Tally polygons, left_out, flat, twice, welded;
};

std::string place_in(const char* kind, const std::string& name, std::size_t index) {
  return std::string(kind) + " " + (name.empty() ? std::to_string(index) : toml_string(name));
}

const dvec3& vertex(const Mesh& mesh, int i) { return mesh.vertices[static_cast<std::size_t>(i)]; }

bool is_flat(const Mesh& mesh, const Corners& t) {
  return has_no_area(vertex(mesh, t[0]), vertex(mesh, t[1]), vertex(mesh, t[2]));
}

/// For each vertex the first that is in its place; with normals, one whose normal is like its own.
std::vector<int> first_in_place(const Mesh& mesh) {
  const std::vector<dvec3>&vertices = mesh.vertices, &normals = mesh.normals;
  const auto alike = [&](int a, int b) {
    if (normals.empty()) return true;
    const dvec3 m = normals[static_cast<std::size_t>(a)], n = normals[static_cast<std::size_t>(b)];
    return dot(m, n) > (1 - 1e-6) * length(m) * length(n);
  };
  dvec3 low{vertices.front()}, high{low};
  for (const dvec3& v : vertices) low = min(low, v), high = max(high, v);
  const double tolerance = weld_tolerance * length(high - low), cell = 8 * tolerance;
  std::vector<int> first(vertices.size());
  std::unordered_multimap<std::uint64_t, int> cells;
  const auto key = [](std::int64_t x, std::int64_t y, std::int64_t z) {
    return static_cast<std::uint64_t>((x * 73856093) ^ (y * 19349663) ^ (z * 83492791));
  };
  const auto number = [&](double x) { return tolerance > 0 ? static_cast<std::int64_t>(std::floor(x / cell)) : 0; };
  for (int i = 0; i < static_cast<int>(vertices.size()); ++i) {
    const dvec3 p = vertices[static_cast<std::size_t>(i)] - low;
    int& own = first[static_cast<std::size_t>(i)];
    own = i;
    for (std::int64_t x = number(p.x - tolerance); x <= number(p.x + tolerance); ++x)
      for (std::int64_t y = number(p.y - tolerance); y <= number(p.y + tolerance); ++y)
        for (std::int64_t z = number(p.z - tolerance); z <= number(p.z + tolerance); ++z) {
          const auto [begin, end] = cells.equal_range(key(x, y, z));
          for (auto it = begin; it != end; ++it)
            if (length(vertices[static_cast<std::size_t>(it->second)] - low - p) <= tolerance && alike(i, it->second))
              own = std::min(own, it->second);
        }
    if (own == i) cells.emplace(key(number(p.x), number(p.y), number(p.z)), i);
  }
  return first;
}

std::uint64_t directed(int from, int to) {
  return static_cast<std::uint64_t>(static_cast<std::uint32_t>(from)) << 32 | static_cast<std::uint32_t>(to);
}

/// Takes out the triangles without area. One whose corners are three on a line has its middle corner on the edge of a
/// neighbour, which is cut in two there, so that a closed mesh stays closed.
void drop_flat(Mesh& mesh) {
  std::vector<Corners> all = mesh.triangles;
  std::vector<bool> kept(all.size(), true);
  std::deque<std::size_t> flat;
  std::unordered_multimap<std::uint64_t, std::size_t> with_edge;
  const auto note = [&](std::size_t i) {
    for (std::size_t k = 0; k < 3; ++k) with_edge.emplace(directed(all[i][k], all[i][(k + 1) % 3]), i);
    if (is_flat(mesh, all[i])) flat.push_back(i);
  };
  for (std::size_t i = 0; i < all.size(); ++i) note(i);
  // Neighbours may be flat too, and what is cut of them.
  for (std::size_t left = 4 * all.size(); !flat.empty(); --left) {
    const std::size_t i = flat.front();
    flat.pop_front();
    if (!kept[i]) continue;
    kept[i] = false;
    const Corners t = all[i];
    if (left == 0) continue;
    if (t[0] == t[1] || t[1] == t[2] || t[2] == t[0]) continue;
    const auto edge = [&](std::size_t k) {
      return length(vertex(mesh, t[(k + 1) % 3]) - vertex(mesh, t[(k + 2) % 3]));
    };
    const std::size_t middle = edge(0) >= edge(1) && edge(0) >= edge(2) ? 0 : edge(1) >= edge(2) ? 1 : 2;
    const int b = t[middle], c = t[(middle + 1) % 3], a = t[(middle + 2) % 3];
    const auto [begin, end] = with_edge.equal_range(directed(a, c));
    const auto neighbour = std::find_if(begin, end, [&](const auto& entry) { return kept[entry.second]; });
    if (neighbour == end) continue;
    const Corners n = all[neighbour->second];
    kept[neighbour->second] = false;
    const int d = n[0] != a && n[0] != c ? n[0] : n[1] != a && n[1] != c ? n[1] : n[2];
    for (const Corners& part : {Corners{a, b, d}, Corners{b, c, d}}) {
      all.push_back(part);
      kept.push_back(true);
      note(all.size() - 1);
    }
  }
  std::vector<Corners> rest;
  for (std::size_t i = 0; i < all.size(); ++i)
    if (kept[i] && !is_flat(mesh, all[i])) rest.push_back(all[i]);
  mesh.triangles = std::move(rest);
}

/// Triangles of the same three corners that face the same way are one. Returns how many were more.
std::size_t drop_repeated(Mesh& mesh) {
  std::vector<std::pair<Corners, std::size_t>> sorted;
  sorted.reserve(mesh.triangles.size());
  for (Corners t : mesh.triangles) {
    std::rotate(t.begin(), std::ranges::min_element(t), t.end());
    sorted.emplace_back(t, sorted.size());
  }
  std::ranges::sort(sorted);
  std::vector<bool> again(sorted.size());
  for (std::size_t i = 1; i < sorted.size(); ++i)
    if (sorted[i].first == sorted[i - 1].first) again[sorted[i].second] = true;
  const auto count = static_cast<std::size_t>(std::ranges::count(again, true));
  std::size_t i = 0;
  if (count > 0) std::erase_if(mesh.triangles.edit(), [&](const Corners&) { return again[i++]; });
  return count;
}

void drop_unused_vertices(Mesh& mesh) {
  std::vector<int> place(mesh.vertices.size(), -1);
  std::vector<dvec3> used, normals;
  for (Corners& t : mesh.triangles.edit())
    for (int& i : t) {
      int& p = place[static_cast<std::size_t>(i)];
      if (p < 0) {
        p = static_cast<int>(used.size());
        used.push_back(vertex(mesh, i));
        if (!mesh.normals.empty()) normals.push_back(mesh.normals[static_cast<std::size_t>(i)]);
      }
      i = p;
    }
  mesh.vertices = std::move(used);
  if (!mesh.normals.empty()) mesh.normals = std::move(normals);
}

/// What becomes of a mesh.
struct MendedMesh {
  bool changed = false;
  Mesh mesh{};  ///< where it is changed; of no name and material
  std::size_t flat = 0, twice = 0, welded = 0;
};

MendedMesh mended_mesh(const Mesh& given) {
  MendedMesh result;
  Mesh mesh{
      .name = {}, .material = {}, .vertices = given.vertices, .triangles = given.triangles, .normals = given.normals};
  const bool closed = is_closed(mesh);
  const auto flat = std::ranges::count_if(mesh.triangles, [&](const Corners& t) { return is_flat(mesh, t); });
  // A large mesh that needs nothing is not looked at further.
  if (Mesh copy = mesh; is_large(mesh) && closed && flat == 0 && drop_repeated(copy) == 0) return result;
  const std::vector<int> first = first_in_place(mesh);
  Mesh welded = mesh;
  for (Corners& t : welded.triangles.edit())
    for (int& i : t) i = first[static_cast<std::size_t>(i)];
  if (flat > 0) drop_flat(welded);
  const std::size_t twice = drop_repeated(welded);
  if (closed && flat == 0 && twice == 0) return result;

  result.flat = static_cast<std::size_t>(flat);
  result.twice = twice;
  // Only a mesh that becomes closed has a use for vertices that are shared.
  const bool helps = is_closed(welded);
  if (helps && !closed)
    for (std::size_t i = 0; i < first.size(); ++i)
      if (first[i] != static_cast<int>(i)) ++result.welded;
  if (!helps && flat == 0 && twice == 0) return result;
  if (helps || twice > 0)
    mesh = std::move(welded);
  else
    drop_flat(mesh);
  drop_unused_vertices(mesh);
  result.changed = true;
  result.mesh = std::move(mesh);
  return result;
}

void mend(Mesh& mesh, std::size_t index, Tallies& tallies) {
  static GeometryCache<MendedMesh> cache;
  const std::shared_ptr<const MendedMesh> now = is_large(mesh) ? cache.get(mesh, [&] { return mended_mesh(mesh); })
                                                               : std::make_shared<MendedMesh>(mended_mesh(mesh));
  const std::string name = place_in("mesh", mesh.name, index);
  tallies.flat.add(now->flat, name);
  tallies.twice.add(now->twice, name);
  tallies.welded.add(now->welded, name);
  if (!now->changed) return;
  mesh.vertices = now->mesh.vertices;
  mesh.triangles = now->mesh.triangles;
  mesh.normals = now->mesh.normals;
}

/// What by_material() gives; kept for large meshes.
std::vector<Mesh> parts_of(const Mesh& mesh) {
  if (!is_large(mesh)) return by_material(mesh);
  struct Split {
    std::vector<MeshPart> parts;
    std::vector<Mesh> meshes;
  };
  static GeometryCache<Split> cache;
  const auto split = cache.get(mesh, [&] { return Split{mesh.parts, by_material(mesh)}; });
  if (split->parts != mesh.parts) return by_material(mesh);
  std::vector<Mesh> meshes = split->meshes;
  for (Mesh& part : meshes) part.name = mesh.name, part.smooth = mesh.smooth;
  return meshes;
}

/// Each keeps its place for its first material; those of the others come behind.
void split_by_material(std::vector<Mesh>& meshes) {
  for (std::size_t i = 0, count = meshes.size(); i < count; ++i) {
    if (meshes[i].parts.empty()) continue;
    std::vector<Mesh> parts = parts_of(meshes[i]);
    meshes[i] = std::move(parts.front());
    std::move(parts.begin() + 1, parts.end(), std::back_inserter(meshes));
  }
}

/// What was left out when files were read, once for each file.
void tell_of_files(const Scene& scene, std::vector<std::string>& told) {
  std::set<const MeshData*> done;
  for (const Mesh& mesh : scene.meshes)
    if (mesh.file && done.insert(mesh.file->data.get()).second)
      told.insert(told.end(), mesh.file->data->told.begin(), mesh.file->data->told.end());
}

}  // namespace

bool has_no_area(const dvec3& a, const dvec3& b, const dvec3& c) {
  const double size = std::max({length(b - a), length(c - b), length(a - c)});
  return !(length(cross(b - a, c - a)) > degenerate * size * size);
}

Mended mend(const Scene& scene) {
  Mended mended{scene, {}};
  Tallies tallies;
  mended.scene.polygons.clear();
  for (std::size_t i = 0; i < scene.polygons.size(); ++i) {
    const Polygon& polygon = scene.polygons[i];
    ConvexPieces cut = convex_pieces(polygon.vertices);
    if (cut.bent) tallies.polygons.add(1, place_in("polygon", polygon.name, i));
    tallies.left_out.add(static_cast<std::size_t>(cut.left_out), place_in("polygon", polygon.name, i));
    for (auto& piece : cut.pieces) mended.scene.polygons.push_back({polygon.name, polygon.material, std::move(piece)});
  }
  split_by_material(mended.scene.meshes);
  for (std::size_t i = 0; i < mended.scene.meshes.size(); ++i) mend(mended.scene.meshes[i], i, tallies);
  tallies.polygons.tell(mended.told, "polygon is not flat or not convex and is cut into pieces",
                        "polygons are not flat or not convex and are cut into pieces");
  tallies.left_out.tell(mended.told, "vertex of a polygon adds no area to it and is left out",
                        "vertices of polygons add no area to them and are left out");
  tallies.flat.tell(mended.told, "triangle has no area and is left out", "triangles have no area and are left out");
  tallies.twice.tell(mended.told, "triangle of a mesh is there twice; one of the two is left out",
                     "triangles of meshes are there more than once and are left out");
  tallies.welded.tell(mended.told, "vertex of a mesh coincides with another and is welded to it",
                      "vertices of meshes coincide with others and are welded to them");
  tell_of_files(scene, mended.told);
  return mended;
}

}  // namespace glimt
