#pragma once

#include "viewer/picture/image_view.h"
#include "viewer/state/state.h"
#include "viewer/widgets/layout.h"

namespace glimt {

/// Draws the comparison over the picture: B at one side of the split or alone, or how A and B differ.
class CompareLayer {
 public:
  void draw(const ViewerState& state, const Rect& area, const PicturePlace& picture);
  /// As ImageView::prepare.
  bool prepare() { return image_.prepare(); }
  /// Draws the split's line, which can be dragged, above the picture and below all panels.
  void draw_line(const ViewerState& state, const Rect& area, const PicturePlace& picture, Edits& edits);

 private:
  std::shared_ptr<const Frame> compared(const std::shared_ptr<const Frame>& a, const std::shared_ptr<const Frame>& b,
                                        CompareView view);

  ImageView image_;
  std::shared_ptr<const Frame> a_, b_, result_;  ///< pictures and result of the last comparison
  CompareView view_ = CompareView::off;
};

}  // namespace glimt
