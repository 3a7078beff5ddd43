#include <imgui.h>

#include <string>

#include "scene/fields.h"
#include "viewer/edit.h"
#include "viewer/field_widgets.h"
#include "viewer/labels.h"
#include "viewer/panels.h"
#include "viewer/style.h"
#include "viewer/widgets.h"

namespace glimt {
namespace {

/// The menu of material types.
bool edit_type(Material& material, const std::string& name) {
  const MaterialType before = material.type;
  ImGui::SetNextItemWidth(-FLT_MIN);
  const bool open =
      ImGui::BeginCombo("##type", label_of(material_info(before).name).c_str(), ImGuiComboFlags_HeightLargest);
  note_widget(name);
  if (!open) {
    tooltip(sentence(material_info(before).doc));
    return false;
  }
  for (const auto& info : material_infos()) {
    if (ImGui::Selectable(label_of(info.name).c_str(), info.type == before)) material.type = info.type;
    note_widget(name + "." + std::string(info.name));
    tooltip(sentence(info.doc));
  }
  ImGui::EndCombo();
  return material.type != before;
}

/// One sphere: a row with its name and menu, and below it, where opened, the parameters of the type.
bool edit_sphere(const std::string& name, const std::string& path, Material& material) {
  // Closed until asked for, except where the type has the knob that the scene is about.
  const bool opened_at_first = material.type == MaterialType::oren_nayar;
  ImGui::AlignTextToFramePadding();
  ImGui::SetNextItemOpen(opened_at_first, ImGuiCond_FirstUseEver);
  constexpr auto flags = ImGuiTreeNodeFlags_NoTreePushOnOpen | ImGuiTreeNodeFlags_FramePadding;
  const std::string label = fit_text(name, style::scaled(100)) + "###parameters";
  const ImGuiID node = ImGui::GetID("###parameters");
  ImGui::PushStyleVar(ImGuiStyleVar_FramePadding, {0, ImGui::GetStyle().FramePadding.y});
  const bool open = ImGui::TreeNodeEx(label.c_str(), flags);
  ImGui::PopStyleVar();
  note_widget(path);
  tooltip(name);
  ImGui::SameLine(row_split());

  bool changed = false;
  if (edit_type(material, path + ".material")) {
    changed = true;
    ImGui::GetStateStorage()->SetInt(node, 1);
  }
  if (!open) return changed;
  ImGui::Indent(ImGui::GetFontSize());
  for (const auto& field : material_info(material.type).fields)
    changed |= edit_field(field, material, path + ".material");
  ImGui::Unindent(ImGui::GetFontSize());
  return changed;
}

}  // namespace

void draw_spheres_panel(const ViewerState& state, Edits& edits) {
  const auto& spheres = state.scene.spheres;
  if (spheres.empty()) return;
  heading("Spheres");
  for (std::size_t i = 0; i < spheres.size(); ++i) {
    const Material* material = find_material(state.scene, spheres[i].material);
    if (material == nullptr) continue;
    const std::string name = spheres[i].name.empty() ? std::to_string(i) : spheres[i].name;
    Material edited = *material;
    ImGui::PushID(static_cast<int>(i));
    const bool changed = edit_sphere(label_of(name), "sphere." + name, edited);
    ImGui::PopID();
    if (changed) set_sphere_material(edits.edit(state), i, edited);
  }
}

}  // namespace glimt
