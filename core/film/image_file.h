#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <stdexcept>
#include <string>

#include "film/display.h"
#include "film/film.h"

namespace glimt {

/// A file cannot be written or read. what() names the file, the reason, and what is allowed.
struct ImageFileError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// How an image was made. The keys are "scene" (the scene file's text, settings included), "samples", "seed", "version"
/// and others, as render_metadata (metadata.h) fills them. In files each key is "glimt:KEY": a string attribute in EXR,
/// an iTXt chunk in PNG. A PNG also has the display's fields ("exposure", "tone", "view", "dither").
using Metadata = std::map<std::string, std::string>;

/// Throws ImageFileError where `file` cannot be written or has an unknown ending. Known are .png, .exr and .pfm; "-" is
/// a PNG on standard output. Call it before rendering starts.
void check_writable(const std::filesystem::path& file);

/// Writes the format that the ending names. A .png is the displayed picture in 8-bit sRGB. An .exr has the mean
/// radiance as R, G, B and its standard error as error.R, error.G, error.B, float32. A .pfm has the mean radiance,
/// float32. PNG and EXR carry the metadata. The file is replaced in one step. Throws ImageFileError.
void write_image(const std::filesystem::path& file, const Film& film, const Display& display, const Metadata& metadata);

/// The most memory in bytes that write_image takes for a film of this size, besides the film.
std::uint64_t bytes_to_write(const std::filesystem::path& file, int width, int height);

/// Writes an image as the display shows it; the image holds what the display's view names. Throws ImageFileError.
void write_png(const std::filesystem::path& file, const Image& image, const Display& display, const Metadata& metadata);

/// Writes the EXR that write_image describes. Throws ImageFileError.
void write_exr(const std::filesystem::path& file, const Image& radiance, const Image& standard_error,
               const Metadata& metadata);

/// Reads R, G, B of an EXR or a PFM. A grey PFM gives three equal channels. Throws ImageFileError.
Image read_image(const std::filesystem::path& file);

/// The metadata of a PNG or EXR that glimt wrote; empty for others. Throws ImageFileError where the file cannot be
/// read.
Metadata read_metadata(const std::filesystem::path& file);

}  // namespace glimt
