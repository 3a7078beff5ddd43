#include "film/display.h"

#include <array>
#include <bit>
#include <cmath>

namespace glimt {
namespace {

/// Inverse of the sRGB transfer curve (IEC 61966-2-1): encoded value in 0..1 to linear.
double srgb_to_linear(double encoded) {
  return encoded <= 0.04045 ? encoded / 12.92 : std::pow((encoded + 0.055) / 1.055, 2.4);
}

/// Rounds the sRGB curve exactly, without a power per value: an octave of linear values is cut into 128 bins, so finely
/// that a bin holds at most one of the values where the rounded code steps up.
class SrgbTable {
 public:
  SrgbTable() {
    for (std::size_t code = 1; code < 256; ++code) {
      const double step = srgb_to_linear((static_cast<double>(code) - 0.5) / 255);
      float first = static_cast<float>(step);
      if (first < step) first = std::nextafter(first, 2.0f);
      first_[code] = first;
    }
    first_[256] = 2.0f;
    std::uint8_t code = 0;
    for (std::uint32_t bin = 0; bin < bins_.size(); ++bin) {
      const float lower_edge = std::bit_cast<float>((bin << shift) + lowest_bits);
      while (first_[code + 1u] <= lower_edge) ++code;
      bins_[bin] = code;
    }
  }

  std::uint8_t operator()(float linear) const {
    if (!(linear > lowest)) return 0;
    if (linear >= 1.0f) return 255;
    const std::uint8_t code = bins_[(std::bit_cast<std::uint32_t>(linear) - lowest_bits) >> shift];
    return static_cast<std::uint8_t>(code + (linear >= first_[code + 1u]));
  }

 private:
  static constexpr float lowest = 0x1p-13f;  // below the first step, 0.5 / 255 / 12.92
  static constexpr std::uint32_t lowest_bits = std::bit_cast<std::uint32_t>(lowest);
  static constexpr int shift = 16;
  std::array<float, 257> first_{};                          ///< smallest linear value of each code
  std::array<std::uint8_t, std::size_t{13} * 128> bins_{};  ///< code at the lower edge of each bin
};

}  // namespace

std::vector<std::uint8_t> to_srgb8(const Image& image, const Display& display) {
  static const SrgbTable table;
  const float factor = std::exp2(static_cast<float>(display.exposure));
  const auto values = static_cast<std::ptrdiff_t>(image.rgb.size());
  std::vector<std::uint8_t> bytes(image.rgb.size());
#pragma omp parallel for if (values > (1 << 21))
  for (std::ptrdiff_t i = 0; i < values; ++i) {
    const auto k = static_cast<std::size_t>(i);
    bytes[k] = table(image.rgb[k] * factor);
  }
  return bytes;
}

}  // namespace glimt
