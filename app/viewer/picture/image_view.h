#pragma once

#include <memory>

#include "film/display.h"
#include "render/session.h"
#include "viewer/widgets/layout.h"

namespace glimt {

/// The rendered picture as one OpenGL texture. It must be destroyed before the OpenGL context.
class ImageView {
 public:
  ImageView() = default;
  ~ImageView();
  ImageView(const ImageView&) = delete;
  ImageView& operator=(const ImageView&) = delete;

  /// Adds the frame to what ImGui draws behind all panels, at `place`, clipped to `area`. A frame without the data for
  /// this view leaves the last picture there.
  void draw(const std::shared_ptr<const Frame>& frame, const Display& display, const Rect& area,
            const PicturePlace& place);
  /// Makes the texture ready before ImGui paints. Returns true if its contents are new.
  bool prepare();

 private:
  void upload(const Image& image);

  unsigned texture_ = 0;
  int width_ = 0, height_ = 0;          ///< of the texture
  std::shared_ptr<const Frame> frame_;  ///< in the texture, or waiting for upload
  Display display_;
  std::shared_ptr<const Image> waiting_;  ///< to upload next
  bool whole_ = false;                    ///< each picture pixel covers a whole number of screen pixels
};

}  // namespace glimt
