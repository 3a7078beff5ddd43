#include <algorithm>
#include <cmath>
#include <cstdint>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <numbers>
#include <unordered_map>

#include "scene/fields.h"
#include "scene/validate/validate_parts.h"

namespace glimt {
namespace {

using glm::dvec3;

/// Relative to the shape's size: how far vertices may be off the plane, and corners may turn inward.
constexpr double flat_tolerance = 1e-6;
/// Relative to the size (squared for areas): less is nothing.
constexpr double degenerate = 1e-10;

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

/// Twice the area, along the normal (Newell's method).
dvec3 area_vector(const std::vector<dvec3>& v) {
  dvec3 sum{0};
  for (std::size_t i = 1; i + 1 < v.size(); ++i) sum += cross(v[i] - v[0], v[i + 1] - v[0]);
  return sum;
}

/// What is wrong with an outline of finite vertices; `vertex` is set where one is to blame.
std::string outline_mistake(const std::vector<dvec3>& v, int& vertex) {
  const std::size_t n = v.size();
  if (n < 3) return "it has " + std::to_string(n) + " vertices; allowed are 3 or more";
  dvec3 low = v[0], high = v[0], centre{0};
  for (const dvec3& p : v) low = min(low, p), high = max(high, p), centre += p / static_cast<double>(n);
  const double size = length(high - low);

  for (std::size_t i = 0; i < n; ++i)
    if (length(v[(i + 1) % n] - v[i]) <= degenerate * size) {
      vertex = static_cast<int>(i);
      return "vertices " + std::to_string(i) + " and " + std::to_string((i + 1) % n) +
             " coincide; allowed are vertices that differ from their neighbours";
    }
  const dvec3 area = area_vector(v);
  if (length(area) <= degenerate * size * size)
    return "it has no area, or its edges cross; allowed are convex polygons with an area";
  const dvec3 normal = normalize(area);

  const auto off_plane = [&](const dvec3& p) { return std::abs(dot(normal, p - centre)); };
  const auto worst = std::ranges::max_element(v, {}, off_plane);
  if (off_plane(*worst) > flat_tolerance * size) {
    vertex = static_cast<int>(worst - v.begin());
    return "vertex " + std::to_string(vertex) + " is " + number_text(off_plane(*worst)) +
           " m off the plane of the vertices; allowed are planar polygons, to within " +
           number_text(flat_tolerance * size) + " m";
  }

  // Convex: every corner turns the same way, and all together turn once.
  double turned = 0;
  for (std::size_t i = 0; i < n; ++i) {
    const dvec3 in = normalize(v[(i + 1) % n] - v[i]), out = normalize(v[(i + 2) % n] - v[(i + 1) % n]);
    const double sine = dot(normal, cross(in, out));
    if (sine < -flat_tolerance) {
      vertex = static_cast<int>((i + 1) % n);
      return "it is not convex at vertex " + std::to_string(vertex) +
             "; allowed are convex polygons, and others in convex pieces";
    }
    turned += std::atan2(sine, dot(in, out));
  }
  if (std::abs(turned - 2 * std::numbers::pi) > 0.1) return "its edges cross; allowed are convex polygons";
  return {};
}

std::uint64_t directed(int from, int to) {
  return static_cast<std::uint64_t>(static_cast<std::uint32_t>(from)) << 32 | static_cast<std::uint32_t>(to);
}

}  // namespace

void check_polygon(const Polygon& polygon, std::size_t index, Problems& problems) {
  const std::string path = element("polygon", index), who = called("polygon", polygon.name, index);
  if (!check_vertices(polygon.vertices, path, who, problems)) return;
  int vertex = -1;
  const std::string mistake = outline_mistake(polygon.vertices, vertex);
  if (mistake.empty()) return;
  const std::string place = vertex < 0 ? "vertices" : element("vertices", static_cast<std::size_t>(vertex));
  problems.push_back({path + "." + place, who + ": " + mistake});
}

void check_mesh(const Mesh& mesh, std::size_t index, Problems& problems) {
  const std::string path = element("mesh", index), who = called("mesh", mesh.name, index);
  const bool finite = check_vertices(mesh.vertices, path, who, problems);
  if (mesh.triangles.empty())
    problems.push_back({path + ".triangles", who + ": it has no triangles; allowed are 1 or more"});
  const auto count = static_cast<int>(mesh.vertices.size());
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
    if (!finite) continue;
    const std::vector<dvec3> v{mesh.vertices[static_cast<std::size_t>(t[0])],
                               mesh.vertices[static_cast<std::size_t>(t[1])],
                               mesh.vertices[static_cast<std::size_t>(t[2])]};
    const double size = std::max({length(v[1] - v[0]), length(v[2] - v[1]), length(v[0] - v[2])});
    if (!(length(area_vector(v)) > degenerate * size * size))
      blame("has no area; allowed are three corners that are not on one line");
  }
}

bool is_closed(const Mesh& mesh) {
  std::unordered_map<std::uint64_t, int> uses;
  for (const auto& t : mesh.triangles)
    for (std::size_t k = 0; k < 3; ++k) ++uses[directed(t[k], t[(k + 1) % 3])];
  for (const auto& t : mesh.triangles)
    for (std::size_t k = 0; k < 3; ++k) {
      const auto reverse = uses.find(directed(t[(k + 1) % 3], t[k]));
      if (uses[directed(t[k], t[(k + 1) % 3])] != 1 || reverse == uses.end() || reverse->second != 1) return false;
    }
  return !mesh.triangles.empty();
}

}  // namespace glimt
