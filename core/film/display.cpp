#include "film/display.h"

#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
#include <cmath>

#include "scene/file/text.h"

namespace glimt {
namespace {

/// Inverse of the sRGB transfer curve (IEC 61966-2-1): encoded value in 0..1 to linear.
double srgb_to_linear(double encoded) {
  return encoded <= 0.04045 ? encoded / 12.92 : std::pow((encoded + 0.055) / 1.055, 2.4);
}

double linear_to_srgb(double linear) {
  return linear <= 0.0031308 ? 12.92 * linear : 1.055 * std::pow(linear, 1 / 2.4) - 0.055;
}

/// What dithering adds before rounding down: 0..1, evenly distributed, from Roberts' lattice R2 ("The unreasonable
/// effectiveness of quasirandom sequences", 2018), where neighbours differ much. Its sum with 255 is exact in a float.
float dither_offset(std::uint32_t x, std::uint32_t y) {
  const std::uint32_t turn = x * 3242174889u + y * 2447445414u;  // in units of 2^-32
  return (static_cast<float>(turn >> 17) + 0.5f) * 0x1p-15f;
}

/// Evaluates and rounds the sRGB curve without a power or a branch per value. It cuts each octave of linear values into
/// 128 bins.
class SrgbTable {
 public:
  SrgbTable() {
    const auto edge_of = [](std::uint32_t bin) { return std::bit_cast<float>((bin << shift) + lowest_bits); };
    for (std::uint32_t bin = 0; bin < level_.size(); ++bin) {
      const double at = 255 * linear_to_srgb(edge_of(bin));
      level_[bin] = static_cast<float>(at);
      rise_[bin] = static_cast<float>((255 * linear_to_srgb(edge_of(bin + 1)) - at) / bin_size);
    }
    std::uint32_t code = 0;
    std::uint32_t step = first_of(1);
    for (std::uint32_t bin = 0; bin < bins_.size(); ++bin) {
      const std::uint32_t edge = (bin << shift) + lowest_bits;
      for (; step <= edge; step = first_of(code + 1)) ++code;
      const std::uint32_t below = step - edge;  // number of the bin's floats that are below the step
      bins_[bin] = (code << shift) + (below < bin_size ? bin_size - below : 0);
    }
  }

  /// Rounds to the nearest code, exactly. Bins are so fine that the code steps up at most once in a bin.
  std::uint8_t nearest(float linear) const {
    float inside = linear > lowest ? linear : lowest;  // also for NaN
    inside = inside < highest ? inside : highest;
    const auto bits = std::bit_cast<std::uint32_t>(inside) - lowest_bits;
    return static_cast<std::uint8_t>((bins_[bits >> shift] + bits % bin_size) >> shift);
  }

  /// Adds the offset (0..1) and rounds down. A bin's chord is less than 5e-4 of a step below the curve.
  std::uint8_t dithered(float linear, float offset) const {
    float inside = linear > 0 ? linear : 0;  // also for NaN
    inside = inside < 1 ? inside : 1;
    const auto bits = std::bit_cast<std::uint32_t>(inside > lowest ? inside : lowest) - lowest_bits;
    const float on_chord = level_[bits >> shift] + rise_[bits >> shift] * static_cast<float>(bits % bin_size);
    const float level = inside < lowest ? inside * (255 * 12.92f) : on_chord;
    return static_cast<std::uint8_t>(static_cast<std::uint32_t>(level + offset));
  }

 private:
  static constexpr float lowest = 0x1p-13f;  // less than the first step, 0.5 / 255 / 12.92
  static constexpr float highest = 1 - 0x1p-24f;
  static constexpr std::uint32_t lowest_bits = std::bit_cast<std::uint32_t>(lowest);
  static constexpr int shift = 16;
  static constexpr std::uint32_t bin_size = 1u << shift;

  /// Bits of the smallest linear value with this code. For 256, more than the bits of any value.
  static std::uint32_t first_of(std::uint32_t code) {
    if (code > 255) return std::bit_cast<std::uint32_t>(2.0f);
    const double step = srgb_to_linear((code - 0.5) / 255);
    const auto first = static_cast<float>(step);
    return std::bit_cast<std::uint32_t>(first < step ? std::nextafter(first, 2.0f) : first);
  }

  /// Upper half: the code at the lower edge of each bin. Lower half: a number that carries into the code from the bin's
  /// step on.
  std::array<std::uint32_t, std::size_t{13} * 128> bins_{};
  /// The curve at the lower edge of each bin and at 1, in codes, and its rise from one float to the next.
  std::array<float, std::size_t{13} * 128 + 1> level_{}, rise_{};
};

constexpr std::array<std::string_view, 2> tone_names{"linear", "filmic"};
constexpr std::array<std::string_view, 3> view_names{"image", "error", "samples"};
constexpr std::array<std::string_view, 2> dither_names{"on", "off"};

const std::array<Field<Display>, 4> display_table{{
    {"exposure", "brightness of the picture: 1 EV more is twice as bright", value<&Display::exposure>(), -32, 32},
    {"tone", "how bright values are brought into range: linear and clipped, or with a film's soft shoulder",
     choice<&Display::tone>(tone_names)},
    {"view", "what is shown: the image, its standard error, or the number of samples per pixel",
     choice<&Display::view>(view_names)},
    {"dither", "hides the bands of 8-bit colours in a fine pattern of neighbouring shades",
     choice<&Display::dither>(dither_names)},
}};

float filmic(float x) {
  // At 1e3 the curve is above 1 already, and products do not overflow. NaN stays NaN.
  const float v = std::min(std::max(x, 0.0f), 1e3f);
  return v * (2.51f * v + 0.03f) / (v * (2.43f * v + 0.59f) + 0.14f);
}

/// From dark to bright in steps that look equal (CIE L*a*b*), also in grey. 8-bit sRGB.
constexpr std::array<std::array<float, 3>, 5> scale_stops{
    {{25, 19, 36}, {74, 40, 139}, {192, 71, 116}, {249, 149, 79}, {241, 236, 196}}};

std::vector<std::uint8_t> on_colour_scale(const Image& image, const ColourScale& scale, float factor) {
  const auto low = static_cast<float>(std::log2(scale.low));
  const auto octaves = static_cast<float>(std::log2(scale.high / scale.low));
  const auto pixels = static_cast<std::ptrdiff_t>(image.rgb.size() / 3);
  std::vector<std::uint8_t> bytes(image.rgb.size());
#pragma omp parallel for if (pixels > (1 << 18))
  for (std::ptrdiff_t i = 0; i < pixels; ++i) {
    const float* rgb = image.rgb.data() + 3 * i;
    const float value = factor * (rgb[0] + rgb[1] + rgb[2]) / 3;
    const auto colour = scale_colour((std::log2(value) - low) / octaves);
    std::copy(colour.begin(), colour.end(), bytes.data() + 3 * i);
  }
  return bytes;
}

}  // namespace

std::span<const Field<Display>> display_fields() { return display_table; }

std::map<std::string, std::string> display_texts(const Display& display) {
  std::map<std::string, std::string> texts;
  for (const auto& field : display_table) {
    const auto* choice = std::get_if<Choice<Display>>(&field.member);
    texts[std::string(field.key)] = choice ? std::string(choice->names[static_cast<std::size_t>(choice->get(display))])
                                           : number_text(std::get<Value<Display, double>>(field.member).get(display));
  }
  return texts;
}

Display read_display(const std::map<std::string, std::string>& texts) {
  Display display;
  for (const auto& field : display_table) {
    const auto found = texts.find(std::string(field.key));
    if (found == texts.end()) continue;
    const std::string& text = found->second;
    if (const auto* choice = std::get_if<Choice<Display>>(&field.member)) {
      const auto name = std::ranges::find(choice->names, text);
      if (name != choice->names.end()) choice->set(display, static_cast<int>(name - choice->names.begin()));
    } else {
      double value = 0;
      const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
      if (error == std::errc{} && value >= field.min && value <= field.max)
        std::get<Value<Display, double>>(field.member).set(display, value);
    }
  }
  return display;
}

ColourScale colour_scale(View view) { return view == View::samples ? ColourScale{1, 1 << 16} : ColourScale{0.001, 10}; }

std::array<std::uint8_t, 3> scale_colour(float share) {
  const float at = share > 0 ? std::min(share, 1.0f) * (scale_stops.size() - 1) : 0;
  const auto stop = std::min(static_cast<std::size_t>(at), scale_stops.size() - 2);
  const float rest = at - static_cast<float>(stop);
  std::array<std::uint8_t, 3> colour{};
  for (std::size_t c = 0; c < 3; ++c)
    colour[c] = static_cast<std::uint8_t>(
        std::lround(scale_stops[stop][c] + rest * (scale_stops[stop + 1][c] - scale_stops[stop][c])));
  return colour;
}

std::vector<std::uint8_t> to_srgb8(const Image& image, const Display& display) {
  static const SrgbTable table;
  const float factor = std::exp2(static_cast<float>(display.exposure));
  if (display.view != View::image)
    return on_colour_scale(image, colour_scale(display.view), display.view == View::error ? factor : 1);
  const bool soft = display.tone == Tone::filmic;
  const bool dither = display.dither == Dither::on;
  std::vector<std::uint8_t> bytes(image.rgb.size());
#pragma omp parallel for if (bytes.size() > (1 << 21))
  for (int y = 0; y < image.height; ++y) {
    const std::ptrdiff_t row = std::ptrdiff_t{3} * image.width * y;
    const float* from = image.rgb.data() + row;
    std::uint8_t* to = bytes.data() + row;
    if (dither) {
#pragma omp simd
      for (int x = 0; x < image.width; ++x) {
        const float offset = dither_offset(static_cast<std::uint32_t>(x), static_cast<std::uint32_t>(y));
        for (int k = 3 * x; k < 3 * x + 3; ++k) {
          const float value = from[k] * factor;
          to[k] = table.dithered(soft ? filmic(value) : value, offset);
        }
      }
    } else {
#pragma omp simd
      for (int k = 0; k < 3 * image.width; ++k) {
        const float value = from[k] * factor;
        to[k] = table.nearest(soft ? filmic(value) : value);
      }
    }
  }
  return bytes;
}

}  // namespace glimt
