#include <imgui.h>

#include "viewer/panels.h"
#include "viewer/widgets.h"

namespace glimt {

void draw_actions_panel(const ViewerState& state, Edits& edits, Requests& requests) {
  constexpr int columns = 4;
  const float gap = ImGui::GetStyle().ItemSpacing.x;
  const float width = (ImGui::GetContentRegionAvail().x - (columns - 1) * gap) / columns;
  int count = 0;
  const auto button = [&](const char* label, const char* name, const char* tip, bool enabled = true) {
    if (count++ % columns != 0) ImGui::SameLine();
    ImGui::BeginDisabled(!enabled);
    const bool pressed = ImGui::Button(label, {width, 0});
    ImGui::EndDisabled();
    note_widget(name);
    tooltip(tip);
    return pressed;
  };
  edits.toggle_pause |=
      button(state.paused ? "Resume##pause" : "Pause##pause", "pause", "Stop rendering for now, or go on. Key: space");
  edits.restart |= button("Restart", "restart", "Begin again at zero samples. Key: R");
  edits.undo |=
      button("Undo", "undo", "Take back the last edit. Its samples come back too. Key: Ctrl+Z", state.can_undo);
  edits.redo |= button("Redo", "redo", "Do again what was undone. Key: Ctrl+Y", state.can_redo);
  requests.open |= button("Open\u2026", "open",
                          "A scene file, or a picture that holds its scene. Key: Ctrl+O. Both can "
                          "also be dropped into the window");
  requests.save |= button("Save\u2026", "save", "The scene as a file. Key: Ctrl+S");
  edits.snapshot |= button("PNG", "snapshot",
                           "Save the picture as it is shown, with the scene that made it inside, as a new file in the "
                           "current folder. Key: S");
  edits.snapshot_exr |= button("EXR", "snapshot_exr",
                               "Save linear radiance and its standard error, with the scene that made them inside, as "
                               "a new file in the current folder. Key: Shift+S");
}

}  // namespace glimt
