#include "viewer/keys.h"

#include <cctype>

#include "viewer/state/compare_actions.h"

namespace glimt {
namespace {

using When = KeyBinding::When;

View next(View view) { return view == View::samples ? View::image : static_cast<View>(static_cast<int>(view) + 1); }

CompareView next(CompareView view) {
  return view == CompareView::relative ? CompareView::off : static_cast<CompareView>(static_cast<int>(view) + 1);
}

void show_view(const ViewerState& state, Edits& edits) {
  edits.display = state.display;
  edits.display->view = next(edits.display->view);
}

void show_chart(const ViewerState& state, Edits& edits) {
  edits.chart_view = state.chart.view;
  edits.chart_view->shown = !state.chart.view.shown;
}

void hold(const ViewerState& state, Edits& edits) {
  if (!can_hold(state)) return;
  edits.compare = state.compare;
  edits.compare->held = picture_now(state);
}

void compare(const ViewerState& state, Edits& edits, CompareView view) {
  edits.compare = state.compare;
  edits.compare->view = view;
}

const std::vector<KeyGroup>& table() {
  using S = const ViewerState;
  static const std::vector<KeyGroup> groups{
      {"In the picture",
       {
           {"select an object", "Click", {}},
           {"in a room: turn the view; else: orbit what is under the mouse", "Drag", {}},
           {"the other of the two", "Alt+drag", {}},
           {"move a sphere", "Drag what is selected", {}},
           {"move the camera sideways", "Shift+drag, middle-drag", {}},
           {"come closer or go back", "Scroll", {}},
           {"look where the mouse goes; with it held:", "Right-drag", {}},
           {"fly, down, up; the wheel sets the speed", "W A S D, arrows, Q, E", {}},
           {"camera as in the file",
            "",
            {{{key_home}, [](S& state, Edits& edits) { edits.edit(state).camera = state.opened_camera; }}}},
           {"magnify and move the picture", "Ctrl+scroll, Ctrl+drag", {}},
           {"picture fitted, or pixel by pixel",
            "",
            {{{'f'}, [](S&, Edits& edits) { edits.zoom = PictureZoom::fitted; }},
             {{'1'}, [](S&, Edits& edits) { edits.zoom = PictureZoom::pixel_by_pixel; }}}},
       }},
      {"Rendering",
       {
           {"pause, go on",
            "",
            {{{key_space}, [](S&, Edits& edits) { edits.toggle_pause = true; }, When::not_navigating, "pause"}}},
           {"restart", "", {{{'r'}, [](S&, Edits& edits) { edits.restart = true; }}}},
           {"next view: image, error, samples", "", {{{'v'}, show_view}}},
       }},
      {"Measuring",
       {
           {"chart of error against time", "", {{{'c'}, show_chart}}},
           {"hold the picture, as B", "", {{{'h'}, hold}}},
           {"next comparison with B; flip to B and back",
            "",
            {{{'x'}, [](S& state, Edits& edits) { compare(state, edits, next(state.compare.view)); }},
             {{'b'},
              [](S& state, Edits& edits) {
                compare(state, edits, state.compare.view == CompareView::held ? CompareView::off : CompareView::held);
              }}}},
           {"worst pixel; pixel under the mouse in numbers",
            "",
            {{{'w'}, [](S&, Edits& edits) { edits.worst_pixel = true; }},
             {{'i'}, [](S& state, Edits& edits) { edits.inspect = !state.inspect; }}}},
       }},
      {"Scenes",
       {
           {"snapshot as PNG, as EXR",
            "",
            {{{'s'}, [](S&, Edits& edits) { edits.snapshot = true; }, When::idle, "snapshot"},
             {{.key = 's', .shift = true}, [](S&, Edits& edits) { edits.snapshot_exr = true; }}}},
           {"undo, redo (either)",
            "",
            {{{.key = 'z', .control = true}, [](S&, Edits& edits) { edits.undo = true; }, When::idle, "undo"},
             {{.key = 'y', .control = true}, [](S&, Edits& edits) { edits.redo = true; }},
             {{.key = 'z', .control = true, .shift = true}, [](S&, Edits& edits) { edits.redo = true; }}}},
           {"open, save",
            "",
            {{{.key = 'o', .control = true},
              [](S&, Edits& edits) { edits.choose_file = FilePurpose::open; },
              When::idle,
              "open"},
             {{.key = 's', .control = true}, [](S&, Edits& edits) { edits.choose_file = FilePurpose::save; }}}},
           {"type it", "Ctrl+click a number", {}},
           {"this sheet",
            "",
            {{{key_f1}, [](S&, Edits& edits) { edits.toggle_help = true; }, When::always, "help"},
             {{'?'}, [](S&, Edits& edits) { edits.toggle_help = true; }, When::no_popup, "", true}}},
           {"close it; select nothing",
            "",
            {{{key_escape}, [](S&, Edits& edits) { edits.escape = true; }, When::no_popup}}},
           {"quit", "", {{{.key = 'q', .control = true}, [](S&, Edits& edits) { edits.quit = true; }, When::always}}},
       }},
  };
  return groups;
}

bool is_letter(char key) { return key >= 'a' && key <= 'z'; }

/// Shift matters for letters only: some layouts need it to type other signs.
bool same(const KeyPress& a, const KeyPress& b) {
  return a.key == b.key && a.control == b.control && (a.shift == b.shift || !is_letter(a.key));
}

bool allowed(const KeyBinding& binding, const KeyContext& context) {
  switch (binding.when) {
    case When::always:
      return true;
    case When::no_popup:
      return !context.popup && !(binding.by_sign && context.typing);
    case When::not_navigating:
      return !context.typing && !context.popup && !context.flying && !context.navigating;
    case When::idle:
      break;
  }
  return !context.typing && !context.popup && !context.flying;
}

std::string text_of(const KeyPress& press) {
  std::string text = press.control ? "Ctrl+" : "";
  if (press.shift) text += "Shift+";
  switch (press.key) {
    case key_escape:
      return text + "Esc";
    case key_space:
      return text + "Space";
    case key_home:
      return text + "Home";
    case key_f1:
      return text + "F1";
    default:
      return text + static_cast<char>(std::toupper(static_cast<unsigned char>(press.key)));
  }
}

void carry_out(const KeyPress& press, bool by_sign, const KeyContext& context, const ViewerState& state, Edits& edits) {
  for (const KeyGroup& group : table())
    for (const KeyLine& line : group.lines)
      for (const KeyBinding& binding : line.keys)
        if (binding.by_sign == by_sign && same(binding.press, press) && allowed(binding, context))
          binding.act(state, edits);
}

}  // namespace

std::span<const KeyGroup> key_groups() { return table(); }

std::string keys_text(const KeyLine& line) {
  std::string text = line.mouse;
  for (const KeyBinding& binding : line.keys) text += (text.empty() ? "" : ",  ") + text_of(binding.press);
  return text;
}

std::string status_keys() {
  std::string text;
  for (const KeyGroup& group : table())
    for (const KeyLine& line : group.lines)
      for (const KeyBinding& binding : line.keys)
        if (*binding.status != '\0')
          text += (text.empty() ? "" : "     ") + text_of(binding.press) + "  " + binding.status;
  return text;
}

char key_letter(const char* name, int position) {
  const bool ascii = name != nullptr && name[0] != '\0' && name[1] == '\0';
  if (ascii) return static_cast<char>(std::tolower(static_cast<unsigned char>(name[0])));
  const bool foreign = name != nullptr && static_cast<unsigned char>(name[0]) >= 0x80;
  const bool printable = position > ' ' && position < 127;
  return foreign && printable ? static_cast<char>(std::tolower(position)) : '\0';
}

void press_key(const KeyPress& press, const KeyContext& context, const ViewerState& state, Edits& edits) {
  carry_out(press, false, context, state, edits);
}

void type_sign(unsigned sign, const KeyContext& context, const ViewerState& state, Edits& edits) {
  if (sign < 127) carry_out({.key = static_cast<char>(sign)}, true, context, state, edits);
}

}  // namespace glimt
