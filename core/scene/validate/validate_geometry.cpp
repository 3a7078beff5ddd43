#include <algorithm>
#include <cmath>

#include "scene/fields.h"
#include "scene/geometry/convex_pieces.h"
#include "scene/geometry/geometry_cache.h"
#include "scene/geometry/mend.h"
#include "scene/validate/validate_parts.h"

namespace glimt {
namespace {

using glm::dvec3;

bool check_vertices(const std::vector<dvec3>& vertices, const std::string& path, const std::string& who,
                    Problems& problems) {
  const std::size_t before = problems.size();
  for (std::size_t i = 0; i < vertices.size(); ++i)
    for (int axis = 0; axis < 3; ++axis)
      if (const double x = vertices[i][axis]; !(std::abs(x) <= max_coordinate)) {
        problems.push_back({path + "." + element("vertices", i),
                            who + ": vertex " + std::to_string(i) + " has the coordinate " + number_text(x) +
                                "; allowed is " + range_text(-max_coordinate, max_coordinate, false)});
        break;
      }
  return problems.size() == before;
}

}  // namespace

void check_polygon(const Polygon& polygon, std::size_t index, Problems& problems) {
  const std::string path = element("polygon", index), who = called("polygon", polygon.name, index);
  if (!check_vertices(polygon.vertices, path, who, problems)) return;
  const ConvexPieces cut = convex_pieces(polygon.vertices);
  if (cut.mistake.empty()) return;
  const std::string place = cut.vertex < 0 ? "vertices" : element("vertices", static_cast<std::size_t>(cut.vertex));
  problems.push_back({path + "." + place, who + ": " + cut.mistake});
}

namespace {

void find_problems(const Mesh& mesh, std::size_t index, Problems& problems) {
  const std::string path = element("mesh", index), who = called("mesh", mesh.name, index);
  const bool finite = check_vertices(mesh.vertices, path, who, problems);
  if (mesh.triangles.empty())
    problems.push_back({path + ".triangles", who + ": it has no triangles; allowed are 1 or more"});
  const auto count = static_cast<int>(mesh.vertices.size());
  const std::size_t before = problems.size();
  bool some_area = mesh.triangles.empty();
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    const auto blame = [&](const std::string& mistake) {
      problems.push_back(
          {path + "." + element("triangles", i), who + ": triangle " + std::to_string(i) + " " + mistake});
    };
    const auto& t = mesh.triangles[i];
    if (const auto bad = std::ranges::find_if(t, [&](int k) { return k < 0 || k >= count; }); bad != t.end()) {
      blame("names vertex " + std::to_string(*bad) +
            (count > 0 ? "; allowed is 0 to " + std::to_string(count - 1) : "; the mesh has no vertices"));
      continue;
    }
    if (finite) {
      const auto vertex = [&](std::size_t k) { return mesh.vertices[static_cast<std::size_t>(t[k])]; };
      some_area |= !has_no_area(vertex(0), vertex(1), vertex(2));
    }
  }
  if (finite && !some_area && problems.size() == before)
    problems.push_back({path + ".triangles", who + ": none of its triangles has an area; allowed is at least one"});
}

}  // namespace

void check_mesh(const Mesh& mesh, std::size_t index, Problems& problems) {
  const auto check = [&] {
    Problems found;
    find_problems(mesh, index, found);
    problems.insert(problems.end(), found.begin(), found.end());
    return found.empty();
  };
  // Large ones are looked at once, or again to tell their problems.
  static GeometryCache<bool> known;
  bool fresh = false;
  const bool valid = is_large(mesh) && *known.get(mesh, [&] { return fresh = true, check(); });
  if (!valid && !fresh) check();
}

}  // namespace glimt
