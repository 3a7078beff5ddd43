#include "viewer/layout.h"

#include <algorithm>
#include <cmath>

namespace glimt {

Layout make_layout(float width, float height, float scale) {
  const float column = std::min(320 * scale, width / 2);
  const float status = std::min(28 * scale, height / 4);
  Layout layout;
  layout.image = {0, 0, width - column, height - status};
  layout.status = {0, height - status, width - column, status};
  layout.column = {width - column, 0, column, height};
  return layout;
}

Placement place_image(int image_width, int image_height, const Rect& area, float ratio) {
  const auto w = static_cast<float>(image_width), h = static_cast<float>(image_height);
  Placement place;
  place.zoom = std::min(area.width * ratio / w, area.height * ratio / h);
  const float whole = std::floor(place.zoom);
  if (whole >= 1 && whole > 0.9F * place.zoom) place.zoom = whole;
  place.whole = place.zoom == whole;

  place.rect.width = w * place.zoom / ratio;
  place.rect.height = h * place.zoom / ratio;
  place.rect.x = std::round((area.x + (area.width - place.rect.width) / 2) * ratio) / ratio;
  place.rect.y = std::round((area.y + (area.height - place.rect.height) / 2) * ratio) / ratio;
  return place;
}

}  // namespace glimt
