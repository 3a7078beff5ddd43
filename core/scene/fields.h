#pragma once

#include <span>
#include <string_view>
#include <type_traits>
#include <variant>
#include <vector>

#include "scene/scene.h"

/// The one list of every setting, material and parameter: scene files, command line, window and documentation read it.
namespace glimt {

/// Coordinates are allowed from minus this to this, metres.
inline constexpr double max_coordinate = 1e9;

/// How a value of an object is read and written.
template <class T, class V>
struct Value {
  V (*get)(const T&);
  void (*set)(T&, V);
};

/// A value that is one of a few, by its place among their names.
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
  std::variant<Value<T, int>, Value<T, double>, Value<T, glm::dvec3>, Choice<T>> member;
  double min = 0;  ///< of numbers, and of each component of a vector
  double max = 0;
  bool min_excluded = false;
  bool required = false;  ///< in files; otherwise the struct's default holds
};

template <class T>
struct MemberOf;
template <class T, class V>
struct MemberOf<V T::*> {
  using Object = T;
  using Type = V;
};

/// A member of a struct as a field's value: value<&Settings::spp>().
template <auto member>
constexpr auto value() {
  using T = typename MemberOf<decltype(member)>::Object;
  using V = typename MemberOf<decltype(member)>::Type;
  return Value<T, V>{[](const T& object) { return object.*member; }, [](T& object, V v) { object.*member = v; }};
}

/// The same for an enum, whose values have these names.
template <auto member>
constexpr auto choice(std::span<const std::string_view> names) {
  using T = typename MemberOf<decltype(member)>::Object;
  using Enum = typename MemberOf<decltype(member)>::Type;
  return Choice<T>{names, [](const T& object) { return static_cast<int>(object.*member); },
                   [](T& object, int v) { object.*member = static_cast<Enum>(v); }};
}

/// A parameter of a material as a field.
template <const auto& parameter>
Field<Material> field() {
  using V = std::remove_cvref_t<decltype(parameter.fallback)>;
  Field<Material> result{parameter.key,          parameter.doc,     {}, parameter.min, parameter.max,
                         parameter.min_excluded, parameter.required};
  if constexpr (std::is_enum_v<V>)
    result.member =
        Choice<Material>{parameter.names, [](const Material& m) { return static_cast<int>(m.get(parameter)); },
                         [](Material& m, int v) { m.set(parameter, static_cast<V>(v)); }};
  else
    result.member = Value<Material, V>{[](const Material& m) { return m.get(parameter); },
                                       [](Material& m, V v) { m.set(parameter, v); }};
  return result;
}

/// How a material scatters light.
enum class LobeClass {
  cosine,  ///< matt: in all directions, with pdf_w = cos / pi
  delta,   ///< in one direction, or one of two
  glossy,  ///< about one direction, with a density of its own
  none,    ///< not at all
};

/// A material type: what its file in core/material/ says of it.
struct MaterialInfo {
  std::string_view name;  ///< as in files: "oren-nayar"
  std::string_view doc;
  std::vector<Field<Material>> fields;  ///< the parameters that it reads
  LobeClass lobe_class;
  bool transmits;                               ///< light goes through it, so its shapes are closed
  bool emits;                                   ///< it is a lamp
  glm::dvec3 (*albedo)(const Material&);        ///< share of the light that it scatters, per channel
  glm::dvec3 (*radiance)(const Material&);      ///< that it emits by itself, W/(m^2 sr)
  double (*refractive_index)(const Material&);  ///< absolute; 1 where nothing is refracted
};

std::span<const Field<Settings>> settings_fields();
std::span<const Field<Camera>> camera_fields();
std::span<const Field<ImageSize>> image_fields();
std::span<const Field<Sphere>> sphere_fields();
std::span<const Field<Placement>> placement_fields();

/// All material types (core/material/list.cpp).
std::span<const MaterialInfo> material_infos();
/// Null where no type has that name.
const MaterialInfo* find_material_info(std::string_view type);
/// Of a type that there is.
const MaterialInfo& material_info(std::string_view type);

inline bool is_diffuse(const Material& m) { return material_info(m.type).lobe_class == LobeClass::cosine; }
inline bool is_lamp(const Material& m) { return material_info(m.type).emits; }
/// Light goes through it: glass.
inline bool transmits(const Material& m) { return material_info(m.type).transmits; }
/// A mirror or glass, and not black.
inline bool is_specular(const Material& m) {
  const MaterialInfo& info = material_info(m.type);
  return (info.lobe_class == LobeClass::delta || info.lobe_class == LobeClass::glossy) &&
         info.albedo(m) != glm::dvec3{0};
}

}  // namespace glimt
