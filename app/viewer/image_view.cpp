#include "viewer/image_view.h"

#include <GL/gl.h>
#include <imgui.h>

#include <bit>
#include <cstdint>

namespace glimt {

ImageView::~ImageView() {
  if (texture_ != 0) glDeleteTextures(1, &texture_);
}

void ImageView::upload(const Image& image) {
  const auto pixels = to_srgb8(image, display_);
  if (texture_ == 0) glGenTextures(1, &texture_);
  glBindTexture(GL_TEXTURE_2D, texture_);
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

Placement ImageView::draw(const std::shared_ptr<const Frame>& frame, const Display& display, const Rect& area,
                          float ratio) {
  if (!frame) return {};
  if (frame != frame_ || display != display_) {
    frame_ = frame;
    display_ = display;
    upload(frame->mean);
  }
  const Placement place = place_image(width_, height_, area, ratio);
  const GLint filter = place.whole ? GL_NEAREST : GL_LINEAR;
  glBindTexture(GL_TEXTURE_2D, texture_);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, filter);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, filter);
  const auto& r = place.rect;
  ImGui::GetBackgroundDrawList()->AddImage(std::bit_cast<ImTextureID>(static_cast<std::uintptr_t>(texture_)),
                                           {r.x, r.y}, {r.x + r.width, r.y + r.height});
  return place;
}

}  // namespace glimt
