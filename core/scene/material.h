#pragma once

#include <glm/vec3.hpp>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <variant>

namespace glimt {

/// The value of a parameter; an int is the place of a choice among its names.
using ParameterValue = std::variant<double, glm::dvec3, int>;

/// What there is to know of a parameter: a number, three of them (one per channel), or a choice (an enum). The
/// materials that read it declare it, once, as a constant (core/material/).
template <class T>
struct Parameter {
  std::string_view key;  ///< as in files: "roughness"
  std::string_view doc;  ///< one line, with the unit
  T fallback{};          ///< where none is given
  double min = 0;        ///< of numbers, and of each component of three
  double max = 0;
  bool min_excluded = false;
  bool required = false;                         ///< in files
  std::span<const std::string_view> names = {};  ///< of a choice, in the enum's order
  /// What its value is kept under. Materials that read parameters kept under one name share the value.
  std::string_view stored = key;
};

/// A material type and values of parameters. Values that its type does not read stay, so that switching the type back
/// and forth loses nothing. A value equal to the parameter's own is not kept, so that equal materials compare equal.
struct Material {
  std::string name;
  std::string type = "lambertian";  ///< a name in material_infos() (scene/fields.h)
  std::map<std::string, ParameterValue, std::less<>> values = {};

  template <class T>
  T get(const Parameter<T>& parameter) const {
    const auto kept = values.find(parameter.stored);
    return kept == values.end() ? parameter.fallback : static_cast<T>(std::get<Kept<T>>(kept->second));
  }
  template <class T>
  void set(const Parameter<T>& parameter, const std::type_identity_t<T>& value) {
    if (value == parameter.fallback)
      values.erase(std::string(parameter.stored));
    else
      values.insert_or_assign(std::string(parameter.stored), static_cast<Kept<T>>(value));
  }
  /// The same material with that value.
  template <class T>
  Material with(const Parameter<T>& parameter, const std::type_identity_t<T>& value) const {
    Material changed = *this;
    changed.set(parameter, value);
    return changed;
  }

  bool operator==(const Material&) const = default;

 private:
  template <class T>
  using Kept = std::conditional_t<std::is_enum_v<T>, int, T>;
};

}  // namespace glimt
