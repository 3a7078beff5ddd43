#pragma once

#include <imgui.h>

#include <map>
#include <string>
#include <string_view>

#include "viewer/widgets/layout.h"

/// The pieces that panels are made of.
namespace glimt {

/// Where controls were drawn, by name: "pause", "render.spp", "object.type". "says.TEXT" is the status line with this
/// text; "cut.TEXT" is a text that did not fit.
using WidgetRects = std::map<std::string, Rect>;

/// Records the place of the control drawn last, if the screen collects them.
void note_widget(const std::string& name);

/// Begins a part of the window that cannot be moved. `beside` and `above` are its padding, design units. ImGui::End()
/// ends it.
void begin_fixed_window(const char* name, const Rect& place, float beside, float above,
                        ImGuiWindowFlags flags = ImGuiWindowFlags_None);

/// A heading with a little space above it.
void heading(const char* text);

/// The x at which the controls of all rows begin.
float row_split();

/// Begins a row with the label at the left; `tip` is shown while the mouse is on it. The control drawn next takes the
/// rest of the row.
void begin_row(const std::string& label, std::string_view tip);

/// A slider that is filled from 0, or from its low end, to its value, with the value as text on it. Returns true if the
/// value changed; it stays in low..high.
bool slider(double& value, double low, double high, const char* format);
bool slider(int& value, int low, int high, bool logarithmic);

/// The same with a logarithmic scale; low < 1.
bool logarithmic_slider(double& value, double low, double high, const char* unit);

/// Text that wraps at the column's width; muted text has the colour of hints.
void wrapped_text(const std::string& text);
void muted_text(const std::string& text);

/// Buttons side by side; `columns` of them fill the width.
class ButtonRow {
 public:
  explicit ButtonRow(int columns);
  /// Returns true if it was pressed. `tip` is shown while the mouse is on it.
  bool button(const char* label, const char* name, std::string_view tip, bool enabled = true);

 private:
  int columns_, count_ = 0;
  float width_;
};

/// A row of text.
void text_row(const std::string& label, const std::string& value, std::string_view tip);

/// Places the next pop-up so that it hides no control: outside the column beside the item drawn last, or above the
/// item.
void place_beside_controls();

/// Shows `tip`, wrapped, while the mouse is on the item drawn last.
void tooltip(std::string_view tip);

/// The text, cut with an ellipsis if it is wider than `width`.
std::string fit_text(const std::string& text, float width);

}  // namespace glimt
