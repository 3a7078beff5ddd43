#include "compile/coincide.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <map>
#include <numeric>
#include <tuple>

#include "compile/flat_pieces.h"
#include "scene/fields.h"
#include "scene/geometry/mesh_measures.h"
#include "scene/geometry/move_faces.h"

namespace glimt {
namespace {

using glm::dvec3;

/// In sizes of what is around: heights that differ by more are no error of single precision, so their order is meant.
constexpr double deliberate_distance = 0x1p-25;

/// What of an object is in one plane and faces one way.
struct PlanePart {
  int object = 0;
  dvec3 front{0};  ///< unit, to the front of a sheet, out of a body
  std::vector<int> pieces;
  double area = 0;
  bool body = false;
  int level = 0;            ///< the higher, the more in front
  int layer = 0;            ///< above others of its plane
  double move = 0;          ///< along `front`, metres
  std::vector<int> others;  ///< parts that it coincides with somewhere
  double size = 0;          ///< of what is around where it does
};

class Coincidences {
 public:
  Coincidences(Scene& scene, const Reach& reach)
      : scene_(scene), reach_(reach), pieces_(scene, reach), pairs_(pieces_.coincident_pairs()) {}

  bool separate(CoincidenceNotes& notes) {
    if (pairs_.empty()) return false;
    find_repeated();
    relate_parts();
    for (std::vector<int>& group : groups()) stack(group);
    tell(notes);
    move_parts();
    drop_repeated();
    return true;
  }

 private:
  PlanePart& part(int i) { return parts_[static_cast<std::size_t>(i)]; }

  void find_repeated() {
    const auto object = [&](int i) { return pieces_[i].object; };
    for (const auto& [a, b] : pairs_)
      if (!repeated_.contains(object(a)) && !repeated_.contains(object(b)) &&
          pieces_.are_of_same_shape(pieces_[a], pieces_[b]))
        repeated_.emplace(object(b), object(a));
    std::erase_if(pairs_, [&](const auto& pair) {
      return repeated_.contains(object(pair.first)) || repeated_.contains(object(pair.second));
    });
  }

  /// The part that a piece belongs to.
  int part_of(int seed) {
    int& known = part_of_piece_[static_cast<std::size_t>(seed)];
    if (known >= 0) return known;
    const FlatPiece& s = pieces_[seed];
    PlanePart made;
    made.object = s.object;
    made.front = s.plane.n;
    const auto number = static_cast<int>(parts_.size());
    // The pieces of an object are in a row. False past its end.
    const auto take = [&](int i) {
      if (i < 0 || i >= pieces_.count() || pieces_[i].object != s.object) return false;
      const FlatPiece& p = pieces_[i];
      const std::vector<dvec3> outline = pieces_.outline(p);
      if (same_direction(p.plane.n, s.plane.n) && lies_in(outline, s.plane, coincident_distance * p.size)) {
        made.pieces.push_back(i);
        made.area += area_of(outline);
        part_of_piece_[static_cast<std::size_t>(i)] = number;
      }
      return true;
    };
    for (int i = seed; take(i);) --i;
    for (int i = seed + 1; take(i);) ++i;
    const Material& m = *find_material(scene_, pieces_.material(s.object));
    made.level = is_lamp(m) ? 2 : transmits(m) ? 1 : 0;
    if (pieces_.is_mesh(s.object) && is_closed(pieces_.mesh(s.object))) {
      const Mesh& mesh = pieces_.mesh(s.object);
      const double volume = signed_volume(mesh);
      // One without thickness is a sheet with two fronts.
      made.body = std::abs(volume) > made.area * coincident_distance * s.size;
      const bool around = !transmits(m) && reach_.inside && std::abs(winding_number(mesh, *reach_.inside)) > 0.5;
      if (made.body && (volume < 0) != around) made.front = -made.front;
    }
    parts_.push_back(std::move(made));
    return number;
  }

  void relate_parts() {
    part_of_piece_.assign(static_cast<std::size_t>(pieces_.count()), -1);
    for (const auto& [a, b] : pairs_) {
      const int p = part_of(a), q = part_of(b);
      if (p == q) continue;
      const double size = std::min(pieces_[a].size, pieces_[b].size);
      for (const auto& [one, other] : {std::pair{p, q}, {q, p}}) {
        part(one).size = std::max(part(one).size, size);
        if (std::ranges::find(part(one).others, other) == part(one).others.end()) part(one).others.push_back(other);
      }
    }
  }

  /// Groups of parts that are related, by way of others too.
  std::vector<std::vector<int>> groups() {
    std::vector<std::vector<int>> all;
    std::vector<bool> seen(parts_.size());
    for (int i = 0; i < static_cast<int>(parts_.size()); ++i) {
      if (seen[static_cast<std::size_t>(i)]) continue;
      seen[static_cast<std::size_t>(i)] = true;
      std::vector<int> group{i};
      for (std::size_t k = 0; k < group.size(); ++k)
        for (const int other : part(group[k]).others)
          if (!seen[static_cast<std::size_t>(other)]) {
            seen[static_cast<std::size_t>(other)] = true;
            group.push_back(other);
          }
      all.push_back(std::move(group));
    }
    return all;
  }

  /// Puts the parts of a group in order along the normal of its largest, which stays where it is.
  void stack(std::vector<int>& group) {
    const int anchor = *std::ranges::max_element(group, {}, [&](int i) { return part(i).area; });
    const dvec3 up = part(anchor).front;
    const auto side = [&](int i) { return dot(part(i).front, up) > 0 ? 1 : -1; };
    const auto height = [&](int i) { return dot(up, pieces_.outline(pieces_[part(i).pieces[0]])[0]); };
    double size = 0;
    for (const int i : group) size = std::max(size, part(i).size);

    // Heights that differ by intent go before all else.
    std::ranges::stable_sort(group, {}, height);
    std::map<int, int> storey;
    for (std::size_t k = 1; k < group.size(); ++k) {
      const bool higher = height(group[k]) - height(group[k - 1]) > deliberate_distance * size;
      storey[group[k]] = storey[group[k - 1]] + (higher ? 1 : 0);
    }
    const auto place = [&](int i) {
      const PlanePart& p = part(i);
      const int s = side(i), zone = p.body ? (s > 0 ? 0 : 3) : (s > 0 ? 2 : 1);
      // What lies in glass is smaller, and behind its face.
      const double outer = p.body && p.level == 1 ? p.area : -p.area;
      return std::tuple(storey[i], zone, s * p.level, s * outer, s * p.object);
    };
    std::ranges::sort(group, {}, place);
    std::map<int, bool> placed;
    for (const int i : group) {
      for (const int below : part(i).others)
        if (placed[below]) part(i).layer = std::max(part(i).layer, part(below).layer + 1);
      placed[i] = true;
    }
    for (const int i : group) part(i).move = side(i) * (part(i).layer - part(anchor).layer) * least_gap * size;
  }

  void move_parts() {
    struct Moves {
      std::vector<FaceMove> faces;
      bool in_one = true;  ///< the mesh may move as one, its vertices shared
    };
    std::map<std::size_t, Moves> meshes;
    for (const PlanePart& p : parts_) {
      const dvec3 by = p.front * p.move;
      if (!pieces_.is_mesh(p.object)) {
        for (dvec3& v : scene_.polygons[static_cast<std::size_t>(p.object)].vertices) v += by;
        continue;
      }
      Moves& moves = meshes[pieces_.mesh_index(p.object)];
      // Parts of one mesh that lie in each other may have vertices in common.
      const bool alone = std::ranges::none_of(p.others, [&](int other) { return part(other).object == p.object; });
      moves.in_one = moves.in_one && p.body && alone;
      if (p.move == 0) continue;
      for (const int i : p.pieces) moves.faces.push_back({pieces_[i].triangle, by});
    }
    for (const auto& [index, moves] : meshes)
      (moves.in_one ? move_faces : move_apart)(scene_.meshes[index], moves.faces);
  }

  void tell(CoincidenceNotes& notes) {
    if (!repeated_.empty()) {
      const auto& [again, first] = *repeated_.begin();
      notes.warnings.push_back(std::to_string(repeated_.size()) +
                               (repeated_.size() == 1 ? " object is" : " objects are") +
                               " there twice and left out once; the first: " + pieces_.called(again) +
                               ", the same as " + pieces_.called(first));
    }
    if (parts_.empty()) return;
    std::size_t ends = 0;
    for (const PlanePart& p : parts_) ends += p.others.size();
    notes.told.push_back(std::to_string(ends / 2) + (ends == 2 ? " pair" : " pairs") +
                         " of surfaces that coincide, moved apart; the first: " + pieces_.called(parts_[0].object) +
                         " and " + pieces_.called(part(parts_[0].others[0]).object));
  }

  void drop_repeated() {
    int object = 0;
    const auto again = [&](const auto&) { return repeated_.contains(object++); };
    std::erase_if(scene_.polygons, again);
    std::erase_if(scene_.meshes, again);
  }

  Scene& scene_;
  const Reach& reach_;
  FlatPieces pieces_;
  std::set<std::pair<int, int>> pairs_;  ///< of pieces that coincide, the lower first
  std::map<int, int> repeated_;          ///< objects, and those that they repeat
  std::vector<PlanePart> parts_;
  std::vector<int> part_of_piece_;
};

}  // namespace

bool separate_coincident(Scene& scene, const Reach& reach, CoincidenceNotes& notes) {
  const bool spheres = separate_coincident_spheres(scene, reach, notes);
  return Coincidences(scene, reach).separate(notes) || spheres;
}

}  // namespace glimt
