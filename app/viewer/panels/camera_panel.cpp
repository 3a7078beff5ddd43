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
  ImGui::BeginDisabled(camera == state.opened_camera);
  if (ImGui::Button("Reset", {-FLT_MIN, 0})) {
    camera = state.opened_camera;
    changed = true;
  }
  ImGui::EndDisabled();
  note_widget("camera.reset");
  tooltip("Back to the camera of the scene as it was opened. Key: Home");
  if (changed) edits.edit(state).camera = camera;
  muted_text("In the picture: drag to look around what is under the mouse, shift+drag to move, scroll to come closer.");
}

}  // namespace glimt
