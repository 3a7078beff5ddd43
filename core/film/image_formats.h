#pragma once

#include <span>
#include <string>
#include <string_view>

#include "film/image_file.h"

/// Encodes and decodes the bytes of each format. Decoders throw std::runtime_error where bytes are missing or damaged.
/// The message does not name the file.
namespace glimt {

inline constexpr std::string_view metadata_prefix = "glimt:";

inline constexpr std::string_view png_signature = "\x89PNG\r\n\x1a\n";
inline constexpr std::string_view exr_signature = "\x76\x2f\x31\x01";

/// Throws std::runtime_error where the image is too large for a PNG.
void check_png_size(int width, int height);

/// `rgb` is 3 * width * height bytes.
std::string encode_png(int width, int height, std::span<const std::uint8_t> rgb, const Metadata& metadata);
Metadata decode_png_metadata(std::string_view bytes);

std::string encode_exr(const Image& mean, const Image& standard_error, const Metadata& metadata);
Image decode_exr(std::string_view bytes);
Metadata decode_exr_metadata(std::string_view bytes);

std::string encode_pfm(const Image& image);
/// Whether the bytes begin like a colour or grey PFM.
bool is_pfm(std::string_view bytes);
Image decode_pfm(std::string_view bytes);

}  // namespace glimt
