#pragma once

#include <span>
#include <string_view>
#include <variant>

#include "scene/scene.h"

/// The one list of every setting, material and parameter: scene files, command line, window and documentation read it.
namespace glimt {

/// Coordinates are allowed from minus this to this, metres.
inline constexpr double max_coordinate = 1e9;

/// Names for the values of an enum member, in the enum's order.
template <class T>
struct Choice {
  std::span<const std::string_view> names;
  int (*get)(const T&);
  void (*set)(T&, int);
};

template <class T>
struct Field {
  std::string_view key;  ///< as in files: "roughness"
  std::string_view doc;  ///< one line, with the unit
  std::variant<int T::*, double T::*, glm::dvec3 T::*, Choice<T>> member;
  double min = 0;  ///< of numbers, and of each component of a vector
  double max = 0;
  bool min_excluded = false;
  bool required = false;  ///< in files; otherwise the struct's default holds
};

/// A material type as files name it, with the parameters it reads.
struct MaterialInfo {
  MaterialType type;
  std::string_view name;  ///< "oren-nayar"
  std::string_view doc;
  std::vector<Field<Material>> fields;
};

std::span<const Field<Settings>> settings_fields();
std::span<const MaterialInfo> material_infos();
const MaterialInfo& material_info(MaterialType type);
std::span<const Field<Camera>> camera_fields();
std::span<const Field<ImageSize>> image_fields();
std::span<const Field<Sphere>> sphere_fields();

}  // namespace glimt
