#pragma once

#include <vector>

#include "film/film.h"

/// Where two pictures differ by more than their noise, without knowing how noisy either is.
namespace glimt {

/// A block of 8x8 pixels. Its noise is told by the spread of the difference within the block, in cells of 2x2 pixels:
/// pixels of one cell may share noise.
struct BlockDifference {
  double difference = 0;  ///< of the means, radiance, for the channel that differs most surely
  double z = 0;           ///< of it, in standard errors, as of a normal distribution
};

struct PictureDifference {
  int across = 0, down = 0;
  std::vector<BlockDifference> blocks;  ///< row by row
  double mean = 0, mean_reference = 0;  ///< of the pictures, over pixels and channels
  double mean_error = 0;                ///< standard error of their difference
  double mean_square_z = 0;             ///< over blocks and channels; 1 where all is noise
  int beyond = 0;                       ///< blocks that noise explains once in 1000 pairs of pictures at most

  /// The block of a pixel.
  const BlockDifference& block_at(int x, int y) const {
    const auto row = static_cast<std::size_t>(y / 8), column = static_cast<std::size_t>(x / 8);
    return blocks[row * static_cast<std::size_t>(across) + column];
  }
};

/// Throws std::invalid_argument where the sizes differ or a value is not finite.
PictureDifference difference_of(const Image& picture, const Image& reference);

}  // namespace glimt
