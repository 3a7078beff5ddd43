#include "viewer/picture/image_tool.h"

#include <imgui.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "scene/camera_view.h"
#include "scene/surroundings.h"
#include "viewer/state/camera_moves.h"
#include "viewer/widgets/style.h"

namespace glimt {
namespace {

constexpr double dolly_step = 0.9;                   ///< factor of the distance for one notch of the wheel
constexpr double pace_step = 1.25;                   ///< factor of the flight's speed for one notch
constexpr double least_pace = 1e-4, most_pace = 10;  ///< sizes of the scene per second
constexpr float longest_picture = 0.1F;              ///< longest time step of a flight, seconds
constexpr float zoom_step = 1.25F;                   ///< factor of the picture's zoom for one notch
constexpr float least_zoom = 0.05F, most_zoom = 64;  ///< framebuffer pixels per picture pixel

/// A point of the window in pixels of the image.
glm::dvec2 image_place(const ViewerState& state, const PicturePlace& place, const ImVec2& p) {
  const Rect& r = place.rect;
  return {(p.x - r.x) / r.width * static_cast<float>(state.scene.image.width),
          (p.y - r.y) / r.height * static_cast<float>(state.scene.image.height)};
}

}  // namespace

void ImageTool::take_mouse(const ViewerState& state, const Rect& area, const PicturePlace& place, Edits& edits) {
  const ImGuiIO& io = ImGui::GetIO();
  const bool free = !io.WantCaptureMouse && state.frame && is_inside(area, io.MousePos.x, io.MousePos.y);
  const bool left = ImGui::IsMouseClicked(ImGuiMouseButton_Left),
             middle = ImGui::IsMouseClicked(ImGuiMouseButton_Middle),
             right = ImGui::IsMouseClicked(ImGuiMouseButton_Right);
  if (free && (left || middle || right) && drag_ == Drag::none) {
    press(state, image_place(state, place, io.MousePos));
    other_view_ = io.KeyAlt;
    begin(right ? Drag::fly : io.KeyCtrl ? Drag::picture : middle || io.KeyShift ? Drag::pan : Drag::undecided);
  }
  if (drag_ == Drag::undecided && ImGui::IsMouseDragging(ImGuiMouseButton_Left, style::scaled(4))) {
    const bool sphere = under_ && under_ == state.selected && under_->kind == ObjectKind::sphere;
    begin(sphere ? Drag::sphere : drag_turns(state) != other_view_ ? Drag::turn : Drag::orbit);
  }
  if (drag_ == Drag::undecided && ImGui::IsMouseReleased(ImGuiMouseButton_Left)) edits.select = under_;
  if (!io.MouseDown[ImGuiMouseButton_Left] && !io.MouseDown[ImGuiMouseButton_Middle] &&
      !io.MouseDown[ImGuiMouseButton_Right])
    begin(Drag::none);
  if (drag_ != Drag::none && drag_ != Drag::undecided && (io.MouseDelta.x != 0 || io.MouseDelta.y != 0)) {
    drag(state, area, place, edits);
  }
  if ((free || flying()) && io.MouseWheel != 0) scroll(state, area, place, edits);
  if (flying()) fly(state, edits);
  if (drag_ == Drag::pan || drag_ == Drag::picture || drag_ == Drag::sphere)
    ImGui::SetMouseCursor(ImGuiMouseCursor_ResizeAll);
}

void ImageTool::begin(Drag drag) {
  drag_ = drag;
  // Arrow keys either move the camera or go from control to control.
  ImGuiConfigFlags& flags = ImGui::GetIO().ConfigFlags;
  if (flying() && (flags & ImGuiConfigFlags_NavEnableKeyboard) != 0) {
    flags &= ~ImGuiConfigFlags_NavEnableKeyboard;
    navigates_ = true;
  } else if (!flying() && navigates_) {
    flags |= ImGuiConfigFlags_NavEnableKeyboard;
    navigates_ = false;
  }
}

double ImageTool::speed(const ViewerState& state) const { return pace_ * size_of(state.scene); }

void ImageTool::fly(const ViewerState& state, Edits& edits) const {
  const auto key = [](int letter, ImGuiKey arrow) {
    return ImGui::IsKeyDown(letter) || ImGui::IsKeyDown(ImGui::GetKeyIndex(arrow)) ? 1.0 : 0.0;
  };
  const Camera& camera = edits.edit(state).camera;
  const CameraView view(camera, state.scene.image);
  const glm::dvec3 way = view.forward * (key('W', ImGuiKey_UpArrow) - key('S', ImGuiKey_DownArrow)) +
                         view.right * (key('D', ImGuiKey_RightArrow) - key('A', ImGuiKey_LeftArrow)) +
                         normalize(camera.up) * (key('E', ImGuiKey_PageUp) - key('Q', ImGuiKey_PageDown));
  if (way == glm::dvec3{0}) return;
  const double seconds = std::min(ImGui::GetIO().DeltaTime, longest_picture);
  Scene& scene = edits.edit(state);
  scene.camera = approach(scene, pan(scene.camera, normalize(way) * (speed(state) * seconds)));
}

void ImageTool::press(const ViewerState& state, const glm::dvec2& in_image) {
  const CameraView view(state.scene.camera, state.scene.image);
  const glm::dvec3 direction = view.direction(in_image);
  const auto first = pick_seen(state.scene, {view.eye, direction});
  under_ = first ? std::optional(first->object) : std::nullopt;
  grip_ = first ? view.eye + direction * first->distance : state.scene.camera.look_at;
}

void ImageTool::drag(const ViewerState& state, const Rect& area, const PicturePlace& place, Edits& edits) {
  const ImVec2 by = ImGui::GetIO().MouseDelta;
  const Camera& camera = state.scene.camera;
  if (drag_ == Drag::picture) {
    zoom_ = moved(place, area, by.x, by.y);
    return;
  }
  if (drag_ == Drag::orbit) {
    // A drag across the picture's height is half a turn.
    const double angle = std::numbers::pi / std::min(place.rect.height, area.height);
    edits.edit(state).camera = approach_orbit(state.scene, grip_, -by.x * angle, -by.y * angle);
    return;
  }
  const CameraView view(camera, state.scene.image);
  const double pixel =
      view.pixel * state.scene.image.height / place.rect.height;  // size of a window pixel at distance 1
  if (drag_ == Drag::turn || flying()) {
    // A drag moves the picture with the mouse. In flight the view turns towards the mouse instead.
    const double angle = flying() ? -pixel : pixel;
    edits.edit(state).camera = approach_orbit(state.scene, camera.eye, by.x * angle, by.y * angle);
    return;
  }
  // The step keeps the point where the button was pressed under the mouse.
  const double metres = view.depth(grip_) * pixel;
  const glm::dvec3 step = (view.right * static_cast<double>(by.x) - view.up * static_cast<double>(by.y)) * metres;
  if (drag_ == Drag::pan) {
    edits.edit(state).camera = approach(state.scene, pan(camera, -step));
  } else if (contains(state.scene, *under_)) {
    Scene& scene = edits.edit(state);
    move_sphere(scene, under_->index, step);
    grip_ += scene.spheres[under_->index].center - state.scene.spheres[under_->index].center;
  }
}

void ImageTool::scroll(const ViewerState& state, const Rect& area, const PicturePlace& place, Edits& edits) {
  const ImGuiIO& io = ImGui::GetIO();
  if (flying()) {
    pace_ = std::clamp(pace_ * std::pow(pace_step, static_cast<double>(io.MouseWheel)), least_pace, most_pace);
  } else if (io.KeyCtrl) {
    const float zoom = std::clamp(place.zoom * std::pow(zoom_step, io.MouseWheel), least_zoom, most_zoom);
    zoom_ = zoomed(place, area, zoom, io.MousePos.x, io.MousePos.y);
  } else {
    const Camera nearer = dolly(state.scene.camera, std::pow(dolly_step, io.MouseWheel));
    edits.edit(state).camera = approach(state.scene, nearer);
  }
}

void ImageTool::draw_outline(const ViewerState& state, const Rect& area, const PicturePlace& place) {
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
