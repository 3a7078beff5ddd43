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

constexpr double usual_error = 0.001, least_error = 1e-6, most_error = 1;
constexpr std::array<std::string_view, 2> targets{"sample_count", "estimated_error"};

/// Where to stop: at a number of samples, or at an estimated error.
bool edit_target(Settings& settings) {
  const FieldText text{.name = "target",
                       .key = "stop_at",
                       .doc = "what ends the rendering; a new end goes on with the samples there are"};
  int target = settings.target_error > 0 ? 1 : 0;
  if (!edit_choice(text, targets, target)) return false;
  settings.target_error = target == 0 ? 0 : usual_error;
  return true;
}

bool edit_error(const Field<Settings>& field, double& error) {
  begin_row("Error", std::string(field.doc) + "\nDrag, or Ctrl+click to type a number.");
  ImGui::PushID("error");
  const bool changed = logarithmic_slider(error, least_error, most_error, " relMSE");
  note_widget("render." + std::string(field.key));
  ImGui::PopID();
  return changed;
}

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
  bool changed = edit_target(settings);
  for (const auto& field : settings_fields()) {
    const bool by_error = settings.target_error > 0;
    if (field.key == "target_error") {
      if (by_error) changed |= edit_error(field, settings.target_error);
    } else if (field.key != "spp" || !by_error) {
      changed |= edit_field(field, settings, "render");
    }
  }
  if (changed) edits.edit(state).render = settings;
  ImageSize size = state.scene.image;
  if (edit_size(size)) edits.edit(state).image = size;
  ImGui::PopStyleVar(2);
}

}  // namespace glimt
