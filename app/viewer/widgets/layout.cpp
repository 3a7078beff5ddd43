#include "viewer/widgets/layout.h"

#include <algorithm>
#include <cmath>

namespace glimt {

Layout make_layout(float width, float height, float scale) {
  const float column = std::min(352 * scale, width / 2);
  const float status = std::min(28 * scale, height / 4);
  Layout layout;
  layout.image = {0, 0, width - column, height - status};
  layout.status = {0, height - status, width - column, status};
  layout.column = {width - column, 0, column, height};
  return layout;
}

Layout with_chart(const Layout& layout, int image_width, int image_height, float scale) {
  Layout below = layout, beside = layout;
  const Rect& free = layout.image;
  const float height = std::min(304 * scale, free.height / 2), width = std::min(440 * scale, free.width / 2);
  below.image.height -= height;
  below.chart = {free.x, free.y + below.image.height, free.width, height};
  beside.image.width -= width;
  beside.chart = {free.x + beside.image.width, free.y, width, free.height};
  const auto zoom = [&](const Rect& r) {
    return std::min(r.width / static_cast<float>(image_width), r.height / static_cast<float>(image_height));
  };
  return zoom(beside.image) > zoom(below.image) ? beside : below;
}

bool is_inside(const Rect& rect, float x, float y) {
  return x >= rect.x && y >= rect.y && x < rect.x + rect.width && y < rect.y + rect.height;
}

PicturePlace place_image(int image_width, int image_height, const Rect& area, float ratio) {
  const auto w = static_cast<float>(image_width), h = static_cast<float>(image_height);
  PicturePlace place;
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

namespace {

/// Along one axis: the place of the picture in the middle of the space, limited so that no space stays empty
/// needlessly.
float clamped(float share, float free, float picture) {
  const float half = 0.5F * free / picture;
  return half >= 0.5F ? 0.5F : std::clamp(share, half, 1 - half);
}

Zoom looking_at(const Rect& picture, const Rect& area, float zoom) {
  return {zoom, (area.x + area.width / 2 - picture.x) / picture.width,
          (area.y + area.height / 2 - picture.y) / picture.height};
}

}  // namespace

PicturePlace place_image(int image_width, int image_height, const Rect& area, float ratio, const Zoom& zoom) {
  if (zoom.zoom == 0) return place_image(image_width, image_height, area, ratio);
  PicturePlace place;
  place.zoom = zoom.zoom;
  place.whole = place.zoom == std::floor(place.zoom);
  place.rect.width = static_cast<float>(image_width) * place.zoom / ratio;
  place.rect.height = static_cast<float>(image_height) * place.zoom / ratio;
  const float x = clamped(zoom.x, area.width, place.rect.width), y = clamped(zoom.y, area.height, place.rect.height);
  place.rect.x = std::round((area.x + area.width / 2 - x * place.rect.width) * ratio) / ratio;
  place.rect.y = std::round((area.y + area.height / 2 - y * place.rect.height) * ratio) / ratio;
  return place;
}

Zoom zoomed(const PicturePlace& place, const Rect& area, float zoom, float x, float y) {
  const float factor = zoom / place.zoom;
  Rect picture = place.rect;
  picture.x = x + (picture.x - x) * factor;
  picture.y = y + (picture.y - y) * factor;
  picture.width *= factor;
  picture.height *= factor;
  return looking_at(picture, area, zoom);
}

Zoom moved(const PicturePlace& place, const Rect& area, float dx, float dy) {
  Rect picture = place.rect;
  picture.x += dx;
  picture.y += dy;
  return looking_at(picture, area, place.zoom);
}

}  // namespace glimt
