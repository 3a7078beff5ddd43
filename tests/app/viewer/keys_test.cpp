#include "viewer/keys.h"

#include <gtest/gtest.h>

#include <set>
#include <string>
#include <tuple>

namespace glimt {
namespace {

Edits pressed(const KeyPress& press, const KeyContext& context = {}) {
  Edits edits;
  press_key(press, context, {}, edits);
  return edits;
}

TEST(Keys, LettersOfOtherAlphabetsCountByTheirPosition) {
  EXPECT_EQ(key_letter("z", 'Y'), 'z') << "a German layout has Z where a US one has Y";
  EXPECT_EQ(key_letter("Z", 'Z'), 'z');
  EXPECT_EQ(key_letter("\xD1\x8F", 'Z'), 'z') << "Russian";
  EXPECT_EQ(key_letter("\xCE\xB6", 'Z'), 'z') << "Greek";
  EXPECT_EQ(key_letter(nullptr, 265), '\0') << "a key without a sign";
  EXPECT_EQ(key_letter("\xD1\x8F", 0), '\0');
  EXPECT_TRUE(pressed({.key = key_letter("\xD1\x8F", 'Z'), .control = true}).undo);
}

TEST(Keys, EachDoesOneThing) {
  std::set<std::tuple<char, bool, bool>> seen;
  for (const KeyGroup& group : key_groups())
    for (const KeyLine& line : group.lines) {
      EXPECT_FALSE(keys_text(line).empty()) << line.what;
      for (const KeyBinding& binding : line.keys) {
        const KeyPress& press = binding.press;
        EXPECT_TRUE(seen.insert({press.key, press.control, press.shift}).second) << keys_text(line);
      }
    }
}

TEST(Keys, ShiftAndControlTellLettersApart) {
  EXPECT_TRUE(pressed({'s'}).snapshot);
  EXPECT_FALSE(pressed({'s'}).snapshot_exr);
  EXPECT_TRUE(pressed({.key = 's', .shift = true}).snapshot_exr);
  EXPECT_EQ(pressed({.key = 's', .control = true}).choose_file, FilePurpose::save);
  EXPECT_TRUE(pressed({.key = 'z', .control = true, .shift = true}).redo);
  EXPECT_FALSE(pressed({.key = 'z', .control = true, .shift = true}).undo);
}

TEST(Keys, OnlySomeWorkWhileKeysAreForSomethingElse) {
  for (const KeyContext& context :
       {KeyContext{.typing = true}, KeyContext{.popup = true}, KeyContext{.flying = true}}) {
    EXPECT_FALSE(pressed({'r'}, context).restart);
    EXPECT_FALSE(pressed({key_space}, context).toggle_pause);
    EXPECT_TRUE(pressed({.key = 'q', .control = true}, context).quit);
    EXPECT_EQ(pressed({key_escape}, context).escape, !context.popup);
  }
  EXPECT_FALSE(pressed({key_space}, {.navigating = true}).toggle_pause) << "space presses the control";
  Edits edits;
  type_sign('?', {.typing = true}, {}, edits);
  EXPECT_FALSE(edits.toggle_help);
  type_sign('?', {}, {}, edits);
  EXPECT_TRUE(edits.toggle_help);
}

TEST(Keys, TheStatusLineShowsKeysOfTheTable) {
  const std::string line = status_keys();
  for (const char* text : {"Space  pause", "S  snapshot", "Ctrl+Z  undo", "Ctrl+O  open", "F1  help"})
    EXPECT_NE(line.find(text), std::string::npos) << line;
}

}  // namespace
}  // namespace glimt
