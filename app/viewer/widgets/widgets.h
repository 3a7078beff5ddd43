#pragma once

#include <imgui.h>

#include <map>
#include <string>
#include <string_view>

#include "viewer/widgets/layout.h"

/// Pieces that all panels are made of.
namespace glimt {

/// Where controls were drawn, by name: "pause", "render.spp", "object.type"; "says.TEXT" is the status line, and
/// "cut.TEXT" is text that did not fit.
using WidgetRects = std::map<std::string, Rect>;

/// Notes the place of the control drawn last, where the screen asked for it.
void note_widget(const std::string& name);

/// Begins a part of the window that stays where it is, with room at its sides and above and below, in design units.
/// ImGui::End() ends it.
void begin_fixed_window(const char* name, const Rect& place, float beside, float above,
                        ImGuiWindowFlags flags = ImGuiWindowFlags_None);

/// A heading with a line of space above it.
void heading(const char* text);

/// Where in the window the controls of all rows begin.
float row_split();

/// Begins a row: the label at the left, `tip` shown when the mouse is on it; the control drawn next takes the rest.
void begin_row(const std::string& label, std::string_view tip);

/// A slider that is filled up to its value (from 0 where that is inside), with the value as text on it. Returns true
/// where the value was changed, always to one in low..high.
bool slider(double& value, double low, double high, const char* format);
bool slider(int& value, int low, int high, bool logarithmic);

/// The same for values of any size, each factor as wide as another; low < 1.
bool logarithmic_slider(double& value, double low, double high, const char* unit);

/// Text that goes on in the next line where the column ends; muted: as hints are.
void wrapped_text(const std::string& text);
void muted_text(const std::string& text);

/// Buttons side by side, so many in a row that fills the width.
class ButtonRow {
 public:
  explicit ButtonRow(int columns);
  /// True where it was pressed. `tip` is shown while the mouse is on it.
  bool button(const char* label, const char* name, std::string_view tip, bool enabled = true);

 private:
  int columns_, count_ = 0;
  float width_;
};

/// A row of text.
void text_row(const std::string& label, const std::string& value, std::string_view tip);

/// Places the next pop-up window beside the item drawn last, outside the column, or above the item, so that it hides
/// no control.
void place_beside_controls();

/// Shows `tip`, wrapped, while the mouse is on the item drawn last.
void tooltip(std::string_view tip);

/// The text, cut with an ellipsis where it is wider than `width`.
std::string fit_text(const std::string& text, float width);

}  // namespace glimt
