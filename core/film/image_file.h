#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <stdexcept>
#include <string>

#include "film/display.h"
#include "film/film.h"

namespace glimt {

/// A file that cannot be written or read; what() names it and the reason, and what is allowed.
struct ImageFileError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// What an image says of its making: keys "scene" (the scene file's text, settings included), "samples", "seed",
/// "version" and the like, as render_metadata (metadata.h) fills them. In files each key is "glimt:KEY": a string
/// attribute in EXR, an iTXt chunk in PNG, which also has the display's
/// fields ("exposure", "tone", "view").
using Metadata = std::map<std::string, std::string>;

/// Throws ImageFileError at once where `file` has an unknown ending (.png, .exr, .pfm; "-" is a PNG on standard output)
/// or cannot be written there: to be asked before rendering starts.
void check_writable(const std::filesystem::path& file);

/// Writes by the ending. .png: the displayed picture, 8-bit sRGB. .exr: R, G, B the mean radiance and error.R, error.G,
/// error.B its standard error, float32. .pfm: the mean radiance, float32. PNG and EXR carry the metadata. Written to a
/// temporary file in the same folder and renamed. Throws ImageFileError.
void write_image(const std::filesystem::path& file, const Film& film, const Display& display, const Metadata& metadata);

/// Bytes that write_image takes for a film of this size, at most, beside the film itself.
std::uint64_t bytes_to_write(const std::filesystem::path& file, int width, int height);

/// The displayed picture of any image that the display's view may show. Throws ImageFileError.
void write_png(const std::filesystem::path& file, const Image& image, const Display& display, const Metadata& metadata);

/// As write_image writes it for .exr. Throws ImageFileError.
void write_exr(const std::filesystem::path& file, const Image& radiance, const Image& standard_error,
               const Metadata& metadata);

/// Reads R, G, B of an EXR or a PFM (colour; grey is spread over the channels). Throws ImageFileError.
Image read_image(const std::filesystem::path& file);

/// The metadata of a PNG or EXR that glimt wrote; empty for others. Throws ImageFileError where the file cannot be
/// read.
Metadata read_metadata(const std::filesystem::path& file);

}  // namespace glimt
