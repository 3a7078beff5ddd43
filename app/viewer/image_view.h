#pragma once

#include <memory>

#include "film/display.h"
#include "render/session.h"
#include "viewer/layout.h"

namespace glimt {

/// The rendered picture as one OpenGL texture. Lives and dies with the OpenGL context.
class ImageView {
 public:
  ImageView() = default;
  ~ImageView();
  ImageView(const ImageView&) = delete;
  ImageView& operator=(const ImageView&) = delete;

  /// Converts and uploads the frame where it or the display is new, and adds it to what ImGui draws behind all panels,
  /// at its place within `area`. A frame that does not hold what is to be shown leaves the last picture there.
  void draw(const std::shared_ptr<const Frame>& frame, const Display& display, const Rect& area,
            const Placement& place);

 private:
  void upload(const Image& image);

  unsigned texture_ = 0;
  int width_ = 0, height_ = 0;
  std::shared_ptr<const Frame> frame_;  ///< in the texture
  Display display_;
};

}  // namespace glimt
