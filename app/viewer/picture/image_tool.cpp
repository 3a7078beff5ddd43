#include "viewer/picture/image_tool.h"

#include <imgui.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "scene/camera_view.h"
#include "viewer/state/camera_moves.h"
#include "viewer/widgets/style.h"

namespace glimt {
namespace {

constexpr double dolly_step = 0.9;                   ///< distance after a notch of the wheel over the one before
constexpr float zoom_step = 1.25F;                   ///< of the picture, a notch
constexpr float least_zoom = 0.05F, most_zoom = 64;  ///< framebuffer pixels per picture pixel

/// A place of the window in pixels of the image.
glm::dvec2 image_place(const ViewerState& state, const Placement& place, const ImVec2& p) {
  const Rect& r = place.rect;
  return {(p.x - r.x) / r.width * static_cast<float>(state.scene.image.width),
          (p.y - r.y) / r.height * static_cast<float>(state.scene.image.height)};
}

}  // namespace

void ImageTool::take_mouse(const ViewerState& state, const Rect& area, const Placement& place, Edits& edits) {
  const ImGuiIO& io = ImGui::GetIO();
  const bool free = !io.WantCaptureMouse && state.frame && is_inside(area, io.MousePos.x, io.MousePos.y);
  const bool left = ImGui::IsMouseClicked(ImGuiMouseButton_Left),
             middle = ImGui::IsMouseClicked(ImGuiMouseButton_Middle);
  if (free && (left || middle) && drag_ == Drag::none) {
    press(state, image_place(state, place, io.MousePos));
    drag_ = io.KeyCtrl ? Drag::picture : middle || io.KeyShift ? Drag::pan : Drag::undecided;
  }
  if (drag_ == Drag::undecided && ImGui::IsMouseDragging(ImGuiMouseButton_Left, style::scaled(4))) {
    drag_ = under_ && under_ == state.selected && under_->kind == ObjectKind::sphere ? Drag::sphere : Drag::orbit;
  }
  if (drag_ == Drag::undecided && ImGui::IsMouseReleased(ImGuiMouseButton_Left)) edits.select = under_;
  if (!io.MouseDown[ImGuiMouseButton_Left] && !io.MouseDown[ImGuiMouseButton_Middle]) drag_ = Drag::none;
  if (drag_ != Drag::none && drag_ != Drag::undecided && (io.MouseDelta.x != 0 || io.MouseDelta.y != 0)) {
    drag(state, area, place, edits);
  }
  if (free && io.MouseWheel != 0) scroll(state, area, place, edits);
  if (drag_ == Drag::pan || drag_ == Drag::picture || drag_ == Drag::sphere)
    ImGui::SetMouseCursor(ImGuiMouseCursor_ResizeAll);
}

void ImageTool::press(const ViewerState& state, const glm::dvec2& in_image) {
  const CameraView view(state.scene.camera, state.scene.image);
  const glm::dvec3 direction = view.direction(in_image);
  const auto first = pick(state.scene, {view.eye, direction});
  under_ = first ? std::optional(first->object) : std::nullopt;
  grip_ = first ? view.eye + direction * first->distance : state.scene.camera.look_at;
}

void ImageTool::drag(const ViewerState& state, const Rect& area, const Placement& place, Edits& edits) {
  const ImVec2 by = ImGui::GetIO().MouseDelta;
  const Camera& camera = state.scene.camera;
  if (drag_ == Drag::picture) {
    zoom_ = moved(place, area, by.x, by.y);
    return;
  }
  if (drag_ == Drag::orbit) {
    // Once across the picture's height is half a turn.
    const double angle = std::numbers::pi / std::min(place.rect.height, area.height);
    edits.edit(state).camera = orbit(camera, grip_, -by.x * angle, -by.y * angle);
    return;
  }
  // So far that the point which was taken hold of stays under the mouse.
  const CameraView view(camera, state.scene.image);
  const double metres = view.depth(grip_) * view.pixel * state.scene.image.height / place.rect.height;
  const glm::dvec3 step = (view.right * static_cast<double>(by.x) - view.up * static_cast<double>(by.y)) * metres;
  if (drag_ == Drag::pan) {
    edits.edit(state).camera = pan(camera, -step);
  } else if (contains(state.scene, *under_)) {
    edits.edit(state).spheres[under_->index].center += step;
    grip_ += step;
  }
}

void ImageTool::scroll(const ViewerState& state, const Rect& area, const Placement& place, Edits& edits) {
  const ImGuiIO& io = ImGui::GetIO();
  if (io.KeyCtrl) {
    const float zoom = std::clamp(place.zoom * std::pow(zoom_step, io.MouseWheel), least_zoom, most_zoom);
    zoom_ = zoomed(place, area, zoom, io.MousePos.x, io.MousePos.y);
  } else {
    edits.edit(state).camera = dolly(state.scene.camera, std::pow(dolly_step, io.MouseWheel));
  }
}

void ImageTool::draw_outline(const ViewerState& state, const Rect& area, const Placement& place) {
  if (!state.selected || !state.frame) return;
  if (outlined_ != state.selected || outlined_version_ != state.version) {
    outline_ = outline_of(state.scene, *state.selected);
    outlined_ = state.selected;
    outlined_version_ = state.version;
  }
  const float scale = place.rect.width / static_cast<float>(state.scene.image.width);
  const auto at = [&](const glm::dvec2& p) {
    return ImVec2(place.rect.x + static_cast<float>(p.x) * scale, place.rect.y + static_cast<float>(p.y) * scale);
  };
  ImDrawList& list = *ImGui::GetBackgroundDrawList();
  const float right = std::min(area.x + area.width, place.rect.x + place.rect.width);
  const float bottom = std::min(area.y + area.height, place.rect.y + place.rect.height);
  list.PushClipRect({std::max(area.x, place.rect.x), std::max(area.y, place.rect.y)}, {right, bottom});
  for (const bool shadow : {true, false}) {
    for (const OutlinePiece& piece : outline_) {
      const ImU32 colour = piece.hidden ? style::outline_hidden : shadow ? style::outline_shadow : style::outline;
      if (shadow && piece.hidden) continue;
      list.AddLine(at(piece.from), at(piece.to), colour, style::scaled(shadow ? 4 : piece.hidden ? 1 : 2));
    }
  }
  list.PopClipRect();
}

}  // namespace glimt
