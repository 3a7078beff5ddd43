#include <imgui.h>

#include "viewer/panels.h"
#include "viewer/widgets.h"

namespace glimt {

void draw_actions_panel(const ViewerState& state, Edits& edits) {
  const float gap = ImGui::GetStyle().ItemSpacing.x;
  const float width = (ImGui::GetContentRegionAvail().x - 2 * gap) / 3;
  const auto button = [&](const char* label, const char* name, const char* tip) {
    const bool pressed = ImGui::Button(label, {width, 0});
    note_widget(name);
    tooltip(tip);
    return pressed;
  };
  if (button(state.paused ? "Resume##pause" : "Pause##pause", "pause",
             "Stop rendering for now, or go on. Key: space")) {
    edits.toggle_pause = true;
  }
  ImGui::SameLine();
  if (button("Restart", "restart", "Begin again at zero samples. Key: R")) edits.restart = true;
  ImGui::SameLine();
  if (button("Snapshot", "snapshot",
             "Save the picture, with the scene that made it inside, as a new PNG in the current folder. Key: S")) {
    edits.snapshot = true;
  }
}

}  // namespace glimt
