#pragma once

#include "kernel/entry/kernels.h"
#include "math/vec.h"

namespace glimt {

/// The squares of two by two pixels that cover a block, from even pixels on, so they may reach out of the block and a
/// pixel out of the image. The paths of all their upper left pixels have places first, then come those of the upper
/// right ones, lower left and lower right: what belongs together is `plane` places apart.
template <class F>
struct Squares {
  static constexpr int members = 4;

  PathBlock whole;    ///< all their pixels
  int columns, rows;  ///< of squares
  int plane;          ///< places of one member of all squares, in whole lanes

  explicit Squares(const PathBlock& block) : whole(block) {
    whole.x0 = block.x0 / 2 * 2;
    whole.y0 = block.y0 / 2 * 2;
    columns = (block.x0 + block.width + 1) / 2 - block.x0 / 2;
    rows = (block.y0 + block.height + 1) / 2 - block.y0 / 2;
    whole.width = 2 * columns;
    whole.height = 2 * rows;
    plane = (columns * rows * block.samples / lane_count<F> + 1) * lane_count<F>;
  }

  /// Of a path; `sample` counts from the block's first.
  template <class N>
  N place(N x, N y, N sample) const {
    const N column = x - N(whole.x0), row = y - N(whole.y0);
    const N square = (sample * N(rows) + (row >> 1)) * N(columns) + (column >> 1);
    return ((row & N(1)) * N(2) + (column & N(1))) * N(plane) + square;
  }
};

}  // namespace glimt
