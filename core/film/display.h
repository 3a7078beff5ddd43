#pragma once

#include <cstdint>
#include <vector>

#include "film/film.h"

namespace glimt {

/// How radiance becomes a picture. Never part of what is rendered.
struct Display {
  double exposure = 0;  ///< EV: radiance is multiplied by 2^exposure

  bool operator==(const Display&) const = default;
};

/// 8-bit sRGB (IEC 61966-2-1), three bytes a pixel, row by row from the top, exactly rounded to nearest; clipped at 1,
/// and values that are no numbers are black.
std::vector<std::uint8_t> to_srgb8(const Image& image, const Display& display);

}  // namespace glimt
