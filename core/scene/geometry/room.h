#pragma once

#include <glm/vec3.hpp>
#include <vector>

namespace glimt {

/// A flat convex piece of a scene's surface; the room is looked for among these.
struct Face {
  std::vector<glm::dvec3> vertices;  ///< counter-clockwise from the front
  int material = 0;                  ///< faces of one plane can stand in for each other where this is equal
};

/// n.x <= d, n of unit length.
struct HalfSpace {
  glm::dvec3 n{0};
  double d = 0;
};

struct RoomFace {
  HalfSpace inside;                 ///< n points out of the room
  std::vector<glm::dvec3> outline;  ///< what of the plane bounds the room
  int material = 0;
  bool front = false;  ///< the faces' front looks into the room
};

/// The plane of a face, n to its front. Newell's method, so that no three vertices matter more than others.
HalfSpace plane_of(const std::vector<glm::dvec3>& vertices);

double area_of(const std::vector<glm::dvec3>& vertices);

double distance_to_segment(const glm::dvec3& p, const glm::dvec3& a, const glm::dvec3& b);
/// From a point to a convex polygon.
double distance_to_polygon(const glm::dvec3& p, const std::vector<glm::dvec3>& polygon);

/// What of a convex polygon lies in the half space; empty where nothing does.
std::vector<glm::dvec3> clip(const std::vector<glm::dvec3>& polygon, const HalfSpace& half_space);

/// The closed convex room around `eye`, if the faces make one: the smallest cell of half spaces around the eye whose
/// every side is covered by faces of one material. Empty if there is none. Begins with the planes of all faces and
/// drops those that do not cover their side of the cell until nothing changes; a wall of a room always covers its side,
/// so walls are never dropped. `tolerance` (metres): planes closer than this are one.
std::vector<RoomFace> find_room(const std::vector<Face>& faces, const glm::dvec3& eye, double tolerance);

}  // namespace glimt
