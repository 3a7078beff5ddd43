#include "compile/flat_pieces.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <glm/geometric.hpp>

#include "compile/coincide.h"
#include "scene/file/text.h"
#include "scene/geometry/geometry_cache.h"
#include "scene/geometry/mesh_measures.h"
#include "scene/surroundings.h"

namespace glimt {

using glm::dvec3;

namespace {

/// Normals whose cosine is nearer to 1 or -1 are parallel.
constexpr double parallel = 1e-10;

bool may_coincide(const FlatPiece& a, const FlatPiece& b) {
  return a.object != b.object || dot(a.plane.n, b.plane.n) < 0;
}

}  // namespace

bool same_direction(const dvec3& a, const dvec3& b) { return dot(a, b) > 1 - parallel; }

bool lies_in(const std::vector<dvec3>& outline, const HalfSpace& plane, double tolerance) {
  return std::ranges::all_of(outline, [&](const dvec3& v) { return std::abs(dot(plane.n, v) - plane.d) <= tolerance; });
}

FlatPieces::FlatPieces(const Scene& scene, const Reach& reach)
    : scene_(scene),
      polygons_(static_cast<int>(scene.polygons.size())),
      box_(box_of(scene)),
      middle_((box_.low + box_.high) / 2.0) {
  const auto add = [&](int object, int triangle, const std::vector<dvec3>& v) {
    if (in_wall_or_beyond(reach, v)) return;
    double from_centre = 0;
    for (const dvec3& p : v) from_centre = std::max(from_centre, length(p - middle_));
    pieces_.push_back({object, triangle, plane_of(v), local_size(box_, from_centre)});
  };
  int object = 0;
  for (const Polygon& p : scene.polygons) add(object++, -1, p.vertices);
  for (const Mesh& m : scene.meshes) {
    int triangle = 0;
    if (!is_large(m))
      for (const auto& t : m.triangles) add(object, triangle++, triangle_vertices(m, t));
    ++object;
  }
}

std::vector<dvec3> FlatPieces::outline(const FlatPiece& p) const {
  if (!is_mesh(p.object)) return polygon(p.object).vertices;
  return triangle_vertices(mesh(p.object), mesh(p.object).triangles[static_cast<std::size_t>(p.triangle)]);
}

const std::string& FlatPieces::material(int object) const {
  return is_mesh(object) ? mesh(object).material : polygon(object).material;
}

std::string FlatPieces::called(int object) const {
  const std::string& name = is_mesh(object) ? mesh(object).name : polygon(object).name;
  if (!name.empty()) return toml_string(name);
  return is_mesh(object) ? "mesh " + std::to_string(mesh_index(object)) : "polygon " + std::to_string(object);
}

bool FlatPieces::in_wall_or_beyond(const Reach& reach, const std::vector<dvec3>& v) const {
  return std::ranges::any_of(reach.room, [&](const RoomFace& face) {
    return std::ranges::all_of(
        v, [&](const dvec3& p) { return dot(face.inside.n, p) - face.inside.d >= -reach.tolerance; });
  });
}

/// Square metres; 0 for pieces that are not in one plane.
double FlatPieces::common_area(const FlatPiece& a, const FlatPiece& b) const {
  if (std::abs(dot(a.plane.n, b.plane.n)) <= 1 - parallel) return 0;
  std::vector<dvec3> left = outline(a);
  const std::vector<dvec3> window = outline(b);
  const double tolerance = coincident_distance * std::min(a.size, b.size);
  if (!lies_in(left, b.plane, tolerance) && !lies_in(window, a.plane, tolerance)) return 0;
  for (std::size_t i = 0; i < window.size() && !left.empty(); ++i) {
    const dvec3 out = normalize(cross(window[(i + 1) % window.size()] - window[i], b.plane.n));
    left = clip(left, {out, dot(out, window[i])});
  }
  return left.empty() ? 0 : area_of(left);
}

bool FlatPieces::have_area_in_common(const FlatPiece& a, const FlatPiece& b) const {
  const double least = std::min(area_of(outline(a)), area_of(outline(b)));
  return common_area(a, b) > least_gap * std::min(a.size, b.size) * std::sqrt(least);
}

/// Pieces of like planes come together in cells of their normals and distances; most cells hold one, or one object's.
std::set<std::pair<int, int>> FlatPieces::coincident_pairs() const {
  // Two coincident pieces differ by less than this: their normals, and their planes at the scene's middle.
  constexpr double turned = 2e-5, normal_cells = 1000, distance_cells = 4000;
  std::vector<std::pair<std::uint64_t, int>> entries;
  for (int i = 0; i < count(); ++i) {
    const HalfSpace& plane = pieces_[static_cast<std::size_t>(i)].plane;
    const double from_middle = (plane.d - dot(plane.n, middle_)) / box_.size();
    const double lean = dot(plane.n, dvec3{0.61, 0.53, 0.59});  // no direction that scenes like
    for (const double sign : {1.0, -1.0}) {
      if (sign * lean < -turned) continue;
      std::array<std::array<std::int64_t, 2>, 4> range;
      const auto cells = [](double x, double count, double tolerance) {
        return std::array{static_cast<std::int64_t>(std::floor((x - tolerance) * count)),
                          static_cast<std::int64_t>(std::floor((x + tolerance) * count))};
      };
      for (int axis = 0; axis < 3; ++axis)
        range[static_cast<std::size_t>(axis)] = cells(sign * plane.n[axis], normal_cells, turned);
      range[3] = cells(sign * from_middle, distance_cells, turned);
      for (std::int64_t x = range[0][0]; x <= range[0][1]; ++x)
        for (std::int64_t y = range[1][0]; y <= range[1][1]; ++y)
          for (std::int64_t z = range[2][0]; z <= range[2][1]; ++z)
            for (std::int64_t d = range[3][0]; d <= range[3][1]; ++d)
              entries.emplace_back(static_cast<std::uint64_t>(
                                       (((x + 2048) << 12 | (y + 2048)) << 12 | (z + 2048)) << 20 | (d + 0x80000)),
                                   i);
    }
  }
  std::ranges::sort(entries);
  Pairs pairs;
  for (auto begin = entries.begin(); begin != entries.end();) {
    const auto end = std::find_if(begin, entries.end(), [&](const auto& entry) { return entry.first != begin->first; });
    std::vector<int> cell;
    for (; begin != end; ++begin) cell.push_back(begin->second);
    find_pairs_in(cell, pairs);
  }
  return pairs;
}

/// A sweep along x. Pieces of one object that face one way are not compared with each other.
void FlatPieces::find_pairs_in(const std::vector<int>& cell, Pairs& pairs) const {
  const auto piece = [&](int i) -> const FlatPiece& { return pieces_[static_cast<std::size_t>(i)]; };
  if (std::ranges::none_of(cell, [&](int i) { return may_coincide(piece(cell[0]), piece(i)); })) return;
  struct Bounded {
    Box box;
    int index;
  };
  std::vector<Bounded> all;
  for (const int i : cell) {
    Box box;
    for (const dvec3& v : outline(piece(i))) box.add(v);
    all.push_back({box, i});
  }
  std::ranges::stable_sort(all, {}, [](const Bounded& b) { return b.box.low.x; });
  const double widest = coincident_distance * box_.size();
  std::map<std::pair<int, bool>, std::vector<const Bounded*>> open;  // by object and side
  for (const Bounded& next : all) {
    const std::pair own{piece(next.index).object, dot(piece(next.index).plane.n, piece(cell[0]).plane.n) > 0};
    for (auto others = open.begin(); others != open.end();) {
      if (others->first == own) {
        ++others;
        continue;
      }
      std::erase_if(others->second, [&](const Bounded* b) { return b->box.high.x + widest < next.box.low.x; });
      for (const Bounded* other : others->second)
        if (meet(other->box, next.box, widest) && have_area_in_common(piece(other->index), piece(next.index)))
          pairs.insert(std::minmax({other->index, next.index}));
      others = others->second.empty() ? open.erase(others) : std::next(others);
    }
    open[own].push_back(&next);
  }
}

bool FlatPieces::are_of_same_shape(const FlatPiece& a, const FlatPiece& b) const {
  if (a.object == b.object || material(a.object) != material(b.object) || dot(a.plane.n, b.plane.n) < 0) return false;
  if (!is_mesh(a.object) && !is_mesh(b.object)) {
    const double larger = std::max(area_of(outline(a)), area_of(outline(b)));
    return common_area(a, b) >= larger * (1 - 1e-6);
  }
  if (!is_mesh(a.object) || !is_mesh(b.object)) return false;
  return mesh(a.object).triangles == mesh(b.object).triangles &&
         std::ranges::equal(mesh(a.object).vertices, mesh(b.object).vertices, [&](const dvec3& v, const dvec3& w) {
           return length(v - w) <= coincident_distance * std::min(a.size, b.size);
         });
}

}  // namespace glimt
