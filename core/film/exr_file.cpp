#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfInputFile.h>
#include <OpenEXR/ImfOutputFile.h>
#include <OpenEXR/ImfStdIO.h>
#include <OpenEXR/ImfStringAttribute.h>

#include <array>
#include <stdexcept>

#include "film/image_formats.h"

namespace glimt {
namespace {

constexpr std::array channel_names = {"R", "G", "B"};
constexpr int largest_side = 1 << 20;

/// One channel of interleaved floats. `base` is the address of its pixel (0, 0), which need not exist.
Imf::Slice float_slice(float* base, std::size_t row_floats) {
  return {Imf::FLOAT, reinterpret_cast<char*>(base), 3 * sizeof(float), row_floats * sizeof(float)};
}

/// OpenEXR's messages have the form "Cannot read image file "". Reason."; this keeps the reason.
[[noreturn]] void fail(const std::exception& error) {
  const std::string text = error.what();
  const std::size_t reason = text.find("\". ");
  throw std::runtime_error("not a sound EXR: " + (reason == text.npos ? text : text.substr(reason + 3)));
}

}  // namespace

std::string encode_exr(const Image& mean, const Image& standard_error, const Metadata& metadata) {
  Imf::Header header(mean.width, mean.height);
  Imf::FrameBuffer channels;
  const std::size_t row_floats = static_cast<std::size_t>(mean.width) * 3;
  const auto add_channels = [&](const std::string& prefix, const Image& image) {
    for (std::size_t c = 0; c < channel_names.size(); ++c) {
      header.channels().insert(prefix + channel_names[c], Imf::Channel(Imf::FLOAT));
      // The library wants a non-const pointer even to data that it only writes to a file.
      channels.insert(prefix + channel_names[c], float_slice(const_cast<float*>(image.rgb.data()) + c, row_floats));
    }
  };
  add_channels("", mean);
  add_channels("error.", standard_error);
  for (const auto& [key, text] : metadata)
    header.insert(std::string(metadata_prefix) + key, Imf::StringAttribute(text));

  Imf::StdOSStream stream;
  {
    Imf::OutputFile output(stream, header);
    output.setFrameBuffer(channels);
    output.writePixels(mean.height);
  }
  return stream.str();
}

Image decode_exr(std::string_view bytes) {
  Imf::StdISStream stream;
  stream.str(std::string(bytes));
  try {
    Imf::InputFile input(stream);
    for (const char* name : channel_names)
      if (!input.header().channels().findChannel(name))
        throw std::runtime_error(std::string("it has no channel ") + name + "; R, G and B are needed");
    const Imath::Box2i window = input.header().dataWindow();
    const auto width = std::int64_t{window.max.x} - window.min.x + 1,
               height = std::int64_t{window.max.y} - window.min.y + 1;
    if (width > largest_side || height > largest_side) throw std::runtime_error("a side is longer than 2^20 pixels");

    // Reading row by row keeps a header with a wrong size from taking memory for data that is not there.
    Image image{static_cast<int>(width), static_cast<int>(height), {}};
    std::vector<float> row(static_cast<std::size_t>(width) * 3);
    Imf::FrameBuffer channels;
    for (std::size_t c = 0; c < channel_names.size(); ++c)
      channels.insert(channel_names[c], float_slice(row.data() + c - std::ptrdiff_t{3} * window.min.x, 0));
    input.setFrameBuffer(channels);
    for (int y = window.min.y; y <= window.max.y; ++y) {
      input.readPixels(y);
      image.rgb.insert(image.rgb.end(), row.begin(), row.end());
    }
    return image;
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception& error) {
    fail(error);
  }
}

Metadata decode_exr_metadata(std::string_view bytes) {
  Imf::StdISStream stream;
  stream.str(std::string(bytes));
  Metadata metadata;
  try {
    const Imf::InputFile input(stream);
    for (auto attribute = input.header().begin(); attribute != input.header().end(); ++attribute) {
      const std::string_view name = attribute.name();
      const auto* text = dynamic_cast<const Imf::StringAttribute*>(&attribute.attribute());
      if (text && name.starts_with(metadata_prefix))
        metadata[std::string(name.substr(metadata_prefix.size()))] = text->value();
    }
  } catch (const std::exception& error) {
    fail(error);
  }
  return metadata;
}

}  // namespace glimt
