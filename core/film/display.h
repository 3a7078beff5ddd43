#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "film/film.h"
#include "scene/fields.h"

namespace glimt {

/// How radiance, 0 to infinity, is mapped to 0..1.
enum class Tone {
  linear,  ///< clipped at 1
  filmic,  ///< (2.51 x^2 + 0.03 x) / (2.43 x^2 + 0.59 x + 0.14): Narkowicz, "ACES filmic tone mapping curve", 2015
};

/// What the picture shows.
enum class View {
  image,    ///< radiance
  error,    ///< standard error of the radiance, on a colour scale
  samples,  ///< number of samples per pixel, on a colour scale
};

/// Whether values between two 8-bit codes become a pattern of both, so that smooth shades show no bands.
enum class Dither { on, off };

/// How the rendered image is displayed. It never changes what is rendered.
struct Display {
  double exposure = 0;  ///< EV: radiance and error are multiplied by 2^exposure
  Tone tone = Tone::linear;
  View view = View::image;
  Dither dither = Dither::on;

  bool operator==(const Display&) const = default;
};

std::span<const Field<Display>> display_fields();

/// The display's fields by key, as the metadata of images holds them, and back. A field that is missing or invalid gets
/// its default.
std::map<std::string, std::string> display_texts(const Display& display);
Display read_display(const std::map<std::string, std::string>& texts);

/// 8-bit sRGB (IEC 61966-2-1), three bytes per pixel, row by row from the top. NaN becomes black. The image holds what
/// display.view names: radiance, standard errors, or numbers of samples. Radiance is rounded to the nearest code.
/// Dithering first adds or subtracts up to half a step. That amount depends only on the pixel's place and is the same
/// for its three channels, so grey stays grey.
std::vector<std::uint8_t> to_srgb8(const Image& image, const Display& display);

/// The logarithmic colour scale of a view other than the image: the values at its ends, and its colour, 8-bit sRGB, at
/// a share 0..1 of the way between them.
struct ColourScale {
  double low = 0, high = 0;
};
ColourScale colour_scale(View view);
std::array<std::uint8_t, 3> scale_colour(float share);

}  // namespace glimt
