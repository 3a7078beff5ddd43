#pragma once

namespace glimt {

/// A rectangle in window coordinates, y down.
struct Rect {
  float x = 0, y = 0, width = 0, height = 0;
};

/// The parts of the window, which touch and do not overlap.
struct Layout {
  Rect image;   ///< space for the picture
  Rect status;  ///< one line below it
  Rect column;  ///< the controls, at the right
  Rect chart;   ///< empty where it is not shown
};

/// The layout without the chart. `scale` is 1 on an ordinary screen and 2 where everything should be twice as large.
Layout make_layout(float width, float height, float scale);

/// The same, with part of the picture's space for the chart: below or beside the picture, whichever leaves it larger.
Layout with_chart(const Layout& layout, int image_width, int image_height, float scale);

bool is_inside(const Rect& rect, float x, float y);

/// Where a picture is drawn.
struct PicturePlace {
  Rect rect;
  float zoom = 1;      ///< framebuffer pixels per picture pixel
  bool whole = false;  ///< the zoom is a whole number
};

/// Places the picture as large as fits, centred, with its corner on a whole framebuffer pixel. The zoom is rounded down
/// to a whole number where that costs less than a tenth. `ratio` is framebuffer pixels per window coordinate.
PicturePlace place_image(int image_width, int image_height, const Rect& area, float ratio);

/// The magnification, and which place of the picture is in the middle.
struct Zoom {
  float zoom = 0;            ///< framebuffer pixels per picture pixel; 0: the picture as large as fits
  float x = 0.5F, y = 0.5F;  ///< the place of the picture, 0..1, in the middle of the space for it
};

/// Places the picture as `zoom` asks, but moved so that it leaves no space empty which it could fill.
PicturePlace place_image(int image_width, int image_height, const Rect& area, float ratio, const Zoom& zoom);

/// Another magnification; the place of the picture under the window point (x, y) stays there.
Zoom zoomed(const PicturePlace& place, const Rect& area, float zoom, float x, float y);
/// The picture moved by (dx, dy), window coordinates.
Zoom moved(const PicturePlace& place, const Rect& area, float dx, float dy);

}  // namespace glimt
