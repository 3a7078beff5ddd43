#pragma once

#include <cstdint>
#include <type_traits>
#include <utility>
#include <variant>

/// The list of all shapes of lamps by name, and the columns of the lamp table. list.h includes the shapes themselves.
namespace glimt {

/// Columns of the lamp table.
enum class LampColumn {
  shape,  ///< the shape's place in the list, as int32
  first_surface,
  last_surface,  ///< first and last of the lamp's own surfaces, which cannot hide a point of it, as int32
  weight_r,
  weight_g,
  weight_b,         ///< radiance * inverse_choice
  inverse_choice,   ///< area / probability of choosing the lamp; 1 / probability where points are not chosen by area
  area_factor,      ///< 1 / (pdf_a inverse_choice) of points uniform by area: 1, or the area in m^2
  alias_threshold,  ///< see math/alias.h
  alias_other,      ///< as int32
  own,              ///< the first of the shape's own columns
  count = own + 16
};

struct ParallelogramLamp;
struct TriangleLamp;
struct RectangleLamp;
struct TriangleBySolidAngleLamp;
struct SphereLamp;
struct SphereByAreaLamp;

/// The one list of all shapes of lamps.
using LampShape = std::variant<ParallelogramLamp, TriangleLamp, RectangleLamp, TriangleBySolidAngleLamp, SphereLamp,
                               SphereByAreaLamp>;
inline constexpr std::size_t lamp_shapes = std::variant_size_v<LampShape>;

/// Calls f.operator()<Shape>() for every shape of the list.
template <class Function>
constexpr void for_each_lamp_shape(Function f) {
  [&]<std::size_t... i>(std::index_sequence<i...>) {
    (f.template operator()<std::variant_alternative_t<i, LampShape>>(), ...);
  }
  (std::make_index_sequence<lamp_shapes>{});
}

/// The shape's place in the list, as in LampColumn::shape.
template <class Shape>
inline constexpr std::int32_t lamp_shape_number = [] {
  std::int32_t number = 0, found = -1;
  for_each_lamp_shape([&]<class Other>() {
    if (std::is_same_v<Shape, Other>) found = number;
    ++number;
  });
  return found;
}();

}  // namespace glimt
