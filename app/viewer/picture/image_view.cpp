#include "viewer/picture/image_view.h"

#include <GL/gl.h>
#include <imgui.h>

#include <bit>
#include <cstdint>
#include <utility>

#include "viewer/picture/shown_image.h"

namespace glimt {

ImageView::~ImageView() {
  if (texture_ != 0) glDeleteTextures(1, &texture_);
}

void ImageView::upload(const Image& image) {
  const auto pixels = to_srgb8(image, display_);
  glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
  if (image.width != width_ || image.height != height_) {
    width_ = image.width;
    height_ = image.height;
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP);
    glTexImage2D(GL_TEXTURE_2D, 0, GL_RGB, width_, height_, 0, GL_RGB, GL_UNSIGNED_BYTE, pixels.data());
  } else {
    glTexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, width_, height_, GL_RGB, GL_UNSIGNED_BYTE, pixels.data());
  }
}

bool ImageView::prepare() {
  if (!frame_) return false;
  glBindTexture(GL_TEXTURE_2D, texture_);
  const auto image = std::exchange(waiting_, nullptr);
  if (image) upload(*image);
  // A preview has fewer pixels than its frame, so it is interpolated.
  const GLint filter = whole_ && width_ == frame_->size.width ? GL_NEAREST : GL_LINEAR;
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, filter);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, filter);
  return image != nullptr;
}

void ImageView::draw(const std::shared_ptr<const Frame>& frame, const Display& display, const Rect& area,
                     const PicturePlace& place) {
  if (!frame) return;
  if (frame != frame_ || display != display_) {
    if (auto image = shown_image(frame, display.view)) {
      frame_ = frame;
      display_ = display;
      waiting_ = std::move(image);
    }
  }
  if (!frame_) return;
  if (texture_ == 0) glGenTextures(1, &texture_);
  whole_ = place.whole;
  const auto& r = place.rect;
  ImDrawList& list = *ImGui::GetBackgroundDrawList();
  list.PushClipRect({area.x, area.y}, {area.x + area.width, area.y + area.height});
  list.AddImage(std::bit_cast<ImTextureID>(static_cast<std::uintptr_t>(texture_)), {r.x, r.y},
                {r.x + r.width, r.y + r.height});
  list.PopClipRect();
}

}  // namespace glimt
