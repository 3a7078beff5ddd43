#include <imgui.h>

#include "viewer/panels.h"
#include "viewer/widgets.h"

namespace glimt {

void draw_display_panel(const ViewerState& state, Edits& edits) {
  double exposure = state.display.exposure;
  begin_row("Exposure",
            "Brightness of the picture: 1 EV more is twice as bright. Only the display changes, rendering goes on.\n"
            "Drag, or Ctrl+click to type a number.");
  ImGui::PushID("exposure");
  if (slider(exposure, -8, 8, "%+.1f EV")) edits.display = Display{.exposure = exposure};
  note_widget("exposure");
  ImGui::PopID();
}

}  // namespace glimt
