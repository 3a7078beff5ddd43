#include "viewer/picture/shown_image.h"

#include <vector>

namespace glimt {

std::shared_ptr<const Image> shown_image(const std::shared_ptr<const Frame>& frame, View view) {
  switch (view) {
    case View::image:
      return {frame, &frame->mean};
    case View::error:
      return frame->error.rgb.empty() ? nullptr : std::shared_ptr<const Image>(frame, &frame->error);
    case View::samples:
      break;
  }
  const auto [width, height] = frame->size;
  const auto values = 3 * static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
  return std::make_shared<const Image>(
      Image{width, height, std::vector<float>(values, static_cast<float>(frame->samples))});
}

}  // namespace glimt
