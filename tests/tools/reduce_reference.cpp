#include <cstddef>
#include <fstream>
#include <iostream>

#include "film/image_formats.h"

/// reduce_reference REFERENCE.exr OUT.pfm: means over blocks of 8x8 pixels.
int main(int count, char** argument) {
  if (count != 3) {
    std::cerr << "usage: reduce_reference REFERENCE.exr OUT.pfm\n";
    return 2;
  }
  try {
    using namespace glimt;
    constexpr int size = 8;
    const Image image = read_image(argument[1]);
    Image blocks{image.width / size, image.height / size, {}};
    for (int y = 0; y < blocks.height; ++y)
      for (int x = 0; x < blocks.width; ++x)
        for (std::size_t c = 0; c < 3; ++c) {
          double sum = 0;
          for (int i = 0; i < size * size; ++i)
            sum += static_cast<double>(image.pixel(size * x + i % size, size * y + i / size)[c]);
          blocks.rgb.push_back(static_cast<float>(sum / (size * size)));
        }
    std::ofstream(argument[2], std::ios::binary) << encode_pfm(blocks);
  } catch (const std::exception& error) {
    std::cerr << "reduce_reference: " << error.what() << "\n";
    return 1;
  }
}
