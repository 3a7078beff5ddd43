#include "scene/fields.h"
#include "viewer/field_widgets.h"
#include "viewer/panels.h"
#include "viewer/widgets.h"

namespace glimt {

void draw_settings_panel(const ViewerState& state, Edits& edits) {
  heading("Sampling");
  Settings settings = state.scene.render;
  bool changed = false;
  for (const auto& field : settings_fields()) changed |= edit_field(field, settings, "render");
  if (changed) edits.edit(state).render = settings;
}

}  // namespace glimt
