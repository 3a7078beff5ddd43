#pragma once

#include <span>
#include <string>
#include <vector>

#include "viewer/state/state.h"

/// The one table of what keys and mouse do. Key presses are looked up in it; the help sheet and the status line show
/// it.
namespace glimt {

/// Keys other than letters, as KeyPress names them.
constexpr char key_escape = 27, key_space = ' ', key_home = 1, key_f1 = 2;

struct KeyPress {
  char key = 0;  ///< an ASCII letter, digit or sign, or one of the above; 0: unknown
  bool control = false, shift = false;
};

/// What else keys are used for at the moment.
struct KeyContext {
  bool typing = false;      ///< a box for text or numbers is being edited
  bool popup = false;       ///< a menu is open
  bool flying = false;      ///< letters move the camera
  bool navigating = false;  ///< keys move between the controls
};

/// A key and what it does.
struct KeyBinding {
  enum class When { idle, not_navigating, no_popup, always };

  KeyPress press;
  void (*act)(const ViewerState&, Edits&) = nullptr;
  When when = When::idle;   ///< idle: not while typing, with a menu open or in flight
  const char* status = "";  ///< its text in the status line; empty: not shown there
  bool by_sign = false;     ///< matched by the sign that is typed, not by the key
};

/// A line of the help sheet.
struct KeyLine {
  const char* what;
  const char* mouse = "";  ///< what the mouse does, or what is held; empty: the keys alone
  std::vector<KeyBinding> keys;
};

struct KeyGroup {
  const char* heading;
  std::vector<KeyLine> lines;
};

std::span<const KeyGroup> key_groups();

/// The line's keys and mouse actions: "Ctrl+Z,  Ctrl+Y".
std::string keys_text(const KeyLine& line);
/// The keys that the status line shows.
std::string status_keys();

/// The key as the table names it. `name` is its name in the keyboard's layout and may be null. `position` is the ASCII
/// sign that a US layout has there, 0 for none. Letters outside ASCII (Russian, Greek) count by position.
char key_letter(const char* name, int position);

/// Does what the table says for a key.
void press_key(const KeyPress& press, const KeyContext& context, const ViewerState& state, Edits& edits);
/// The same for a typed sign such as "?", which keyboard layouts have in different places.
void type_sign(unsigned sign, const KeyContext& context, const ViewerState& state, Edits& edits);

}  // namespace glimt
