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
  Rect chart;   ///< empty where it is not shown
};

/// `scale` is 1 on an ordinary screen and 2 where everything should be twice as large.
Layout make_layout(float width, float height, float scale);

/// The same with a part of the picture's space for the chart, below or beside it, whichever leaves the picture larger.
Layout with_chart(const Layout& layout, int image_width, int image_height, float scale);

bool is_inside(const Rect& rect, float x, float y);

/// Where a picture is drawn.
struct Placement {
  Rect rect;
  float zoom = 1;      ///< framebuffer pixels per picture pixel
  bool whole = false;  ///< the zoom is a whole number
};

/// The picture as large as fits, centred on whole framebuffer pixels; its zoom is rounded down to a whole number where
/// that costs less than a tenth. `ratio` is framebuffer pixels per window coordinate.
Placement place_image(int image_width, int image_height, const Rect& area, float ratio);

/// How much of the picture is looked at, and where.
struct Zoom {
  float zoom = 0;            ///< framebuffer pixels per picture pixel; 0: the picture as large as fits
  float x = 0.5F, y = 0.5F;  ///< the place in the picture, 0..1, that is in the middle of the free space
};

/// The picture as `zoom` wants it. It never leaves the free space empty where it could fill it.
Placement place_image(int image_width, int image_height, const Rect& area, float ratio, const Zoom& zoom);

/// Another magnification that leaves the place of the picture under a point of the window where it is.
Zoom zoomed(const Placement& place, const Rect& area, float zoom, float x, float y);
/// The picture moved over the window.
Zoom moved(const Placement& place, const Rect& area, float dx, float dy);

}  // namespace glimt
