#pragma once

namespace glimt {

/// In window coordinates, y down.
struct Rect {
  float x = 0, y = 0, width = 0, height = 0;
};

/// The parts of the window, which touch and do not overlap.
struct Layout {
  Rect image;   ///< free space for the picture
  Rect status;  ///< one line below it
  Rect column;  ///< the controls, at the right
};

/// `scale` is 1 on an ordinary screen and 2 where everything should be twice as large.
Layout make_layout(float width, float height, float scale);

/// Where a picture is drawn.
struct Placement {
  Rect rect;
  float zoom = 1;      ///< framebuffer pixels per picture pixel
  bool whole = false;  ///< the zoom is a whole number
};

/// The picture as large as fits, centred on whole framebuffer pixels; its zoom is rounded down to a whole number where
/// that costs less than a tenth. `ratio` is framebuffer pixels per window coordinate.
Placement place_image(int image_width, int image_height, const Rect& area, float ratio);

}  // namespace glimt
