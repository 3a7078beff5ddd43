#include <imgui.h>

#include "scene/fields.h"
#include "viewer/panels/panels.h"
#include "viewer/widgets/field_widgets.h"
#include "viewer/widgets/widgets.h"

namespace glimt {

void draw_camera_panel(const ViewerState& state, Edits& edits) {
  Camera camera = state.scene.camera;
  bool changed = false;
  for (const auto& field : camera_fields()) changed |= edit_field(field, camera, "camera");
  int drag_view = static_cast<int>(state.drag_view);
  if (edit_choice({"camera.drag", "drag",
                   "a drag over the picture turns the view about the eye, or orbits what is "
                   "under the mouse; auto turns in a closed room. Alt+drag does the other"},
                  drag_view_names, drag_view))
    edits.drag_view = static_cast<DragView>(drag_view);
  ImGui::BeginDisabled(camera == state.opened_camera);
  if (ImGui::Button("Reset", {-FLT_MIN, 0})) {
    camera = state.opened_camera;
    changed = true;
  }
  ImGui::EndDisabled();
  note_widget("camera.reset");
  tooltip("Back to the camera of the scene as it was opened. Key: Home");
  if (changed) edits.edit(state).camera = camera;
  muted_text(std::string("In the picture: drag to ") +
             (drag_turns(state) ? "turn the view, alt+drag to look around what is under the mouse"
                                : "look around what is under the mouse, alt+drag to turn the view") +
             ", shift+drag to move, scroll to come closer. Hold the right button to fly with W A S D.");
}

}  // namespace glimt
