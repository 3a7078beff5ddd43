#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <vector>

#include "viewer/picture/outline.h"
#include "viewer/state/state.h"
#include "viewer/widgets/layout.h"

namespace glimt {

/// Mouse and keys on the picture: they select an object, and move the camera, a sphere or the picture. Also draws the
/// outline of the selected object.
class ImageTool {
 public:
  const Zoom& zoom() const { return zoom_; }
  void fit() { zoom_ = {}; }
  void set_zoom(const Zoom& zoom) { zoom_ = zoom; }

  /// Whether the right button is held, so that keys move the camera.
  bool flying() const { return drag_ == Drag::fly; }
  /// Speed of the flight, metres per second.
  double speed(const ViewerState& state) const;

  /// Handles the mouse for this picture of the window, unless a panel does.
  void take_mouse(const ViewerState& state, const Rect& area, const PicturePlace& place, Edits& edits);
  void draw_outline(const ViewerState& state, const Rect& area, const PicturePlace& place);

 private:
  enum class Drag { none, undecided, orbit, turn, pan, sphere, picture, fly };

  void press(const ViewerState& state, const glm::dvec2& in_image);
  void drag(const ViewerState& state, const Rect& area, const PicturePlace& place, Edits& edits);
  void scroll(const ViewerState& state, const Rect& area, const PicturePlace& place, Edits& edits);
  void fly(const ViewerState& state, Edits& edits) const;
  void begin(Drag drag);

  Zoom zoom_;
  Drag drag_ = Drag::none;
  std::optional<ObjectId> under_;  ///< the object at which the button was pressed
  glm::dvec3 grip_{0};             ///< the world point at which it was pressed, or look_at
  bool other_view_ = false;        ///< Alt was held: turn instead of orbit, or orbit instead of turn
  bool navigates_ = false;         ///< after the flight, keys move between controls again
  double pace_ = 0.125;            ///< speed of the flight, sizes of the scene per second
  std::optional<ObjectId> outlined_;
  std::uint64_t outlined_version_ = 0;
  std::vector<OutlinePiece> outline_;
};

}  // namespace glimt
