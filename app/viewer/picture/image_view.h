#pragma once

#include <memory>

#include "film/display.h"
#include "render/session.h"
#include "viewer/widgets/layout.h"

namespace glimt {

/// The rendered picture as one OpenGL texture. Lives and dies with the OpenGL context.
class ImageView {
 public:
  ImageView() = default;
  ~ImageView();
  ImageView(const ImageView&) = delete;
  ImageView& operator=(const ImageView&) = delete;

  /// Adds the frame to what ImGui draws behind all panels, at its place within `area`. A frame that does not hold what
  /// is to be shown leaves the last picture there.
  void draw(const std::shared_ptr<const Frame>& frame, const Display& display, const Rect& area,
            const Placement& place);
  /// Makes the texture ready for ImGui's picture to be painted; true where it holds something new.
  bool prepare();

 private:
  void upload(const Image& image);

  unsigned texture_ = 0;
  int width_ = 0, height_ = 0;          ///< of the texture
  std::shared_ptr<const Frame> frame_;  ///< in the texture, or on its way there
  Display display_;
  std::shared_ptr<const Image> waiting_;  ///< to be uploaded
  bool whole_ = false;                    ///< each of its pixels covers whole ones of the screen
};

}  // namespace glimt
