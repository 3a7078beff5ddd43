#include "scene/geometry/room.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <optional>

namespace glimt {

using glm::dvec3;

HalfSpace plane_of(const std::vector<dvec3>& vertices) {
  dvec3 normal{0}, centre{0};
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    const dvec3& a = vertices[i];
    const dvec3& b = vertices[(i + 1) % vertices.size()];
    normal += cross(a - vertices[0], b - vertices[0]);
    centre += a;
  }
  normal = normalize(normal);
  return {normal, dot(normal, centre) / static_cast<double>(vertices.size())};
}

double area_of(const std::vector<dvec3>& vertices) {
  dvec3 sum{0};
  for (std::size_t i = 2; i < vertices.size(); ++i)
    sum += cross(vertices[i - 1] - vertices[0], vertices[i] - vertices[0]);
  return length(sum) / 2;
}

double distance_to_segment(const dvec3& p, const dvec3& a, const dvec3& b) {
  const dvec3 ab = b - a;
  const double along = std::clamp(dot(p - a, ab) / dot(ab, ab), 0.0, 1.0);
  return length(p - a - ab * along);
}

double distance_to_polygon(const dvec3& p, const std::vector<dvec3>& polygon) {
  const HalfSpace plane = plane_of(polygon);
  double distance = std::abs(dot(plane.n, p) - plane.d);
  bool above = true;
  double edge = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const dvec3 &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
    above = above && dot(cross(plane.n, b - a), p - a) >= 0;
    edge = std::min(edge, distance_to_segment(p, a, b));
  }
  return above ? distance : edge;
}

std::vector<dvec3> clip(const std::vector<dvec3>& polygon, const HalfSpace& h) {
  std::vector<dvec3> result;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const dvec3& a = polygon[i];
    const dvec3& b = polygon[(i + 1) % polygon.size()];
    const double da = dot(h.n, a) - h.d;
    const double db = dot(h.n, b) - h.d;
    if (da <= 0) result.push_back(a);
    if ((da < 0 && db > 0) || (da > 0 && db < 0)) result.push_back(a + (b - a) * (da / (da - db)));
  }
  if (result.size() < 3) result.clear();
  return result;
}

namespace {

/// Faces that share a plane, which is oriented so that the eye is inside.
struct Plane {
  HalfSpace inside;
  std::vector<const Face*> faces;
};

std::vector<Plane> planes_of(const std::vector<Face>& faces, const dvec3& eye, double tolerance) {
  std::vector<Plane> planes;
  for (const Face& face : faces) {
    HalfSpace h = plane_of(face.vertices);
    if (dot(h.n, eye) > h.d) h = {-h.n, -h.d};
    if (h.d - dot(h.n, eye) <= tolerance) continue;  // the eye lies in it, so it bounds nothing
    auto same = std::find_if(planes.begin(), planes.end(), [&](const Plane& p) {
      return std::all_of(face.vertices.begin(), face.vertices.end(),
                         [&](const dvec3& v) { return std::abs(dot(p.inside.n, v) - p.inside.d) <= tolerance; });
    });
    if (same == planes.end()) same = planes.insert(planes.end(), {h, {}});
    same->faces.push_back(&face);
  }
  return planes;
}

/// A square of that half width in the plane, about the point of the plane nearest to `centre`.
std::vector<dvec3> square_in(const HalfSpace& h, const dvec3& centre, double half_width) {
  const dvec3 foot = centre - h.n * (dot(h.n, centre) - h.d);
  const dvec3 axis = std::abs(h.n.x) < 0.6 ? dvec3{1, 0, 0} : dvec3{0, 1, 0};
  const dvec3 u = normalize(cross(h.n, axis)) * half_width;
  const dvec3 v = cross(h.n, u);
  return {foot - u - v, foot + u - v, foot + u + v, foot - u + v};
}

/// What the face leaves uncovered of convex pieces of its plane, again as convex pieces.
std::vector<std::vector<dvec3>> uncovered(const std::vector<std::vector<dvec3>>& pieces, const Face& face) {
  const dvec3 n = plane_of(face.vertices).n;
  std::vector<std::vector<dvec3>> result;
  for (std::vector<dvec3> piece : pieces)
    for (std::size_t i = 0; i < face.vertices.size() && !piece.empty(); ++i) {
      const dvec3& a = face.vertices[i];
      const dvec3 out = normalize(cross(face.vertices[(i + 1) % face.vertices.size()] - a, n));
      const HalfSpace inside{out, dot(out, a)};
      if (std::vector<dvec3> beyond = clip(piece, {-inside.n, -inside.d}); !beyond.empty())
        result.push_back(std::move(beyond));
      piece = clip(piece, inside);
    }
  return result;
}

/// The side of the room on this plane, where faces of one material, all with the same side to the room, cover the
/// outline.
std::optional<RoomFace> cover(const Plane& plane, const std::vector<dvec3>& outline, double tolerance) {
  auto is_front = [&](const Face& face) { return dot(plane_of(face.vertices).n, plane.inside.n) < 0; };
  for (const Face* first : plane.faces) {
    RoomFace side{plane.inside, outline, first->material, is_front(*first)};
    std::vector<std::vector<dvec3>> rest{outline};
    for (const Face* face : plane.faces)
      if (face->material == side.material && is_front(*face) == side.front) rest = uncovered(rest, *face);
    double area = 0;
    for (const std::vector<dvec3>& piece : rest) area += area_of(piece);
    if (area <= tolerance * std::sqrt(area_of(outline))) return side;
  }
  return std::nullopt;
}

}  // namespace

std::vector<RoomFace> find_room(const std::vector<Face>& faces, const dvec3& eye, double tolerance) {
  double reach = 0;
  for (const Face& face : faces)
    for (const dvec3& v : face.vertices) reach = std::max(reach, length(v - eye));

  std::vector<Plane> planes = planes_of(faces, eye, tolerance);
  while (planes.size() >= 4) {
    std::vector<RoomFace> room;
    std::vector<Plane> kept;
    for (const Plane& plane : planes) {
      // No vertex is farther than `reach`, so a face cannot cover an outline that still touches the square's border.
      std::vector<dvec3> outline = square_in(plane.inside, eye, 4 * reach);
      for (const Plane& other : planes)
        if (&other != &plane && !outline.empty()) outline = clip(outline, other.inside);
      const bool redundant = outline.empty() || area_of(outline) <= tolerance * tolerance;
      if (redundant) {
        kept.push_back(plane);  // what makes it so may be dropped yet
      } else if (std::optional<RoomFace> side = cover(plane, outline, tolerance)) {
        room.push_back(std::move(*side));
        kept.push_back(plane);
      }
    }
    if (kept.size() == planes.size()) return room;
    planes = std::move(kept);
  }
  return {};
}

}  // namespace glimt
