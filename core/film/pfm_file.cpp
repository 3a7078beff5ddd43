#include <algorithm>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <stdexcept>

#include "film/image_formats.h"

// Portable float map (Debevec). The header is "PF" for colour or "Pf" for grey, width, height and scale, each followed
// by white space. A negative scale means little-endian. Then come floats, rows from the bottom up.
namespace glimt {
namespace {

constexpr std::string_view white_space = " \t\r\n";

std::uint32_t swapped(std::uint32_t v) { return v >> 24 | (v >> 8 & 0xff00) | (v << 8 & 0xff0000) | v << 24; }

/// Removes white space and one number from the front and returns the number.
template <class T>
T take_number(std::string_view& bytes, const char* name) {
  bytes.remove_prefix(std::min(bytes.find_first_not_of(white_space), bytes.size()));
  T value{};
  const auto [end, error] = std::from_chars(bytes.data(), bytes.data() + bytes.size(), value);
  if (error != std::errc{}) throw std::runtime_error(std::string("the PFM header has no valid ") + name);
  bytes.remove_prefix(static_cast<std::size_t>(end - bytes.data()));
  return value;
}

}  // namespace

std::string encode_pfm(const Image& image) {
  static_assert(std::endian::native == std::endian::little);
  std::string bytes = "PF\n" + std::to_string(image.width) + " " + std::to_string(image.height) + "\n-1.0\n";
  const std::size_t row = static_cast<std::size_t>(image.width) * 3 * sizeof(float);
  for (int y = image.height - 1; y >= 0; --y) bytes.append(reinterpret_cast<const char*>(image.pixel(0, y)), row);
  return bytes;
}

bool is_pfm(std::string_view bytes) {
  return (bytes.starts_with("PF") || bytes.starts_with("Pf")) && bytes.size() > 2 &&
         white_space.find(bytes[2]) != white_space.npos;
}

Image decode_pfm(std::string_view bytes) {
  const std::size_t channels = bytes[1] == 'F' ? 3 : 1;
  bytes.remove_prefix(2);
  const int width = take_number<int>(bytes, "width");
  const int height = take_number<int>(bytes, "height");
  const float scale = take_number<float>(bytes, "scale");
  if (width <= 0 || height <= 0 || scale == 0 || !std::isfinite(scale))
    throw std::runtime_error("the PFM header asks for a size or scale of 0, below 0 or not finite");
  const std::uint64_t needed =
      std::uint64_t{4} * channels * static_cast<unsigned>(width) * static_cast<unsigned>(height);
  if (bytes.empty() || bytes.size() - 1 < needed)
    throw std::runtime_error("the PFM is cut short: " + std::to_string(width) + "x" + std::to_string(height) +
                             " pixels are " + std::to_string(needed) + " bytes, but " +
                             std::to_string(bytes.empty() ? 0 : bytes.size() - 1) + " follow its header");
  bytes.remove_prefix(1);

  Image image{width, height,
              std::vector<float>(static_cast<std::size_t>(width) * static_cast<std::size_t>(height) * 3)};
  const char* next = bytes.data();
  for (int y = height - 1; y >= 0; --y) {
    for (std::size_t i = 0; i < static_cast<std::size_t>(width) * 3; ++i) {
      std::uint32_t word;
      std::memcpy(&word, next, sizeof word);
      image.pixel(0, y)[i] = std::bit_cast<float>(scale < 0 ? word : swapped(word)) * std::abs(scale);
      if (channels == 3 || i % 3 == 2) next += sizeof word;
    }
  }
  return image;
}

}  // namespace glimt
