#include <imgui.h>

#include <algorithm>
#include <string>

#include "scene/fields.h"
#include "viewer/panels/panels.h"
#include "viewer/state/edit.h"
#include "viewer/widgets/field_widgets.h"
#include "viewer/widgets/labels.h"
#include "viewer/widgets/widgets.h"

namespace glimt {
namespace {

constexpr double smallest_lamp = 1e-3;  ///< metres

}  // namespace

void draw_lamp_panel(const ViewerState& state, Edits& edits) {
  const auto lamps = lamps_of(state.scene);
  if (lamps.empty()) {
    muted_text("The scene has no lamp. Any object becomes one when its material is Light.");
    return;
  }
  for (const ObjectId& lamp : lamps) {
    const std::string name = display_name(state.scene, lamp), path = "lamp." + name;
    heading(label_of(name).c_str());
    Material material = *find_material(state.scene, material_name_of(state.scene, lamp));
    bool changed = false;
    for (const auto& field : material_info(material.type).fields) changed |= edit_field(field, material, path);
    if (changed) set_material(edits.edit(state), lamp, material);

    const double before = size_of(state.scene, lamp);
    double size = before;
    const FieldText text{.name = path + ".size",
                         .key = "size",
                         .doc = "largest extent, metres; the lamp grows about its middle",
                         .min = smallest_lamp,
                         .max = max_coordinate};
    if (edit_value(text, size)) scale(edits.edit(state), lamp, size / before);
  }
}

}  // namespace glimt
