#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <vector>

#include "viewer/picture/outline.h"
#include "viewer/state/state.h"
#include "viewer/widgets/layout.h"

namespace glimt {

/// What mouse and keys do on the picture: they select, move the camera, a sphere or the picture; and the outline of
/// what is selected.
class ImageTool {
 public:
  const Zoom& zoom() const { return zoom_; }
  void fit() { zoom_ = {}; }
  void set_zoom(const Zoom& zoom) { zoom_ = zoom; }

  /// The right button is held, and keys move the camera.
  bool flying() const { return drag_ == Drag::fly; }
  /// Metres a second.
  double speed(const ViewerState& state) const;

  /// Takes the mouse's doings of this picture of the window, where no panel does.
  void take_mouse(const ViewerState& state, const Rect& area, const Placement& place, Edits& edits);
  void draw_outline(const ViewerState& state, const Rect& area, const Placement& place);

 private:
  enum class Drag { none, undecided, orbit, turn, pan, sphere, picture, fly };

  void press(const ViewerState& state, const glm::dvec2& in_image);
  void drag(const ViewerState& state, const Rect& area, const Placement& place, Edits& edits);
  void scroll(const ViewerState& state, const Rect& area, const Placement& place, Edits& edits);
  void fly(const ViewerState& state, Edits& edits) const;
  void begin(Drag drag);

  Zoom zoom_;
  Drag drag_ = Drag::none;
  std::optional<ObjectId> under_;  ///< what the button was pressed on
  glm::dvec3 grip_{0};             ///< the world point there, or look_at
  bool other_view_ = false;        ///< Alt was held, for the view that a drag does not change otherwise
  bool navigates_ = false;         ///< keys will move from control to control again after the flight
  double pace_ = 0.125;            ///< of the flight, sizes of the scene a second
  std::optional<ObjectId> outlined_;
  std::uint64_t outlined_version_ = 0;
  std::vector<OutlinePiece> outline_;
};

}  // namespace glimt
