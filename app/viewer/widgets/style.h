#pragma once

#include <imgui.h>

/// Colours, sizes and fonts of the window.
namespace glimt::style {

constexpr ImU32 backdrop = IM_COL32(15, 16, 18, 255);   ///< around the picture
constexpr ImU32 well = IM_COL32(21, 22, 26, 255);       ///< behind lists
constexpr ImU32 sheet = IM_COL32(30, 32, 37, 246);      ///< over the picture
constexpr ImU32 muted = IM_COL32(150, 155, 165, 255);   ///< labels and hints
constexpr ImU32 fill = IM_COL32(110, 84, 44, 255);      ///< in sliders, up to their value
constexpr ImU32 outline = IM_COL32(255, 190, 92, 255);  ///< around what is selected
constexpr ImU32 outline_shadow = IM_COL32(0, 0, 0, 90);
constexpr ImU32 outline_hidden = IM_COL32(255, 190, 92, 110);
constexpr ImU32 error = IM_COL32(255, 128, 112, 255);

/// Sets colours, sizes and fonts. `scale` is window coordinates per design unit (1 on an ordinary screen), `ratio` is
/// framebuffer pixels per window coordinate. The font is Roboto or DejaVu Sans if installed, else ImGui's own.
void apply(float scale, float ratio);

/// The font of headings.
ImFont* heading_font();

/// A length of `design` units in window coordinates.
float scaled(float design);

}  // namespace glimt::style
