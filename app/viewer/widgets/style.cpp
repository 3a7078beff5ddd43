#include "viewer/widgets/style.h"

#include <array>
#include <filesystem>
#include <string>

namespace glimt::style {
namespace {

constexpr float body_size = 15;
constexpr float heading_size = 17;

float current_scale = 1;

/// Adds the first of these files that exists, else ImGui's own font.
void add_font(const std::array<const char*, 2>& files, float pixels) {
  static constexpr ImWchar glyphs[] = {0x20, 0xFF, 0x2013, 0x2014, 0x2026, 0x2026, 0};
  ImFontAtlas& atlas = *ImGui::GetIO().Fonts;
  const std::string folder = "/usr/share/fonts/truetype/";
  for (const char* file : files) {
    std::error_code missing;
    if (std::filesystem::is_regular_file(folder + file, missing) &&
        atlas.AddFontFromFileTTF((folder + file).c_str(), pixels, nullptr, glyphs) != nullptr) {
      return;
    }
  }
  ImFontConfig config;
  config.SizePixels = pixels;
  atlas.AddFontDefault(&config);
}

ImVec4 grey(int r, int g, int b) { return ImColor(r, g, b); }

void set_colours(ImGuiStyle& s) {
  ImGui::StyleColorsDark(&s);
  const ImVec4 accent = ImColor(232, 170, 76), accent_bright = ImColor(250, 196, 110);
  s.Colors[ImGuiCol_Text] = grey(228, 230, 235);
  s.Colors[ImGuiCol_TextDisabled] = ImColor(muted);
  s.Colors[ImGuiCol_WindowBg] = grey(27, 29, 33);
  s.Colors[ImGuiCol_ChildBg] = ImColor(IM_COL32_BLACK_TRANS);
  s.Colors[ImGuiCol_PopupBg] = grey(36, 38, 44);
  s.Colors[ImGuiCol_Border] = grey(58, 62, 70);
  s.Colors[ImGuiCol_FrameBg] = grey(43, 46, 53);
  s.Colors[ImGuiCol_FrameBgHovered] = grey(52, 56, 64);
  s.Colors[ImGuiCol_FrameBgActive] = grey(58, 62, 71);
  s.Colors[ImGuiCol_Button] = grey(50, 54, 62);
  s.Colors[ImGuiCol_ButtonHovered] = grey(64, 69, 79);
  s.Colors[ImGuiCol_ButtonActive] = grey(76, 82, 94);
  s.Colors[ImGuiCol_Header] = grey(50, 54, 62);
  s.Colors[ImGuiCol_HeaderHovered] = grey(58, 62, 71);
  s.Colors[ImGuiCol_HeaderActive] = grey(70, 75, 86);
  s.Colors[ImGuiCol_Tab] = s.Colors[ImGuiCol_TabUnfocused] = grey(34, 36, 41);
  s.Colors[ImGuiCol_TabHovered] = grey(64, 69, 79);
  s.Colors[ImGuiCol_TabActive] = s.Colors[ImGuiCol_TabUnfocusedActive] = grey(58, 62, 71);
  s.Colors[ImGuiCol_TextSelectedBg] = ImColor(fill);
  s.Colors[ImGuiCol_SliderGrab] = accent;
  s.Colors[ImGuiCol_SliderGrabActive] = accent_bright;
  s.Colors[ImGuiCol_CheckMark] = accent;
  s.Colors[ImGuiCol_PlotHistogram] = accent;
  s.Colors[ImGuiCol_NavHighlight] = accent;
  s.Colors[ImGuiCol_Separator] = grey(46, 49, 56);
  s.Colors[ImGuiCol_ScrollbarBg] = grey(27, 29, 33);
  s.Colors[ImGuiCol_ScrollbarGrab] = grey(58, 62, 70);
}

}  // namespace

void apply(float scale, float ratio) {
  ImGuiStyle s;
  set_colours(s);
  s.WindowPadding = {10, 8};
  s.FramePadding = {8, 4};
  s.ItemSpacing = {8, 6};
  s.ItemInnerSpacing = {6, 4};
  s.ScrollbarSize = 10;
  s.GrabMinSize = 10;
  s.WindowRounding = s.ChildRounding = 0;
  s.FrameRounding = s.PopupRounding = s.ScrollbarRounding = 4;
  s.GrabRounding = 3;
  s.TabRounding = 4;
  s.WindowBorderSize = s.ChildBorderSize = 0;
  s.PopupBorderSize = 1;
  current_scale = scale;
  s.ScaleAllSizes(scale);
  ImGui::GetStyle() = s;

  ImGuiIO& io = ImGui::GetIO();
  io.Fonts->Clear();
  add_font({"roboto/unhinted/RobotoTTF/Roboto-Regular.ttf", "dejavu/DejaVuSans.ttf"}, body_size * scale * ratio);
  add_font({"roboto/unhinted/RobotoTTF/Roboto-Medium.ttf", "dejavu/DejaVuSans-Bold.ttf"}, heading_size * scale * ratio);
  io.FontGlobalScale = 1 / ratio;
}

ImFont* heading_font() { return ImGui::GetIO().Fonts->Fonts[1]; }

float scaled(float design) { return design * current_scale; }

}  // namespace glimt::style
