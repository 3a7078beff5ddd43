#include <imgui.h>

#include "viewer/keys.h"
#include "viewer/panels/panels.h"
#include "viewer/widgets/layout.h"
#include "viewer/widgets/style.h"
#include "viewer/widgets/widgets.h"

namespace glimt {

bool draw_help_panel(const Rect& area) {
  ImGui::SetNextWindowPos({area.x + area.width / 2, area.y + area.height / 2}, ImGuiCond_Always, {0.5F, 0.5F});
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {style::scaled(24), style::scaled(18)});
  ImGui::PushStyleVar(ImGuiStyleVar_WindowRounding, style::scaled(8));
  ImGui::PushStyleColor(ImGuiCol_WindowBg, style::sheet);
  ImGui::Begin("help", nullptr,
               ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoSavedSettings |
                   ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoNav);
  ImGui::PopStyleColor();
  ImGui::PopStyleVar(2);
  for (const KeyGroup& group : key_groups()) {
    heading(group.heading);
    for (const KeyLine& line : group.lines) {
      ImGui::PushStyleColor(ImGuiCol_Text, style::outline);
      ImGui::TextUnformatted(keys_text(line).c_str());
      ImGui::PopStyleColor();
      ImGui::SameLine(style::scaled(240));
      ImGui::TextUnformatted(line.what);
    }
  }
  const bool clicked = ImGui::IsWindowHovered() && ImGui::IsMouseReleased(ImGuiMouseButton_Left);
  ImGui::End();
  return clicked;
}

}  // namespace glimt
