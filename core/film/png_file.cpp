#include <stb_image_write.h>
#include <zlib.h>

#include <cstdint>
#include <limits>
#include <stdexcept>

#include "film/image_formats.h"

// Portable Network Graphics (PNG) Specification, W3C 2003: 5.3 chunk layout, 11.3.3.3 sRGB, 11.3.4.5 iTXt.
namespace glimt {
namespace {

constexpr std::size_t ihdr_end = 8 + 12 + 13;
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

/// An iTXt chunk: uncompressed, with empty language tag and translated keyword.
std::string text_chunk(const std::string& key, const std::string& text) {
  return chunk(text_type, std::string(metadata_prefix) + key + std::string(5, '\0') + text);
}

/// Reads the data of one text chunk; skips what glimt did not write.
void read_text(std::string_view data, Metadata& metadata) {
  const std::size_t keyword_end = data.find('\0');
  if (!data.starts_with(metadata_prefix) || keyword_end == data.npos) return;
  const std::string_view key = data.substr(metadata_prefix.size(), keyword_end - metadata_prefix.size());
  const std::string_view rest = data.substr(keyword_end);
  const std::string_view plain(std::string_view("\0\0\0\0\0", 5));
  if (rest.starts_with(plain)) metadata[std::string(key)] = rest.substr(plain.size());
}

}  // namespace

void check_png_size(int width, int height) {
  if ((std::int64_t{3} * width + 1) * height > std::numeric_limits<int>::max() / 2)
    throw std::runtime_error("the image is too large for a PNG; .exr and .pfm are not limited");
}

std::string encode_png(int width, int height, std::span<const std::uint8_t> rgb, const Metadata& metadata) {
  check_png_size(width, height);
  std::string bytes;
  const auto append = [](void* context, void* data, int size) {
    static_cast<std::string*>(context)->append(static_cast<const char*>(data), static_cast<std::size_t>(size));
  };
  // This suits noise: the filter predicts the mean of the pixels left and above, and no long search for repetitions.
  [[maybe_unused]] static const bool chosen = [] {
    stbi_write_force_png_filter = 3;
    stbi_write_png_compression_level = 5;
    return true;
  }();
  if (!stbi_write_png_to_func(append, &bytes, width, height, 3, rgb.data(), 3 * width)) throw std::bad_alloc();

  const char perceptual = 0;
  std::string extra = chunk("sRGB", {&perceptual, 1});
  for (const auto& [key, text] : metadata) extra += text_chunk(key, text);
  return bytes.insert(ihdr_end, extra);
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
