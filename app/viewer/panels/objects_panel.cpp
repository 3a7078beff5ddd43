#include <imgui.h>

#include <algorithm>
#include <string>
#include <utility>

#include "scene/fields.h"
#include "viewer/panels/panels.h"
#include "viewer/state/edit.h"
#include "viewer/widgets/field_widgets.h"
#include "viewer/widgets/labels.h"
#include "viewer/widgets/style.h"
#include "viewer/widgets/widgets.h"

namespace glimt {
namespace {

constexpr int most_rows = 7;

const Material& material_of(const Scene& scene, const ObjectId& object) {
  return *find_material(scene, material_name_of(scene, object));
}

/// A list of all objects with their materials.
void draw_list(const ViewerState& state, Edits& edits) {
  const auto all = objects_of(state.scene);
  const int rows = std::min(static_cast<int>(all.size()), most_rows);
  constexpr float padding = 5;
  const float height = static_cast<float>(rows) * ImGui::GetTextLineHeightWithSpacing() -
                       ImGui::GetStyle().ItemSpacing.y + style::scaled(2 * padding);
  ImGui::PushStyleColor(ImGuiCol_ChildBg, style::well);
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {style::scaled(8), style::scaled(padding)});
  ImGui::BeginChild("objects", {0, height}, false, ImGuiWindowFlags_AlwaysUseWindowPadding);
  int& scrolled_to = *ImGui::GetStateStorage()->GetIntRef(ImGui::GetID("scrolled to"), -1);
  for (const ObjectId& object : all) {
    const std::string name = display_name(state.scene, object);
    const bool selected = state.selected == object;
    const int row = static_cast<int>(&object - all.data());
    ImGui::PushID(row);
    const std::string type = label_of(material_info(material_of(state.scene, object).type).name);
    const float type_width = ImGui::CalcTextSize(type.c_str()).x;
    const float width = ImGui::GetContentRegionAvail().x;
    const ImVec2 at = ImGui::GetCursorPos();
    if (ImGui::Selectable("##object", selected)) edits.select = selected ? std::nullopt : std::optional(object);
    if (ImGui::IsItemVisible()) note_widget("object." + name);
    if (selected && std::exchange(scrolled_to, row) != row) ImGui::SetScrollHereY();
    ImGui::SetCursorPos(at);
    ImGui::TextUnformatted(fit_text(label_of(name), width - type_width - style::scaled(12)).c_str());
    ImGui::SameLine(at.x + width - type_width);
    ImGui::TextDisabled("%s", type.c_str());
    ImGui::PopID();
  }
  ImGui::EndChild();
  ImGui::PopStyleVar();
  ImGui::PopStyleColor();
}

/// The menu of material types. Types that the object cannot have are greyed, with the reason.
bool edit_type(const Scene& scene, const ObjectId& object, Material& material) {
  const std::string before = material.type;
  begin_row("Material", "What the object is made of. One that shared its material gets one of its own.");
  const bool open =
      ImGui::BeginCombo("##type", label_of(material_info(before).name).c_str(), ImGuiComboFlags_HeightLargest);
  note_widget("object.type");
  if (!open) return false;
  for (const auto& info : material_infos()) {
    const std::string obstacle = info.name == before ? "" : obstacle_to(scene, object, info.name);
    const auto flags = obstacle.empty() ? ImGuiSelectableFlags_None : ImGuiSelectableFlags_Disabled;
    if (ImGui::Selectable(label_of(info.name).c_str(), info.name == before, flags)) material.type = info.name;
    note_widget("object.type." + std::string(info.name));
    tooltip(obstacle.empty() ? sentence(info.doc) : "Not here: " + obstacle);
  }
  ImGui::EndCombo();
  return material.type != before;
}

}  // namespace

void draw_objects_panel(const ViewerState& state, Edits& edits) {
  draw_list(state, edits);
  if (!state.selected) {
    muted_text("Click an object here or in the picture to change it.");
    return;
  }
  const ObjectId object = *state.selected;
  heading(label_of(display_name(state.scene, object)).c_str());
  Material material = material_of(state.scene, object);
  bool changed = edit_type(state.scene, object, material);
  for (const auto& field : material_info(material.type).fields) changed |= edit_field(field, material, "object");
  if (changed) set_material(edits.edit(state), object, material);

  if (object.kind != ObjectKind::sphere) return;
  Sphere sphere = state.scene.spheres[object.index];
  bool moved = false;
  for (const auto& field : sphere_fields()) moved |= edit_field(field, sphere, "object");
  if (moved) {
    Sphere& edited = edits.edit(state).spheres[object.index];
    edited.center = sphere.center;
    edited.radius = sphere.radius;
  }
}

}  // namespace glimt
