#pragma once

#include "viewer/image_view.h"
#include "viewer/state.h"
#include "viewer/widgets.h"

namespace glimt {

/// Draws the window's contents with ImGui and OpenGL 2 into the current context, whoever made it. Owns the ImGui
/// context; sizes, mouse and keys are set in ImGui::GetIO() by the platform before each draw().
class Screen {
 public:
  Screen();
  ~Screen();
  Screen(const Screen&) = delete;
  Screen& operator=(const Screen&) = delete;

  /// Draws everything and adds what was asked for to `edits`. `scale` is window coordinates per unit of design.
  void draw(const ViewerState& state, float scale, Edits& edits);

  /// Where the controls of the last draw() are.
  const WidgetRects& widgets() const { return widgets_; }

 private:
  void draw_column(const ViewerState& state, const Rect& place, Edits& edits);
  void draw_status(const ViewerState& state, const Rect& place, const Placement& picture);
  void set_scale(float scale, float ratio);

  WidgetRects widgets_;
  std::unique_ptr<ImageView> image_;
  float scale_ = 0, ratio_ = 0;
};

}  // namespace glimt
