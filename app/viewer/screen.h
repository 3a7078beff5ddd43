#pragma once

#include "viewer/panels/files_panel.h"
#include "viewer/panels/panels.h"
#include "viewer/picture/compare_layer.h"
#include "viewer/picture/image_tool.h"
#include "viewer/picture/image_view.h"
#include "viewer/picture/inspector.h"
#include "viewer/state/state.h"
#include "viewer/widgets/widgets.h"

namespace glimt {

/// The free space for the picture in a window of this size on an ordinary screen, without the chart; pixels.
ImageSize room_in_window(int width, int height);

/// Draws the window's contents with ImGui and OpenGL 2 into the current OpenGL context. Owns the ImGui context. The
/// platform sets sizes, mouse and keys in ImGui::GetIO() before each lay_out().
class Screen {
 public:
  Screen();
  ~Screen();
  Screen(const Screen&) = delete;
  Screen& operator=(const Screen&) = delete;

  /// Lays out the window's next picture and adds what the person asked for to `edits`. `scale` is window coordinates
  /// per design unit.
  void lay_out(const ViewerState& state, float scale, Edits& edits);
  /// Draws what was laid out, unless it looks like the last picture. Returns true if it drew.
  bool paint();
  /// Makes the next paint() draw: what the window showed is lost.
  void forget_picture() { painted_.clear(); }

  /// Where the last lay_out() put the controls.
  const WidgetRects& widgets() const { return widgets_; }

  /// Whether keys move the camera.
  bool flying() const { return tool_.flying(); }
  /// Opens a file that was dropped into the window, a scene or a picture with its scene. A PFM file, or an EXR dropped
  /// onto the chart, becomes the reference.
  void drop(const std::filesystem::path& file, Edits& edits) const;

 private:
  void draw_column(const ViewerState& state, const Rect& place, Edits& edits);
  void carry_out(const ViewerState& state, Edits& edits);
  void go_to_worst_pixel(const ViewerState& state, Edits& edits);
  void draw_tabs(const ViewerState& state, Edits& edits);
  void draw_status(const ViewerState& state, const Rect& place, const PicturePlace& picture);
  void draw_hint(const ViewerState& state, const Rect& area) const;
  void set_scale(float scale, float ratio);
  void follow_gesture(Edits& edits);

  WidgetRects widgets_;
  std::string painted_;  ///< all of ImGui's lists in the last picture
  std::unique_ptr<ImageView> image_;
  std::unique_ptr<CompareLayer> compare_;
  Inspector inspector_;
  Rect chart_;  ///< in the last picture
  ImageTool tool_;
  FilesPanel files_;
  bool help_ = false;
  std::optional<ObjectId> selected_;  ///< in the last picture
  float scale_ = 0, ratio_ = 0;
  std::uint64_t gesture_ = 1;
  unsigned active_ = 0;      ///< ImGui's active control in the last picture
  double last_scroll_ = -1;  ///< ImGui's time, seconds
};

}  // namespace glimt
