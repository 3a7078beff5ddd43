#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <vector>

#include "viewer/picture/outline.h"
#include "viewer/state/state.h"
#include "viewer/widgets/layout.h"

namespace glimt {

/// What the mouse does on the picture: selects, moves the camera, a sphere or the picture; and the outline of what is
/// selected.
class ImageTool {
 public:
  const Zoom& zoom() const { return zoom_; }
  void fit() { zoom_ = {}; }
  void set_zoom(const Zoom& zoom) { zoom_ = zoom; }

  /// Takes the mouse's doings of this picture of the window, where no panel does.
  void take_mouse(const ViewerState& state, const Rect& area, const Placement& place, Edits& edits);
  void draw_outline(const ViewerState& state, const Rect& area, const Placement& place);

 private:
  enum class Drag { none, undecided, orbit, pan, sphere, picture };

  void press(const ViewerState& state, const glm::dvec2& in_image);
  void drag(const ViewerState& state, const Rect& area, const Placement& place, Edits& edits);
  void scroll(const ViewerState& state, const Rect& area, const Placement& place, Edits& edits);

  Zoom zoom_;
  Drag drag_ = Drag::none;
  std::optional<ObjectId> under_;  ///< what the button was pressed on
  glm::dvec3 grip_{0};             ///< the world point there, or look_at
  std::optional<ObjectId> outlined_;
  std::uint64_t outlined_version_ = 0;
  std::vector<OutlinePiece> outline_;
};

}  // namespace glimt
