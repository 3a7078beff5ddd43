#pragma once

#include <cstddef>
#include <glm/vec3.hpp>
#include <optional>
#include <string>
#include <vector>

#include "scene/scene.h"

namespace glimt {

enum class ObjectKind { sphere, polygon, mesh };

/// One of a scene's spheres, polygons or meshes.
struct ObjectId {
  ObjectKind kind = ObjectKind::sphere;
  std::size_t index = 0;

  bool operator==(const ObjectId&) const = default;
};

/// Spheres, then meshes, then polygons.
std::vector<ObjectId> objects_of(const Scene& scene);
bool contains(const Scene& scene, const ObjectId& object);

/// The object's name and its material's name. The object is one of the scene.
const std::string& name_of(const Scene& scene, const ObjectId& object);
const std::string& material_name_of(const Scene& scene, const ObjectId& object);
std::string& material_name_of(Scene& scene, const ObjectId& object);

/// The direction may have any length.
struct WorldRay {
  glm::dvec3 origin, direction;
};

struct Pick {
  ObjectId object;
  double distance = 0;  ///< in lengths of the ray's direction
};

/// The first object that the ray hits from either side, in double precision; of those equally far away, the first in
/// the order of objects_of(). `left_out` is looked through.
std::optional<Pick> pick(const Scene& scene, const WorldRay& ray, const std::optional<ObjectId>& left_out = {});

/// What the scene's camera sees along a ray: the same, but with a cutaway it looks through backs that are not glass.
std::optional<Pick> pick_seen(const Scene& scene, const WorldRay& ray, const std::optional<ObjectId>& left_out = {});

}  // namespace glimt
