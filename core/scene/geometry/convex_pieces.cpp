#include "scene/geometry/convex_pieces.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <numbers>
#include <numeric>
#include <optional>

#include "scene/file/text.h"
#include "scene/geometry/room.h"

namespace glimt {
namespace {

using glm::dvec2;
using glm::dvec3;

/// Relative to the shape's size: vertices less than this off the plane are in it, and corners that turn inward less
/// are straight.
constexpr double flat_tolerance = 1e-6;
/// Relative to the shape's size: vertices farther off the plane are a mistake. Which way the outline is cut would show.
constexpr double most_bent = 0.01;

double size_of(const std::vector<dvec3>& v) {
  dvec3 low = v[0], high = v[0];
  for (const dvec3& p : v) low = min(low, p), high = max(high, p);
  return length(high - low);
}

/// Indices of the vertices without those that are where the one before them is, and without tips of spikes, from which
/// the outline goes back the way it came.
std::vector<int> without_waste(const std::vector<dvec3>& v, double size) {
  std::vector<int> kept(v.size());
  std::iota(kept.begin(), kept.end(), 0);
  for (std::size_t clean = 0, i = 0; kept.size() > 1 && clean < kept.size();) {
    const std::size_t n = kept.size();
    const auto at = [&](std::size_t k) { return v[static_cast<std::size_t>(kept[k % n])]; };
    const dvec3 in = at(i + 1) - at(i), out = at(i + 2) - at(i + 1);
    const bool repeats = length(in) <= degenerate * size;
    const bool turns_back = length(cross(in, out)) <= degenerate * size * size && dot(in, out) < 0;
    if (repeats || turns_back) {
      const std::size_t gone = (i + 1) % n;
      kept.erase(kept.begin() + static_cast<std::ptrdiff_t>(gone));
      // What was fine so far may meet its new neighbours.
      clean = 0;
      i = (gone + 2 * kept.size() - 2) % kept.size();
    } else {
      ++clean;
      i = (i + 1) % n;
    }
  }
  return kept;
}

std::vector<double> heights(const std::vector<dvec3>& v, const dvec3& normal) {
  dvec3 centre{0};
  for (const dvec3& p : v) centre += p / static_cast<double>(v.size());
  std::vector<double> off;
  off.reserve(v.size());
  for (const dvec3& p : v) off.push_back(std::abs(dot(normal, p - centre)));
  return off;
}

/// Every corner turns the same way, and all together turn once.
bool is_convex(const std::vector<dvec3>& v, const dvec3& normal) {
  const std::size_t n = v.size();
  double turned = 0;
  for (std::size_t i = 0; i < n; ++i) {
    const dvec3 in = normalize(v[(i + 1) % n] - v[i]), out = normalize(v[(i + 2) % n] - v[(i + 1) % n]);
    const double sine = dot(normal, cross(in, out));
    if (sine < -flat_tolerance) return false;
    turned += std::atan2(sine, dot(in, out));
  }
  return std::abs(turned - 2 * std::numbers::pi) < 0.1;
}

bool is_flat_and_convex(const std::vector<dvec3>& v) {
  const dvec3 normal = plane_of(v).n;
  return std::ranges::max(heights(v, normal)) <= flat_tolerance * size_of(v) && is_convex(v, normal);
}

/// Twice the area of the triangle, positive where it is counter-clockwise.
double turn(const dvec2& a, const dvec2& b, const dvec2& c) {
  return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

bool edges_cross(const std::vector<dvec2>& p, double least) {
  const std::size_t n = p.size();
  const auto apart = [&](double s, double t) { return (s > least && t < -least) || (s < -least && t > least); };
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t k = i + 2; k < n; ++k) {
      const dvec2 &a = p[i], &b = p[i + 1], &c = p[k], &d = p[(k + 1) % n];
      if (apart(turn(a, b, c), turn(a, b, d)) && apart(turn(c, d, a), turn(c, d, b))) return true;
    }
  return false;
}

using Ring = std::vector<int>;  ///< indices of vertices

/// Cuts off ears, triangles of three corners in a row that hold no other (Meisters, "Polygons have ears", 1975).
/// Nothing where there is none, as in outlines that cross themselves.
std::optional<std::vector<Ring>> triangulated(const std::vector<dvec2>& p, double least) {
  Ring ring(p.size());
  std::iota(ring.begin(), ring.end(), 0);
  const auto at = [&](int i) { return p[static_cast<std::size_t>(i)]; };
  std::vector<Ring> triangles;
  const auto cut = [&](std::size_t k) {
    const std::size_t n = ring.size();
    const int first = ring[(k + n - 1) % n], tip = ring[k], last = ring[(k + 1) % n];
    const dvec2 a = at(first), b = at(tip), c = at(last);
    const double twice_area = turn(a, b, c);
    if (twice_area < -least) return false;
    if (twice_area > least) {
      const bool holds_other = std::ranges::any_of(ring, [&](int i) {
        const dvec2 q = at(i);
        return q != a && q != b && q != c && turn(a, b, q) >= 0 && turn(b, c, q) >= 0 && turn(c, a, q) >= 0;
      });
      if (holds_other) return false;
      triangles.push_back({first, tip, last});
    }
    ring.erase(ring.begin() + static_cast<std::ptrdiff_t>(k));
    return true;
  };
  while (ring.size() > 2) {
    std::size_t k = 0;
    while (k < ring.size() && !cut(k)) ++k;
    if (k == ring.size() && ring.size() > 2) return std::nullopt;
  }
  return triangles;
}

/// Both pieces in one, where they share an edge.
std::optional<Ring> joined_at_edge(const Ring& a, const Ring& b) {
  for (std::size_t i = 0; i < a.size(); ++i)
    for (std::size_t k = 0; k < b.size(); ++k) {
      if (a[i] != b[(k + 1) % b.size()] || a[(i + 1) % a.size()] != b[k]) continue;
      Ring all;
      for (std::size_t m = 1; m <= a.size(); ++m) all.push_back(a[(i + m) % a.size()]);
      for (std::size_t m = 2; m < b.size(); ++m) all.push_back(b[(k + m) % b.size()]);
      return all;
    }
  return std::nullopt;
}

std::vector<dvec3> corners(const Ring& ring, const std::vector<dvec3>& v) {
  std::vector<dvec3> all;
  for (const int i : ring) all.push_back(v[static_cast<std::size_t>(i)]);
  return all;
}

/// Leaves out the edges without which pieces stay convex (Hertel and Mehlhorn, "Fast triangulation of the plane with
/// respect to simple polygons", 1985) and flat.
void join_pieces(std::vector<Ring>& pieces, const std::vector<dvec3>& v) {
  for (std::size_t i = 0; i < pieces.size(); ++i)
    for (std::size_t k = i + 1; k < pieces.size();) {
      const std::optional<Ring> both = joined_at_edge(pieces[i], pieces[k]);
      if (both && is_flat_and_convex(corners(*both, v))) {
        pieces[i] = *both;
        pieces.erase(pieces.begin() + static_cast<std::ptrdiff_t>(k));
        k = i + 1;
      } else {
        ++k;
      }
    }
}

}  // namespace

ConvexPieces convex_pieces(const std::vector<dvec3>& outline) {
  ConvexPieces result;
  const auto wrong = [&](std::string mistake, int vertex = -1) {
    result.mistake = std::move(mistake);
    result.vertex = vertex;
    return result;
  };
  if (outline.size() < 3) return wrong("it has " + std::to_string(outline.size()) + " vertices; allowed are 3 or more");
  const double size = size_of(outline);
  const Ring kept = without_waste(outline, size);
  if (kept.size() < 3) return wrong("it has no area; allowed are 3 or more vertices that are not on one line");
  const std::vector<dvec3> v = corners(kept, outline);
  result.left_out = static_cast<int>(outline.size() - v.size());
  if (area_of(v) <= degenerate * size * size / 2)
    return wrong("it has no area, or its edges cross; allowed are polygons with an area");

  const dvec3 normal = plane_of(v).n;
  const std::vector<double> off = heights(v, normal);
  const auto worst = std::ranges::max_element(off);
  if (*worst > most_bent * size) {
    const int vertex = kept[static_cast<std::size_t>(worst - off.begin())];
    return wrong("vertex " + std::to_string(vertex) + " is " + number_text(*worst) +
                     " m off the plane of the vertices; allowed are planar polygons, to within " +
                     number_text(most_bent * size) + " m",
                 vertex);
  }
  if (*worst <= flat_tolerance * size && is_convex(v, normal)) {
    result.pieces = {v};
    return result;
  }

  result.bent = true;
  const dvec3 axis = std::abs(normal.x) < 0.6 ? dvec3{1, 0, 0} : dvec3{0, 1, 0};
  const dvec3 right = normalize(cross(axis, normal)), up = cross(normal, right);
  std::vector<dvec2> flat;
  flat.reserve(v.size());
  for (const dvec3& p : v) flat.emplace_back(dot(p - v[0], right), dot(p - v[0], up));
  const double least = degenerate * size * size;
  std::optional<std::vector<Ring>> pieces;
  if (!edges_cross(flat, least)) pieces = triangulated(flat, least);
  if (!pieces || pieces->empty()) return wrong("its edges cross; allowed are edges that meet at vertices only");
  join_pieces(*pieces, v);
  for (const Ring& piece : *pieces) result.pieces.push_back(corners(piece, v));
  return result;
}

}  // namespace glimt
