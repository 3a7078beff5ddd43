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

/// Returns true if a size was chosen. `fits` says whether the size follows the free space in the window.
bool edit_size(const ViewerState& state, ImageSize& size, bool& fits) {
  const int most = static_cast<int>(image_fields()[0].max);
  constexpr std::array<ImageSize, 5> usual{{{400, 400}, {800, 600}, {1024, 1024}, {1280, 720}, {1920, 1080}}};
  begin_row(
      "Image size",
      "Width and height, pixels. The arrow chooses: as large as the window has room for, as in the file, or a usual "
      "size.\nDrag, or Ctrl+click to type a number.");
  ImGui::PushID("size");
  const float arrow = ImGui::GetFrameHeight(), gap = ImGui::GetStyle().ItemInnerSpacing.x;
  ImGui::SetNextItemWidth(ImGui::GetContentRegionAvail().x - arrow - gap);
  std::array<int, 2> sides{size.width, size.height};
  bool changed = ImGui::DragInt2("##value", sides.data(), 2, 1, most, "%d", ImGuiSliderFlags_AlwaysClamp);
  note_widget("image.size");
  if (changed) size = {sides[0], sides[1]}, fits = false;
  ImGui::SameLine(0, gap);
  if (ImGui::BeginCombo("##usual", "", ImGuiComboFlags_NoPreview | ImGuiComboFlags_PopupAlignLeft)) {
    const auto offer = [&](const std::string& label, const std::string& name, bool chosen) {
      const bool pressed = ImGui::Selectable(label.c_str(), chosen);
      note_widget("image.size." + name);
      changed |= pressed;
      return pressed;
    };
    if (offer("The window's", "window", fits)) fits = true;
    const auto offer_size = [&](const std::string& label, const std::string& name, const ImageSize& s) {
      if (offer(label, name, !fits && s == size)) size = s, fits = false;
    };
    offer_size("The file's, " + size_text(state.opened_size), "file", state.opened_size);
    for (const ImageSize& s : usual)
      offer_size(size_text(s), std::to_string(s.width) + "x" + std::to_string(s.height), s);
    ImGui::EndCombo();
  }
  ImGui::PopID();
  return changed;
}

}  // namespace

void draw_estimator_panel(const ViewerState& state, Edits& edits) {
  // The rows stand closer than elsewhere, because a small window would not hold so many.
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
  bool fits = state.fits_window;
  if (edit_size(state, size, fits)) {
    edits.fits_window = fits;
    if (!fits) edits.edit(state).image = size;
  }
  ImGui::PopStyleVar(2);
}

}  // namespace glimt
