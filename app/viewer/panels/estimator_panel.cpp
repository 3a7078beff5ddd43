#include <imgui.h>

#include <algorithm>
#include <array>
#include <string>

#include "scene/fields.h"
#include "viewer/panels/panels.h"
#include "viewer/widgets/field_widgets.h"
#include "viewer/widgets/labels.h"
#include "viewer/widgets/style.h"
#include "viewer/widgets/widgets.h"

namespace glimt {
namespace {

bool edit_size(ImageSize& size) {
  const int most = static_cast<int>(image_fields()[0].max);
  constexpr std::array<ImageSize, 5> usual{{{400, 400}, {800, 600}, {1024, 1024}, {1280, 720}, {1920, 1080}}};
  begin_row("Image size",
            "Width and height, pixels.\nDrag, or Ctrl+click to type a number; the arrow has usual sizes.");
  ImGui::PushID("size");
  const float arrow = ImGui::GetFrameHeight(), gap = ImGui::GetStyle().ItemInnerSpacing.x;
  ImGui::SetNextItemWidth(ImGui::GetContentRegionAvail().x - arrow - gap);
  std::array<int, 2> sides{size.width, size.height};
  bool changed = ImGui::DragInt2("##value", sides.data(), 2, 1, most, "%d", ImGuiSliderFlags_AlwaysClamp);
  note_widget("image.size");
  if (changed) size = {sides[0], sides[1]};
  ImGui::SameLine(0, gap);
  if (ImGui::BeginCombo("##usual", "", ImGuiComboFlags_NoPreview | ImGuiComboFlags_PopupAlignLeft)) {
    for (const ImageSize& s : usual) {
      if (ImGui::Selectable(size_text(s).c_str(), s == size)) {
        size = s;
        changed = true;
      }
      note_widget("image.size." + std::to_string(s.width) + "x" + std::to_string(s.height));
    }
    ImGui::EndCombo();
  }
  ImGui::PopID();
  return changed;
}

}  // namespace

void draw_estimator_panel(const ViewerState& state, Edits& edits) {
  // So many rows that they stand closer than elsewhere, or a small window would not hold them.
  const ImGuiStyle& style = ImGui::GetStyle();
  ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, {style.ItemSpacing.x, 0.3F * style.ItemSpacing.y});
  ImGui::PushStyleVar(ImGuiStyleVar_FramePadding, {style.FramePadding.x, 0.75F * style.FramePadding.y});
  Settings settings = state.scene.render;
  bool changed = false;
  for (const auto& field : settings_fields()) {
    const bool is_target = field.key == "spp" || field.key == "target_error";
    if (!is_target) changed |= edit_field(field, settings, "render");
  }
  if (changed) edits.edit(state).render = settings;
  ImageSize size = state.scene.image;
  if (edit_size(size)) edits.edit(state).image = size;
  ImGui::PopStyleVar(2);
}

}  // namespace glimt
