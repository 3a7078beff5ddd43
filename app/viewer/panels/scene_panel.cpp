#include <imgui.h>

#include <string>

#include "compile/compiled_scene.h"
#include "viewer/panels/panels.h"
#include "viewer/widgets/labels.h"
#include "viewer/widgets/style.h"
#include "viewer/widgets/widgets.h"

namespace glimt {
namespace {

void draw_lines(const char* title, const std::vector<std::string>& lines, ImU32 colour) {
  if (lines.empty()) return;
  heading(title);
  ImGui::PushStyleColor(ImGuiCol_Text, colour);
  for (const std::string& line : lines) wrapped_text(sentence(line));
  ImGui::PopStyleColor();
}

}  // namespace

void draw_scene_panel(const ViewerState& state) {
  wrapped_text(state.file.empty() ? "From a picture; not in a scene file yet." : state.file.string());
  note_widget("scene.file");
  draw_lines("Compiled in", state.compiled->compiled_in, ImGui::GetColorU32(ImGuiCol_Text));
  draw_lines("Left out, as this scene does not need it", state.compiled->left_out, style::muted);
  draw_lines("Warnings", state.compiled->warnings, style::error);
}

}  // namespace glimt
