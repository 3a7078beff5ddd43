#pragma once

#include <vector>

#include "film/film.h"

namespace glimt {

/// What the estimate of relmse_scaled multiplies squares of errors with, for every pixel and channel: 1 / (m^2 +
/// scaled_dark(mean of the picture)), m the mean over the aligned 8x8 block around the pixel. 0 for a black picture.
std::vector<double> relative_weights(const Image& picture);

}  // namespace glimt
