#pragma once

#include "lamp/flat.h"

namespace glimt {

/// A parallelogram sampled by area.
struct ParallelogramLamp : FlatLamp {
  static constexpr bool by_area = true;

  double area() const { return parallelogram_area(); }
  LampBody body() const { return {{corner, corner + edge_1, corner + edge_1 + edge_2, corner + edge_2}, 0, normal}; }

  template <class F, bool one>
  static LampPoint<F> point(const LampRow<F, one>& lamp, F u, F v) {
    return at(lamp, u, v);
  }
};

}  // namespace glimt
