#include <imgui.h>

#include "viewer/panels/panels.h"
#include "viewer/widgets/widgets.h"

namespace glimt {

void draw_actions_panel(const ViewerState& state, Edits& edits) {
  ButtonRow row(4);
  edits.toggle_pause |= row.button(state.paused ? "Resume##pause" : "Pause##pause", "pause",
                                   "Stop rendering for now, or go on. Key: space");
  edits.restart |= row.button("Restart", "restart", "Begin again at zero samples. Key: R");
  edits.undo |=
      row.button("Undo", "undo", "Take back the last edit. Its samples come back too. Key: Ctrl+Z", state.can_undo);
  edits.redo |= row.button("Redo", "redo", "Do again what was undone. Key: Ctrl+Y", state.can_redo);
  if (row.button("Open\u2026", "open",
                 "A scene file, or a picture that holds its scene. Key: Ctrl+O. Both can "
                 "also be dropped into the window"))
    edits.choose_file = FilePurpose::open;
  if (row.button("Save\u2026", "save", "The scene as a file. Key: Ctrl+S")) edits.choose_file = FilePurpose::save;
  edits.snapshot |=
      row.button("PNG", "snapshot",
                 "Save the picture as it is shown, with the scene that made it inside, as a new file in the "
                 "current folder. Key: S");
  edits.snapshot_exr |=
      row.button("EXR", "snapshot_exr",
                 "Save linear radiance and its standard error, with the scene that made them inside, as "
                 "a new file in the current folder. Key: Shift+S");
}

}  // namespace glimt
