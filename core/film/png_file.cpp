#include <zlib.h>

#include <cstdint>
#include <limits>
#include <new>
#include <stdexcept>
#include <vector>

#include "film/image_formats.h"

// Portable Network Graphics (PNG) Specification, W3C 2003: 5.3 chunk layout, 9 filtering, 11.2.2 IHDR,
// 11.3.3.3 sRGB, 11.3.4.5 iTXt.
namespace glimt {
namespace {

constexpr std::string_view text_type = "iTXt";

std::string big_endian(std::uint32_t value) {
  std::string bytes;
  for (int shift = 24; shift >= 0; shift -= 8) bytes += static_cast<char>(value >> shift & 0xff);
  return bytes;
}

std::uint32_t read_big_endian(std::string_view bytes) {
  std::uint32_t value = 0;
  for (const char byte : bytes.substr(0, 4)) value = value << 8 | static_cast<unsigned char>(byte);
  return value;
}

std::uint32_t checksum(std::string_view type_and_data) {
  return static_cast<std::uint32_t>(
      crc32_z(0, reinterpret_cast<const Bytef*>(type_and_data.data()), type_and_data.size()));
}

std::string chunk(std::string_view type, std::string_view data) {
  if (data.size() > std::numeric_limits<std::int32_t>::max()) throw std::runtime_error("metadata too long for a PNG");
  const std::string body = std::string(type) + std::string(data);
  return big_endian(static_cast<std::uint32_t>(data.size())) + body + big_endian(checksum(body));
}

/// Uncompressed, with empty language tag and translated keyword.
std::string text_chunk(const std::string& key, const std::string& text) {
  return chunk(text_type, std::string(metadata_prefix) + key + std::string(5, '\0') + text);
}

/// Takes one text chunk's data apart; leaves out what glimt did not write.
void read_text(std::string_view data, Metadata& metadata) {
  const std::size_t keyword_end = data.find('\0');
  if (!data.starts_with(metadata_prefix) || keyword_end == data.npos) return;
  const std::string_view key = data.substr(metadata_prefix.size(), keyword_end - metadata_prefix.size());
  const std::string_view rest = data.substr(keyword_end);
  const std::string_view plain(std::string_view("\0\0\0\0\0", 5));
  if (rest.starts_with(plain)) metadata[std::string(key)] = rest.substr(plain.size());
}

/// Every row as its difference from the mean of the pixels left and above (filter type 3), which suits noise best.
std::string filtered(int width, int height, std::span<const std::uint8_t> rgb) {
  const auto row = 3 * static_cast<std::size_t>(width);
  const std::vector<std::uint8_t> none(row);
  std::string bytes;
  bytes.reserve((row + 1) * static_cast<std::size_t>(height));
  const std::uint8_t* above = none.data();
  for (const std::uint8_t* here = rgb.data(); here < rgb.data() + rgb.size(); here += row) {
    bytes += '\3';
    for (std::size_t i = 0; i < row; ++i) {
      const int left = i < 3 ? 0 : here[i - 3];
      bytes += static_cast<char>(here[i] - (left + above[i]) / 2);
    }
    above = here;
  }
  return bytes;
}

/// As a zlib stream. Noise has no repetitions that were worth looking for.
std::string compressed(std::string bytes) {
  z_stream stream{};
  if (deflateInit2(&stream, 1, Z_DEFLATED, 15, 8, Z_RLE) != Z_OK) throw std::bad_alloc();
  std::string packed(deflateBound(&stream, bytes.size()), '\0');
  stream.next_in = reinterpret_cast<Bytef*>(bytes.data());
  stream.avail_in = static_cast<uInt>(bytes.size());
  stream.next_out = reinterpret_cast<Bytef*>(packed.data());
  stream.avail_out = static_cast<uInt>(packed.size());
  deflate(&stream, Z_FINISH);
  packed.resize(stream.total_out);
  deflateEnd(&stream);
  return packed;
}

}  // namespace

std::string encode_png(int width, int height, std::span<const std::uint8_t> rgb, const Metadata& metadata) {
  if ((std::int64_t{3} * width + 1) * height > std::numeric_limits<int>::max() / 2)
    throw std::runtime_error("the image is too large for a PNG; .exr and .pfm are not limited");
  const std::string size =
      big_endian(static_cast<std::uint32_t>(width)) + big_endian(static_cast<std::uint32_t>(height));
  const std::string format("\x8\x2\0\0\0", 5);  // 8 bits, RGB
  const std::string perceptual(1, '\0');
  std::string bytes = std::string(png_signature) + chunk("IHDR", size + format) + chunk("sRGB", perceptual);
  for (const auto& [key, text] : metadata) bytes += text_chunk(key, text);
  return bytes + chunk("IDAT", compressed(filtered(width, height, rgb))) + chunk("IEND", "");
}

Metadata decode_png_metadata(std::string_view bytes) {
  Metadata metadata;
  bytes.remove_prefix(png_signature.size());
  std::string_view type;
  while (type != "IEND") {
    if (bytes.size() < 12 || read_big_endian(bytes) > bytes.size() - 12)
      throw std::runtime_error("the PNG is cut short");
    const std::size_t length = read_big_endian(bytes);
    if (checksum(bytes.substr(4, length + 4)) != read_big_endian(bytes.substr(8 + length)))
      throw std::runtime_error("the PNG is damaged: a checksum is wrong");
    type = bytes.substr(4, 4);
    if (type == text_type) read_text(bytes.substr(8, length), metadata);
    bytes.remove_prefix(length + 12);
  }
  return metadata;
}

}  // namespace glimt
