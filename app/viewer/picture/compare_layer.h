#pragma once

#include "viewer/picture/image_view.h"
#include "viewer/state/state.h"
#include "viewer/widgets/layout.h"

namespace glimt {

/// What the comparison draws over the picture: B beside the split's line or alone, or how A and B differ.
class CompareLayer {
 public:
  void draw(const ViewerState& state, const Rect& area, const Placement& picture);
  /// As ImageView's.
  bool prepare() { return image_.prepare(); }
  /// The line of the split, which can be dragged. Above the picture, below all panels.
  void draw_line(const ViewerState& state, const Rect& area, const Placement& picture, Edits& edits);

 private:
  std::shared_ptr<const Frame> compared(const std::shared_ptr<const Frame>& a, const std::shared_ptr<const Frame>& b,
                                        CompareView view);

  ImageView image_;
  std::shared_ptr<const Frame> a_, b_, result_;  ///< of the last comparison
  CompareView view_ = CompareView::off;
};

}  // namespace glimt
