#include "compile/coincide.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <glm/vector_relational.hpp>
#include <map>
#include <numeric>
#include <set>
#include <tuple>

#include "math/box.h"
#include "scene/fields.h"
#include "scene/file/text.h"
#include "scene/geometry/mesh_measures.h"
#include "scene/surroundings.h"

namespace glimt {
namespace {

using glm::dvec3;

// In sizes of what is around (local_size()).
constexpr double coincident = 0x1p-22;  ///< rays cannot tell apart what is nearer than this
constexpr double deliberate = 0x1p-25;  ///< more is no error of single precision, so the order is meant
constexpr double gap = 0x1p-20;         ///< rays can tell apart what this is between
/// Normals whose cosine is nearer to 1 or -1 are parallel.
constexpr double parallel = 1e-10;

bool same_direction(const dvec3& a, const dvec3& b) { return dot(a, b) > 1 - parallel; }

/// A polygon or a triangle of a mesh.
struct FlatPiece {
  int object;       ///< polygons by their index, then meshes
  int triangle;     ///< of a mesh, else -1
  HalfSpace plane;  ///< n to the front
  double size;      ///< of what is around, metres
};

/// What of an object is in one plane and faces one way.
struct PlanePart {
  int object = 0;
  HalfSpace plane;  ///< n to the front of a sheet, out of a body
  std::vector<int> pieces;
  double area = 0;
  bool body = false;
  int level = 0;    ///< the higher, the more in front
  int layer = 0;    ///< above others of its plane
  double move = 0;  ///< along n, metres
};

class Coincidences {
 public:
  Coincidences(Scene& scene, const Reach& reach)
      : scene_(scene), reach_(reach), polygons_(static_cast<int>(scene.polygons.size())), box_(box_of(scene)) {
    const auto collect = [&](int object, int triangle, const std::vector<dvec3>& outline) {
      if (in_wall_or_beyond(outline)) return;
      double from_centre = 0;
      for (const dvec3& v : outline) from_centre = std::max(from_centre, length(v - middle()));
      pieces_.push_back({object, triangle, plane_of(outline), local_size(box_, from_centre)});
    };
    for (int i = 0; i < polygons_; ++i) collect(i, -1, polygon(i).vertices);
    for (int i = 0; i < static_cast<int>(scene.meshes.size()); ++i)
      for (int t = 0; t < static_cast<int>(mesh(polygons_ + i).triangles.size()); ++t)
        collect(polygons_ + i, t,
                triangle_vertices(mesh(polygons_ + i), mesh(polygons_ + i).triangles[static_cast<std::size_t>(t)]));
  }

  bool separate(std::vector<std::string>& told, std::vector<std::string>& warnings) {
    if (pieces_.empty()) return false;
    find_pairs();
    if (pairs_.empty()) return false;
    find_repeated();
    relate_parts();
    stack();
    move_parts();
    tell(told, warnings);
    drop_repeated();
    return true;
  }

 private:
  const Polygon& polygon(int object) const { return scene_.polygons[static_cast<std::size_t>(object)]; }
  const Mesh& mesh(int object) const { return scene_.meshes[static_cast<std::size_t>(object - polygons_)]; }
  bool is_mesh(int object) const { return object >= polygons_; }
  const std::string& name(int object) const { return is_mesh(object) ? mesh(object).name : polygon(object).name; }
  const std::string& material(int object) const {
    return is_mesh(object) ? mesh(object).material : polygon(object).material;
  }
  FlatPiece& piece(int i) { return pieces_[static_cast<std::size_t>(i)]; }
  PlanePart& part(int i) { return parts_[static_cast<std::size_t>(i)]; }
  std::vector<dvec3> outline(const FlatPiece& p) const {
    return is_mesh(p.object)
               ? triangle_vertices(mesh(p.object), mesh(p.object).triangles[static_cast<std::size_t>(p.triangle)])
               : polygon(p.object).vertices;
  }

  bool in_wall_or_beyond(const std::vector<dvec3>& outline) const {
    return std::ranges::any_of(reach_.room, [&](const RoomFace& face) {
      return std::ranges::all_of(
          outline, [&](const dvec3& v) { return dot(face.inside.n, v) - face.inside.d >= -reach_.tolerance; });
    });
  }

  dvec3 middle() const { return (box_.low + box_.high) / 2.0; }
  static double smaller_size(const FlatPiece& a, const FlatPiece& b) { return std::min(a.size, b.size); }

  static bool lies_in(const std::vector<dvec3>& outline, const HalfSpace& plane, double tolerance) {
    return std::ranges::all_of(outline,
                               [&](const dvec3& v) { return std::abs(dot(plane.n, v) - plane.d) <= tolerance; });
  }

  /// Square metres; 0 for pieces that are not in one plane.
  double common_area(const FlatPiece& a, const FlatPiece& b) const {
    if (std::abs(dot(a.plane.n, b.plane.n)) <= 1 - parallel) return 0;
    std::vector<dvec3> left = outline(a);
    const std::vector<dvec3> window = outline(b);
    const double tolerance = coincident * smaller_size(a, b);
    if (!lies_in(left, b.plane, tolerance) && !lies_in(window, a.plane, tolerance)) return 0;
    for (std::size_t i = 0; i < window.size() && !left.empty(); ++i) {
      const dvec3 out = normalize(cross(window[(i + 1) % window.size()] - window[i], b.plane.n));
      left = clip(left, {out, dot(out, window[i])});
    }
    return left.empty() ? 0 : area_of(left);
  }

  /// Pieces of like planes come together in cells of their normals and distances; most cells hold one, or one object's.
  void find_pairs() {
    // Two coincident pieces differ by less than this: their normals, and their planes at the scene's middle.
    constexpr double turned = 2e-5, normal_cells = 1000, distance_cells = 4000;
    std::vector<std::pair<std::uint64_t, int>> entries;
    for (int i = 0; i < static_cast<int>(pieces_.size()); ++i) {
      const HalfSpace& plane = piece(i).plane;
      const double from_middle = (plane.d - dot(plane.n, middle())) / box_.size();
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
    for (auto begin = entries.begin(); begin != entries.end();) {
      const auto end =
          std::find_if(begin, entries.end(), [&](const auto& entry) { return entry.first != begin->first; });
      std::vector<int> cell;
      for (; begin != end; ++begin) cell.push_back(begin->second);
      find_pairs_in(cell);
    }
  }

  bool may_coincide(const FlatPiece& a, const FlatPiece& b) const {
    return a.object != b.object || dot(a.plane.n, b.plane.n) < 0;
  }

  /// A sweep along x. Pieces of one object that face one way are not compared with each other.
  void find_pairs_in(const std::vector<int>& cell) {
    if (std::ranges::none_of(cell, [&](int i) { return may_coincide(piece(cell[0]), piece(i)); })) return;
    struct Bounded {
      Box box;
      int piece;
    };
    std::vector<Bounded> all;
    for (const int i : cell) {
      Box box;
      for (const dvec3& v : outline(piece(i))) box.add(v);
      all.push_back({box, i});
    }
    std::ranges::stable_sort(all, {}, [](const Bounded& b) { return b.box.low.x; });
    std::map<std::pair<int, bool>, std::vector<const Bounded*>> open;  // by object and side
    for (const Bounded& next : all) {
      const std::pair own{piece(next.piece).object, dot(piece(next.piece).plane.n, piece(cell[0]).plane.n) > 0};
      for (auto others = open.begin(); others != open.end();) {
        if (others->first == own) {
          ++others;
          continue;
        }
        std::erase_if(others->second, [&](const Bounded* b) { return b->box.high.x + widest() < next.box.low.x; });
        for (const Bounded* other : others->second)
          if (meet(other->box, next.box)) note_pair(other->piece, next.piece);
        others = others->second.empty() ? open.erase(others) : std::next(others);
      }
      open[own].push_back(&next);
    }
  }

  /// The largest tolerance.
  double widest() const { return coincident * box_.size(); }
  bool meet(const Box& a, const Box& b) const {
    return all(lessThanEqual(a.low, b.high + widest())) && all(lessThanEqual(b.low, a.high + widest()));
  }

  void note_pair(int a, int b) {
    const double least = std::min(area_of(outline(piece(a))), area_of(outline(piece(b))));
    if (common_area(piece(a), piece(b)) > gap * smaller_size(piece(a), piece(b)) * std::sqrt(least))
      pairs_.insert(std::minmax({a, b}));
  }

  /// The same polygon or mesh of one material, facing the same way.
  bool is_same(const FlatPiece& a, const FlatPiece& b) const {
    if (a.object == b.object || material(a.object) != material(b.object) || dot(a.plane.n, b.plane.n) < 0) return false;
    if (!is_mesh(a.object) && !is_mesh(b.object)) {
      const double larger = std::max(area_of(outline(a)), area_of(outline(b)));
      return common_area(a, b) >= larger * (1 - 1e-6);
    }
    if (!is_mesh(a.object) || !is_mesh(b.object)) return false;
    return mesh(a.object).triangles == mesh(b.object).triangles &&
           std::ranges::equal(mesh(a.object).vertices, mesh(b.object).vertices, [&](const dvec3& v, const dvec3& w) {
             return length(v - w) <= coincident * smaller_size(a, b);
           });
  }

  void find_repeated() {
    for (const auto& [a, b] : pairs_) {
      const int first = piece(a).object, second = piece(b).object;
      if (!repeated_.contains(first) && !repeated_.contains(second) && is_same(piece(a), piece(b)))
        repeated_.emplace(second, first);
    }
    std::erase_if(pairs_, [&](const auto& pair) {
      return repeated_.contains(piece(pair.first).object) || repeated_.contains(piece(pair.second).object);
    });
  }

  /// The part that a piece belongs to.
  int part_of(int seed) {
    for (int i = 0; i < static_cast<int>(parts_.size()); ++i)
      if (part(i).object == piece(seed).object && std::ranges::find(part(i).pieces, seed) != part(i).pieces.end())
        return i;
    const FlatPiece& s = piece(seed);
    PlanePart made{s.object, s.plane, {}};
    // The pieces of an object are in a row.
    for (int i = seed; i >= 0 && piece(i).object == s.object; --i) add_to(made, i, s.plane);
    for (int i = seed + 1; i < static_cast<int>(pieces_.size()) && piece(i).object == s.object; ++i)
      add_to(made, i, s.plane);
    const Material& m = *find_material(scene_, material(s.object));
    made.level = is_lamp(m) ? 2 : transmits(m) ? 1 : 0;
    if (is_mesh(s.object) && is_closed(mesh(s.object))) {
      const double volume = signed_volume(mesh(s.object));
      // One without thickness is a sheet with two fronts.
      made.body = std::abs(volume) > made.area * coincident * s.size;
      const bool around =
          !transmits(m) && reach_.inside && std::abs(winding_number(mesh(s.object), *reach_.inside)) > 0.5;
      if (made.body && (volume < 0) != around) made.plane = {-made.plane.n, -made.plane.d};
    }
    parts_.push_back(std::move(made));
    return static_cast<int>(parts_.size()) - 1;
  }
  void add_to(PlanePart& made, int i, const HalfSpace& plane) {
    if (!same_direction(piece(i).plane.n, plane.n) || !lies_in(outline(piece(i)), plane, coincident * piece(i).size))
      return;
    made.pieces.push_back(i);
    made.area += area_of(outline(piece(i)));
  }

  void relate_parts() {
    for (const auto& [a, b] : pairs_) {
      const int p = part_of(a), q = part_of(b);
      if (p == q) continue;
      double& size = related_[std::minmax({p, q})];
      size = std::max(size, smaller_size(piece(a), piece(b)));
    }
  }

  /// Groups of parts that are related, by way of others too.
  std::vector<std::vector<int>> groups() {
    std::vector<int> group(parts_.size());
    std::iota(group.begin(), group.end(), 0);
    const auto root = [&](int i) {
      while (group[static_cast<std::size_t>(i)] != i) i = group[static_cast<std::size_t>(i)];
      return i;
    };
    for (const auto& [pair, size] : related_) {
      const auto [low, high] = std::minmax({root(pair.first), root(pair.second)});
      group[static_cast<std::size_t>(high)] = low;
    }
    std::map<int, std::vector<int>> members;
    for (int i = 0; i < static_cast<int>(parts_.size()); ++i) members[root(i)].push_back(i);
    std::vector<std::vector<int>> result;
    result.reserve(members.size());
    for (auto& [first, all] : members) result.push_back(std::move(all));
    return result;
  }

  /// Puts the parts of each group in order along the normal of its largest, which stays where it is.
  void stack() {
    for (std::vector<int>& group : groups()) {
      if (group.size() < 2) continue;
      const int anchor = *std::ranges::max_element(group, {}, [&](int i) { return part(i).area; });
      const dvec3 up = part(anchor).plane.n;
      const auto side = [&](int i) { return dot(part(i).plane.n, up) > 0 ? 1 : -1; };
      const auto height = [&](int i) { return dot(up, outline(piece(part(i).pieces[0]))[0]); };

      double size = 0;
      for (const auto& [pair, around] : related_)
        if (std::ranges::find(group, pair.first) != group.end()) size = std::max(size, around);

      // Heights that differ by intent go before all else.
      std::ranges::stable_sort(group, {}, height);
      std::map<int, int> storey;
      for (std::size_t k = 0; k < group.size(); ++k)
        storey[group[k]] =
            k == 0 ? 0 : storey[group[k - 1]] + (height(group[k]) - height(group[k - 1]) > deliberate * size);
      const auto place = [&](int i) {
        const PlanePart& p = part(i);
        const int s = side(i), zone = p.body ? (s > 0 ? 0 : 3) : (s > 0 ? 2 : 1);
        // What lies in glass is smaller, and behind its face.
        const double outer = p.body && p.level == 1 ? p.area : -p.area;
        return std::tuple(storey[i], zone, s * p.level, s * outer, s * p.object);
      };
      std::ranges::sort(group, {}, place);
      for (std::size_t k = 0; k < group.size(); ++k)
        for (std::size_t below = 0; below < k; ++below)
          if (related_.contains(std::minmax({group[below], group[k]})))
            part(group[k]).layer = std::max(part(group[k]).layer, part(group[below]).layer + 1);
      for (const int i : group) part(i).move = side(i) * (part(i).layer - part(anchor).layer) * gap * size;
    }
  }

  void move_parts() {
    std::map<int, std::vector<const PlanePart*>> moved;
    for (const PlanePart& p : parts_)
      if (p.move != 0) moved[p.object].push_back(&p);
    for (const auto& [object, parts] : moved) {
      if (!is_mesh(object)) {
        for (dvec3& v : scene_.polygons[static_cast<std::size_t>(object)].vertices)
          v += parts[0]->plane.n * parts[0]->move;
        continue;
      }
      // Parts of one mesh that lie in each other may have vertices in common.
      const bool alone = std::ranges::none_of(related_, [&, own = object](const auto& r) {
        return part(r.first.first).object == own && part(r.first.second).object == own;
      });
      Mesh& moving = scene_.meshes[static_cast<std::size_t>(object - polygons_)];
      if (parts[0]->body && alone)
        move_faces(moving, parts);
      else
        move_copies(moving, parts);
    }
  }

  /// Moves each vertex so that the planes of all faces around it are moved as they are to be, and the mesh stays
  /// closed.
  void move_faces(Mesh& moving, const std::vector<const PlanePart*>& parts) {
    struct Constraint {
      dvec3 normal;
      double move;
    };
    std::vector<double> move(moving.triangles.size());
    std::vector<std::vector<Constraint>> constraints(moving.vertices.size());
    std::vector<bool> touched(moving.vertices.size());
    for (const PlanePart* p : parts)
      for (const int i : p->pieces) {
        const auto t = static_cast<std::size_t>(piece(i).triangle);
        move[t] = p->move * (dot(piece(i).plane.n, p->plane.n) > 0 ? 1 : -1);
        for (const int v : moving.triangles[t]) touched[static_cast<std::size_t>(v)] = true;
      }
    for (std::size_t t = 0; t < moving.triangles.size(); ++t) {
      const auto& corners = moving.triangles[t];
      if (std::ranges::none_of(corners, [&](int v) { return touched[static_cast<std::size_t>(v)]; })) continue;
      const dvec3 n = plane_of(triangle_vertices(moving, corners)).n;
      for (const int v : corners) {
        auto& own = constraints[static_cast<std::size_t>(v)];
        if (std::ranges::none_of(own, [&](const Constraint& c) { return same_direction(c.normal, n); }))
          own.push_back({n, move[t]});
      }
    }
    for (std::size_t v = 0; v < moving.vertices.size(); ++v) {
      if (!touched[v]) continue;
      // Least squares; the term without a constraint keeps a vertex that is free to slide where it is.
      glm::dmat3 squares(1e-9);
      dvec3 sum{0};
      for (const Constraint& c : constraints[v]) {
        squares += outerProduct(c.normal, c.normal);
        sum += c.normal * c.move;
      }
      moving.vertices[v] += inverse(squares) * sum;
    }
  }

  /// Moves triangles with vertices of their own.
  void move_copies(Mesh& moving, const std::vector<const PlanePart*>& parts) {
    for (const PlanePart* p : parts) {
      std::map<int, int> copy;
      for (const int i : p->pieces)
        for (int& v : moving.triangles[static_cast<std::size_t>(piece(i).triangle)]) {
          if (!copy.contains(v)) {
            copy[v] = static_cast<int>(moving.vertices.size());
            moving.vertices.push_back(moving.vertices[static_cast<std::size_t>(v)] + p->plane.n * p->move);
          }
          v = copy[v];
        }
    }
  }

  std::string display_name(int object) const {
    if (!name(object).empty()) return toml_string(name(object));
    return is_mesh(object) ? "mesh " + std::to_string(object - polygons_) : "polygon " + std::to_string(object);
  }

  void tell(std::vector<std::string>& told, std::vector<std::string>& warnings) {
    if (!repeated_.empty()) {
      const auto& [again, first] = *repeated_.begin();
      warnings.push_back(std::to_string(repeated_.size()) + (repeated_.size() == 1 ? " object is" : " objects are") +
                         " there twice and left out once; the first: " + display_name(again) + ", the same as " +
                         display_name(first));
    }
    if (!related_.empty()) {
      const auto& [p, q] = related_.begin()->first;
      told.push_back(std::to_string(related_.size()) + (related_.size() == 1 ? " pair" : " pairs") +
                     " of surfaces that coincide, moved apart; the first: " + display_name(part(p).object) + " and " +
                     display_name(part(q).object));
    }
  }

  void drop_repeated() {
    int object = 0;
    const auto again = [&](const auto&) { return repeated_.contains(object++); };
    std::erase_if(scene_.polygons, again);
    std::erase_if(scene_.meshes, again);
  }

  Scene& scene_;
  const Reach& reach_;
  int polygons_;
  Box box_;  ///< around the scene
  std::vector<FlatPiece> pieces_;
  std::set<std::pair<int, int>> pairs_;  ///< of pieces that coincide, the lower first
  std::map<int, int> repeated_;          ///< objects, and those that they repeat
  std::vector<PlanePart> parts_;
  /// Parts that coincide somewhere, the lower first, and the size of what is around.
  std::map<std::pair<int, int>, double> related_;
};

/// Spheres that coincide become shells of each other.
bool separate_spheres(Scene& scene, const Reach& reach, std::vector<std::string>& told,
                      std::vector<std::string>& warnings) {
  const Box box = box_of(scene);
  const auto size = [&](const Sphere& s) {
    return local_size(box, length(s.center - (box.low + box.high) / 2.0) + s.radius);
  };
  std::vector<std::size_t> order(scene.spheres.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::stable_sort(order, {}, [&](std::size_t i) { return scene.spheres[i].center.x; });
  // By the first of each group.
  std::map<std::size_t, std::set<std::size_t>> groups;
  for (std::size_t i = 0; i < order.size(); ++i)
    for (std::size_t k = i + 1; k < order.size(); ++k) {
      const auto [low, high] = std::minmax({order[i], order[k]});
      const Sphere &a = scene.spheres[low], &b = scene.spheres[high];
      if (scene.spheres[order[k]].center.x - scene.spheres[order[i]].center.x > coincident * size(a)) break;
      if (std::max(length(a.center - b.center), std::abs(a.radius - b.radius)) <= coincident * size(a))
        groups[low].insert(high);
    }
  std::set<std::size_t> repeated;
  std::string first_repeated, first_pair;
  std::size_t pairs = 0;
  for (const auto& [first, others] : groups) {
    if (repeated.contains(first)) continue;
    std::vector<std::size_t> shells{first};
    for (const std::size_t i : others) {
      if (repeated.contains(i)) continue;
      const auto same = std::ranges::find_if(
          shells, [&](std::size_t k) { return scene.spheres[k].material == scene.spheres[i].material; });
      if (same == shells.end()) {
        shells.push_back(i);
        continue;
      }
      if (repeated.empty())
        first_repeated = toml_string(scene.spheres[i].name) + ", the same as " + toml_string(scene.spheres[*same].name);
      repeated.insert(i);
    }
    if (shells.size() < 2) continue;
    const auto level = [&](std::size_t i) {
      const Material& m = *find_material(scene, scene.spheres[i].material);
      return is_lamp(m) ? 2 : transmits(m) ? 1 : 0;
    };
    std::ranges::stable_sort(shells, {}, level);
    const bool around =
        reach.inside && length(*reach.inside - scene.spheres[first].center) < scene.spheres[first].radius;
    for (std::size_t k = 1; k < shells.size(); ++k) {
      if (pairs++ == 0)
        first_pair = toml_string(scene.spheres[shells[0]].name) + " and " + toml_string(scene.spheres[shells[k]].name);
      scene.spheres[shells[k]].radius = scene.spheres[shells[0]].radius +
                                        static_cast<double>(k) * gap * size(scene.spheres[first]) * (around ? -1 : 1);
    }
  }
  if (!repeated.empty())
    warnings.push_back(std::to_string(repeated.size()) + (repeated.size() == 1 ? " sphere is" : " spheres are") +
                       " there twice and left out once; the first: " + first_repeated);
  if (pairs > 0)
    told.push_back(std::to_string(pairs) + (pairs == 1 ? " pair" : " pairs") +
                   " of spheres that coincide, moved apart; the first: " + first_pair);
  std::size_t next = 0;
  std::erase_if(scene.spheres, [&](const Sphere&) { return repeated.contains(next++); });
  return !repeated.empty() || pairs > 0;
}

}  // namespace

bool separate_coincident(Scene& scene, const Reach& reach, std::vector<std::string>& told,
                         std::vector<std::string>& warnings) {
  const bool spheres = separate_spheres(scene, reach, told, warnings);
  return Coincidences(scene, reach).separate(told, warnings) || spheres;
}

}  // namespace glimt
