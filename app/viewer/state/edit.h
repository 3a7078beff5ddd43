#pragma once

#include <glm/vec3.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "scene/pick.h"
#include "scene/scene.h"

/// Edits of a scene that take more than an assignment.
namespace glimt {

/// Gives the object this material without changing other objects. Where others share its old material, the object gets
/// a new one, named after it. The name in `material` is not used.
void set_material(Scene& scene, const ObjectId& object, Material material);

/// The object's own name, or its kind and number.
std::string display_name(const Scene& scene, const ObjectId& object);

/// Why the object cannot have a material of this type in this scene; empty where it can.
std::string obstacle_to(const Scene& scene, const ObjectId& object, std::string_view type);

/// The objects that are lamps.
std::vector<ObjectId> lamps_of(const Scene& scene);

/// The largest extent along an axis, metres; of a sphere the diameter.
double size_of(const Scene& scene, const ObjectId& object);
/// Scales the object about its middle.
void scale(Scene& scene, const ObjectId& object, double factor);

}  // namespace glimt
