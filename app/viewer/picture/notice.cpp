#include "viewer/picture/notice.h"

#include <imgui.h>

#include "viewer/widgets/style.h"
#include "viewer/widgets/widgets.h"

namespace glimt {

namespace {

/// Over the upper part of the picture, as wide as what it says.
void begin_notice(const Rect& area) {
  ImGui::SetNextWindowPos({area.x + area.width / 2, area.y + style::scaled(16)}, ImGuiCond_Always, {0.5F, 0});
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {style::scaled(16), style::scaled(10)});
  ImGui::PushStyleVar(ImGuiStyleVar_WindowRounding, style::scaled(8));
  ImGui::PushStyleColor(ImGuiCol_WindowBg, style::sheet);
  ImGui::Begin("notice", nullptr,
               ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoSavedSettings |
                   ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoFocusOnAppearing);
  ImGui::PopStyleColor();
  ImGui::PopStyleVar(2);
}

void draw_left_behind(const LeftBehind& left, const Rect& area, Edits& edits) {
  begin_notice(area);
  ImGui::TextUnformatted("The last window ended without being closed.");
  note_widget("notice");
  ImGui::Text("It had %d samples per pixel of \"%s\".", left.samples, left.scene.c_str());
  if (ImGui::Button("Go on with it")) edits.recover = true;
  note_widget("notice.recover");
  ImGui::SameLine();
  if (ImGui::Button("Forget it")) edits.forget_left_behind = true;
  note_widget("notice.forget");
  ImGui::End();
}

}  // namespace

void draw_notice(const ViewerState& state, const Rect& area, Edits& edits) {
  if (state.left_behind) {
    draw_left_behind(*state.left_behind, area, edits);
    return;
  }
  const bool shown = state.frame && state.frame->version >= state.version;
  const bool outside = state.compiled->camera_outside;
  if (!outside && !(shown && state.black)) return;
  begin_notice(area);
  ImGui::TextUnformatted(outside ? "The camera is outside the room." : "No light reaches the camera here.");
  note_widget("notice");
  if (ImGui::Button("Bring it back")) edits.edit(state).camera = back_in_room(state.scene, state.opened_camera);
  note_widget("notice.back");
  tooltip("To the camera of the scene as it was opened, or into the middle of the room");
  if (outside) {
    ImGui::SameLine();
    if (ImGui::Button("Outside view")) edits.edit(state).camera.cutaway = Cutaway::on;
    note_widget("notice.cutaway");
    tooltip("Looks through walls that turn their back to the camera");
  }
  ImGui::End();
}

}  // namespace glimt
