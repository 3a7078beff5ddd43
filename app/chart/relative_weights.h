#pragma once

#include "film/film.h"

namespace glimt {

/// What relmse_estimate multiplies squares of errors with: 1 / (m^2 + 0.01) for every pixel and channel, m the
/// picture's mean over the aligned 8x8 block around the pixel.
Image relative_weights(Image picture);

}  // namespace glimt
