#pragma once

#include <glm/vec3.hpp>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <variant>

#include "scene/fields.h"

/// The control for each kind of field in the field table: sliders for numbers, menus for choices, swatches for colours.
namespace glimt {

/// What a control needs to know about its field.
struct FieldText {
  std::string name;  ///< name of the control, unique in the window: "render.spp"
  std::string_view key, doc;
  double min = 0, max = 0;
  bool min_excluded = false;
};

/// Each draws a row and returns true if the value changed. The new value is always one that the field allows.
bool edit_value(const FieldText& field, int& value);
bool edit_value(const FieldText& field, double& value);
bool edit_value(const FieldText& field, glm::dvec3& value);
bool edit_choice(const FieldText& field, std::span<const std::string_view> names, int& value);

/// Draws the row of one field of `object`, whose path in the scene is `path` ("render", "sphere.glass.material").
template <class T>
bool edit_field(const Field<T>& field, T& object, const std::string& path) {
  const FieldText text{
      path + "." + std::string(field.key), field.key, field.doc, field.min, field.max, field.min_excluded};
  return std::visit(
      [&](const auto& member) {
        using Member = std::remove_cvref_t<decltype(member)>;
        if constexpr (std::is_same_v<Member, Choice<T>>) {
          int value = member.get(object);
          const bool changed = edit_choice(text, member.names, value);
          if (changed) member.set(object, value);
          return changed;
        } else {
          auto value = member.get(object);
          const bool changed = edit_value(text, value);
          if (changed) member.set(object, value);
          return changed;
        }
      },
      field.member);
}

}  // namespace glimt
