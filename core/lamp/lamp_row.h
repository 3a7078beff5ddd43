#pragma once

#include <glm/vec3.hpp>
#include <vector>

#include "lamp/shapes.h"
#include "math/table.h"
#include "math/vec.h"

/// What the shapes of lamps have in common. Each shape is a struct in its own file. It holds the lamp in doubles, and
/// has
///  - area(), body() and lower() for compile; lower() fills the shape's own columns;
///  - point(): a point of the lamp, uniform by area;
///  - by_area: whether light sampling chooses such points;
///  - if not, sample() and inverse_pdf(): how light sampling chooses a point as seen from another.
/// list.h names all shapes.
namespace glimt {

/// Place of a shape's own column in the lamp table.
template <class OwnColumn>
constexpr LampColumn lamp_column(OwnColumn column) {
  static_assert(static_cast<int>(LampColumn::own) + static_cast<int>(OwnColumn::count) <=
                static_cast<int>(LampColumn::count));
  return static_cast<LampColumn>(static_cast<int>(LampColumn::own) + static_cast<int>(column));
}
template <>
constexpr LampColumn lamp_column(LampColumn column) {
  return column;
}

/// The row of the lamp table that each lane reads. `one`: the table has a single row, so nothing is looked up.
template <class F, bool one>
struct LampRow {
  const Table<LampColumn>& table;
  Int<F> row;

  template <class C>
  F operator[](C column) const {
    const float* values = table[lamp_column(column)];
    if constexpr (one) {
      return F(values[0]);
    } else {
      return lookup(values, row);
    }
  }
  /// The vector in this column and the two after it.
  template <class C>
  Vec3<F> vector(C first) const {
    const int c = static_cast<int>(first);
    return {(*this)[first], (*this)[static_cast<C>(c + 1)], (*this)[static_cast<C>(c + 2)]};
  }
};

/// Where compile writes a lamp.
struct LampRowWriter {
  TableRow<LampColumn> row;

  template <class C>
  void set(C column, double value) const {
    row.set(lamp_column(column), value);
  }
  template <class C>
  void set3(C first, const glm::dvec3& v) const {
    row.set3(lamp_column(first), v);
  }
};

/// Where a lamp is, in compiled space.
struct LampBody {
  std::vector<glm::dvec3> outline;  ///< corners of a flat lamp; the centre of a round one
  double radius = 0;                ///< radius of a round lamp, else 0
  glm::dvec3 normal{0};             ///< unit normal of a flat lamp's front

  bool round() const { return radius > 0; }
  glm::dvec3 middle() const {
    glm::dvec3 sum{0};
    for (const glm::dvec3& v : outline) sum += v;
    return sum / static_cast<double>(outline.size());
  }
};

template <class F>
struct LampPoint {
  Vec3<F> point, normal;  ///< normal: unit, on the side that shines
};

/// A point of a lamp as another point sees it.
template <class F>
struct SeenLamp {
  Vec3<F> direction;  ///< unit, to the lamp
  F distance;         ///< metres
  F inverse_pdf;      ///< 1 / (pdf_w inverse_choice); 0 where the lamp shows its back
};

/// How `from` sees a point that was chosen uniform by area (the report's eq. 15): pdf_w = distance^2 / (area cos).
template <class F>
SeenLamp<F> see_point(const Vec3<F>& from, const LampPoint<F>& at) {
  const Vec3<F> way = at.point - from;
  const F distance2 = dot(way, way);
  const F inverse = inverse_sqrt(distance2);
  const Vec3<F> direction = way * inverse;
  const F minus_cos_lamp = dot(direction, at.normal);
  const F inverse_pdf = max(F(0.0f) - minus_cos_lamp, F(0.0f)) * (inverse * inverse);
  return {direction, distance2 * inverse, inverse_pdf};
}

}  // namespace glimt
