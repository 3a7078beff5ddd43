#include <imgui.h>

#include <array>

#include "viewer/panels/panels.h"
#include "viewer/widgets/layout.h"
#include "viewer/widgets/style.h"
#include "viewer/widgets/widgets.h"

namespace glimt {
namespace {

struct Line {
  const char *keys, *what;  ///< no keys: a heading
};

constexpr std::array lines{
    Line{nullptr, "In the picture"},
    Line{"Click", "select an object"},
    Line{"Drag", "in a room: turn the view; else: orbit what is under the mouse"},
    Line{"Alt+drag", "the other of the two"},
    Line{"Drag what is selected", "move a sphere"},
    Line{"Shift+drag, middle-drag", "move the camera sideways"},
    Line{"Scroll", "come closer or go back"},
    Line{"Right-drag", "look where the mouse goes; with it held:"},
    Line{"W A S D, arrows, Q, E", "fly, down, up; the wheel sets the speed"},
    Line{"Home", "camera as in the file"},
    Line{"Ctrl+scroll, Ctrl+drag", "magnify and move the picture"},
    Line{"F,  1", "picture fitted, or pixel by pixel"},
    Line{nullptr, "Rendering"},
    Line{"Space", "pause, go on"},
    Line{"R", "restart"},
    Line{"V", "next view: image, error, samples"},
    Line{nullptr, "Measuring"},
    Line{"C", "chart of error against time"},
    Line{"H", "hold the picture, as B"},
    Line{"X,  B", "next comparison with B; flip to B and back"},
    Line{"W,  I", "worst pixel; pixel under the mouse in numbers"},
    Line{nullptr, "Scenes"},
    Line{"Ctrl+Z,  Ctrl+Y", "undo, redo (also Ctrl+Shift+Z)"},
    Line{"Ctrl+O,  Ctrl+S", "open, save"},
    Line{"S,  Shift+S", "snapshot as PNG, as EXR"},
    Line{"Ctrl+click a number", "type it"},
    Line{"F1,  ?", "this sheet"},
    Line{"Esc", "close it; select nothing"},
    Line{"Ctrl+Q", "quit"},
};

}  // namespace

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
  for (const Line& line : lines) {
    if (line.keys == nullptr) {
      heading(line.what);
      continue;
    }
    ImGui::PushStyleColor(ImGuiCol_Text, style::outline);
    ImGui::TextUnformatted(line.keys);
    ImGui::PopStyleColor();
    ImGui::SameLine(style::scaled(220));
    ImGui::TextUnformatted(line.what);
  }
  const bool clicked = ImGui::IsWindowHovered() && ImGui::IsMouseReleased(ImGuiMouseButton_Left);
  ImGui::End();
  return clicked;
}

}  // namespace glimt
