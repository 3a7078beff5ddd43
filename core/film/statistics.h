#pragma once

#include <limits>

#include "film/film.h"

namespace glimt {

/// Error of image x against reference r, over all pixels and channels. Per pixel e = mean over channels of
/// (x - r)^2 / (r^2 + 0.01).
struct Comparison {
  double mean = 0;            ///< of x
  double mean_reference = 0;  ///< of r
  double bias = 0;            ///< mean - mean_reference
  double rmse = 0;            ///< sqrt(mean (x - r)^2)
  double relmse = 0;          ///< mean e
  double relmse999 = 0;       ///< mean e of the pixels without the largest 0.1 % (rounded up)
};

/// Throws std::invalid_argument where the sizes differ or a value is not finite, naming the first such pixel.
Comparison compare(const Image& x, const Image& reference);

/// Mean over pixels and channels.
double mean(const Image& image);

/// relmse of the film's mean, estimated without a reference: mean of (h0 - h1)^2 / 4 / (m^2 + 0.01), h0 and h1 the
/// halves' pictures and m the mean over the aligned 8x8 block around the pixel (the quarter is n0 n1 / (n0 + n1)^2,
/// which differs from it for odd counts). Infinite below two samples.
double relmse_estimate(const Film& film);

}  // namespace glimt
