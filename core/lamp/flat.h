#pragma once

#include <glm/geometric.hpp>

#include "lamp/lamp_row.h"

namespace glimt {

enum class FlatColumn {
  corner_x,
  corner_y,
  corner_z,
  edge_1_x,
  edge_1_y,
  edge_1_z,
  edge_2_x,
  edge_2_y,
  edge_2_z,
  normal_x,
  normal_y,
  normal_z,
  count
};

/// What flat lamps have in common. Their points are corner + a edge_1 + b edge_2, in compiled space.
struct FlatLamp {
  glm::dvec3 corner, edge_1, edge_2;
  glm::dvec3 normal;  ///< unit, of the side that shines

  /// Area of the parallelogram of its edges, m^2.
  double parallelogram_area() const { return length(cross(edge_1, edge_2)); }

  void lower(const LampRowWriter& row) const {
    row.set3(FlatColumn::corner_x, corner);
    row.set3(FlatColumn::edge_1_x, edge_1);
    row.set3(FlatColumn::edge_2_x, edge_2);
    row.set3(FlatColumn::normal_x, normal);
  }

  template <class F, bool one>
  static LampPoint<F> at(const LampRow<F, one>& lamp, F a, F b) {
    return {fma(lamp.vector(FlatColumn::edge_1_x), a,
                fma(lamp.vector(FlatColumn::edge_2_x), b, lamp.vector(FlatColumn::corner_x))),
            lamp.vector(FlatColumn::normal_x)};
  }
};

/// Below this solid angle, in sr, a sum of angles has lost too many digits. Points are then chosen by area.
inline constexpr float small_solid_angle = 0.02f;

}  // namespace glimt
