#pragma once

#include <span>
#include <string>
#include <vector>

#include "viewer/state/state.h"

/// The one table of what keys and mouse do. Presses are looked up in it; the help sheet and the status line show it.
namespace glimt {

/// Keys that are no letters, as KeyPress names them.
constexpr char key_escape = 27, key_space = ' ', key_home = 1, key_f1 = 2;

struct KeyPress {
  char key = 0;  ///< a letter, digit or sign of ASCII, or one of the above; 0: none that is known
  bool control = false, shift = false;
};

/// What else keys may be for at the moment.
struct KeyContext {
  bool typing = false;      ///< in a box for text or numbers
  bool popup = false;       ///< a menu is open
  bool flying = false;      ///< letters move the camera
  bool navigating = false;  ///< keys move between the controls
};

/// A key and what it does.
struct KeyBinding {
  enum class When { idle, not_navigating, no_popup, always };

  KeyPress press;
  void (*act)(const ViewerState&, Edits&) = nullptr;
  When when = When::idle;   ///< idle: not while typing, in a menu or in flight
  const char* status = "";  ///< what it does, in the status line; empty: it is not shown there
  bool by_sign = false;     ///< the sign that is typed counts, not the key
};

/// A line of the help sheet.
struct KeyLine {
  const char* what;
  const char* mouse = "";  ///< what is done with the mouse, or held; empty: the keys bound
  std::vector<KeyBinding> keys;
};

struct KeyGroup {
  const char* heading;
  std::vector<KeyLine> lines;
};

std::span<const KeyGroup> key_groups();

/// "Ctrl+Z,  Ctrl+Y"
std::string keys_text(const KeyLine& line);
/// The keys that the status line shows.
std::string status_keys();

/// The key as the table names it. `name` is what the keyboard's layout calls it, and may be null; `position` is what a
/// US layout has there, in ASCII, 0 for none. Letters outside ASCII (Russian, Greek) count by their position.
char key_letter(const char* name, int position);

/// Does what the table says about a key.
void press_key(const KeyPress& press, const KeyContext& context, const ViewerState& state, Edits& edits);
/// The same for a sign that was typed, such as "?", which layouts have in different places.
void type_sign(unsigned sign, const KeyContext& context, const ViewerState& state, Edits& edits);

}  // namespace glimt
