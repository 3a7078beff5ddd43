#pragma once

#include <optional>

#include "math/box.h"
#include "scene/geometry/room.h"
#include "scene/scene.h"

namespace glimt {

/// What the tolerance of something is a part of, metres: the scene's size, but less for what is near to the scene's
/// centre, where positions are kept to more digits. A wide ground then does not blur what stands on it.
double local_size(const Box& scene, double from_centre);

/// What of a scene the paths from its camera can reach.
struct Reach {
  double tolerance = 0;  ///< metres; surfaces nearer to each other than this coincide
  /// A point where paths are: the eye. With a cutaway a point of the room, or nothing where there is none.
  std::optional<glm::dvec3> inside;
  std::vector<RoomFace> room;   ///< the closed convex room around `inside`, or empty
  bool camera_outside = false;  ///< there is a closed room, and the eye is not in it
  std::vector<const Sphere*> spheres;
  std::vector<const Polygon*> polygons;
  std::vector<Mesh> meshes;                     ///< without the triangles that are part of the room
  bool lamp_pierces_room = false;               ///< some kept lamp is partly outside, where the room must hide it
  std::vector<std::string> left_out, warnings;  ///< for people
};

/// Finds the room and drops what is behind its faces, or coincides with them (the room wins).
Reach find_reach(const Scene& scene);

/// What of the scene's objects is in reach, anew: for objects that were moved or left out since the room was found.
void gather_objects(const Scene& scene, Reach& reach);

/// Meshes with this many triangles or fewer may be part of the room.
inline constexpr std::size_t max_room_mesh_triangles = 64;

/// Index into scene.materials; the scene is valid.
int material_index(const Scene& scene, const std::string& name);

}  // namespace glimt
