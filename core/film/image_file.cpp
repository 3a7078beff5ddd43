#include "film/image_file.h"

#include <unistd.h>

#include <algorithm>
#include <cctype>
#include <new>

#include "film/file_bytes.h"
#include "film/image_formats.h"
#include "scene/file/text.h"

namespace glimt {
namespace {

enum class Format { png, exr, pfm };

Format format_of(const std::filesystem::path& file) {
  if (file == "-") return Format::png;
  std::string ending = file.extension().string();
  std::ranges::transform(ending, ending.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  if (ending == ".png") return Format::png;
  if (ending == ".exr") return Format::exr;
  if (ending == ".pfm") return Format::pfm;
  throw ImageFileError(file.string() + ": unknown ending \"" + ending +
                       "\"; allowed are .png (displayed picture), .exr and .pfm (linear radiance)");
}

/// Returns f(), and turns what it throws into an ImageFileError that names the file.
template <class F>
auto naming(const std::filesystem::path& file, F f) {
  try {
    return f();
  } catch (const ImageFileError&) {
    throw;
  } catch (const std::bad_alloc&) {
    throw ImageFileError(file.string() + ": not enough memory for an image of this size");
  } catch (const std::exception& error) {
    throw ImageFileError(file.string() + ": " + error.what());
  }
}

}  // namespace

void check_writable(const std::filesystem::path& file) {
  format_of(file);
  if (file == "-" && isatty(STDOUT_FILENO) != 0)
    throw ImageFileError("standard output is a terminal, which cannot show a PNG: pipe it, or name a file");
  check_replaceable(file);
}

void write_png(const std::filesystem::path& file, const Image& image, const Display& display,
               const Metadata& metadata) {
  naming(file, [&] {
    Metadata all = metadata;
    all.merge(display_texts(display));
    check_png_size(image.width, image.height);  // before the pixels are converted
    replace_file(file, encode_png(image.width, image.height, to_srgb8(image, display), all));
  });
}

void write_exr(const std::filesystem::path& file, const Image& radiance, const Image& standard_error,
               const Metadata& metadata) {
  naming(file, [&] { replace_file(file, encode_exr(radiance, standard_error, metadata)); });
}

void write_image(const std::filesystem::path& file, const Film& film, const Display& display,
                 const Metadata& metadata) {
  naming(file, [&] {
    switch (format_of(file)) {
      case Format::png:
        return write_png(file, film.mean(), display, metadata);
      case Format::exr:
        return write_exr(file, film.mean(), film.standard_error(), metadata);
      case Format::pfm:
        return replace_file(file, encode_pfm(film.mean()));
    }
  });
}

std::uint64_t bytes_to_write(const std::filesystem::path& file, int width, int height) {
  // Bytes per pixel: radiance (12) and its encoding. An EXR also has the error (12), its bytes in a stream that doubles
  // when it grows (48), and a copy of them (24).
  const std::uint64_t per_pixel = format_of(file) == Format::exr ? 96 : 28;
  return per_pixel * static_cast<std::uint64_t>(width) * static_cast<std::uint64_t>(height);
}

Image read_image(const std::filesystem::path& file) {
  return naming(file, [&] {
    const std::string bytes = read_file(file);
    if (bytes.empty()) throw std::runtime_error("the file is empty; an EXR or PFM image is needed");
    if (bytes.starts_with(exr_signature)) return decode_exr(bytes);
    if (is_pfm(bytes)) return decode_pfm(bytes);
    if (bytes.starts_with(png_signature))
      throw std::runtime_error("a PNG holds the displayed picture, not radiance; allowed are EXR and PFM images");
    throw std::runtime_error("neither an EXR nor a PFM image, which are the formats read");
  });
}

Metadata read_metadata(const std::filesystem::path& file) {
  return naming(file, [&]() -> Metadata {
    const std::string bytes = read_file(file);
    if (bytes.starts_with(png_signature)) return decode_png_metadata(bytes);
    if (bytes.starts_with(exr_signature)) return decode_exr_metadata(bytes);
    return {};
  });
}

}  // namespace glimt
