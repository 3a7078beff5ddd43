#include "viewer/state/autosave.h"

#include <filesystem>
#include <fstream>

#include "app/own_folder.h"
#include "app/viewer/offscreen.h"
#include "pictures.h"
#include "scene/file/scene_file.h"

/// What a window that crashes leaves, and checkpoints that another program writes.
namespace glimt {
namespace {

namespace fs = std::filesystem;
using testing::Offscreen;
using testing::small_room;

using AutosaveFiles = testing::OwnFolder;
using ViewerCheckpoint = testing::OwnFolder;

Checkpoint checkpoint_of(const Scene& scene, int samples) { return {scene, render(compile(scene), samples), 1.5}; }

/// Puts a checkpoint there as a crashed window leaves it: with its lock, which nobody holds.
void leave_behind(const fs::path& folder, const std::string& name, const Checkpoint& checkpoint) {
  fs::create_directories(folder);
  std::ofstream(folder / (name + ".lock")) << "";
  write_checkpoint(folder / (name + ".ckpt"), checkpoint);
}

TEST_F(AutosaveFiles, GoWithTheirProgram) {
  {
    const Autosave autosave("kept");
    write_checkpoint(autosave.file(), checkpoint_of(small_room(), 1));
    EXPECT_FALSE(autosave.left_behind());
  }
  EXPECT_TRUE(fs::is_empty("kept"));
}

TEST_F(AutosaveFiles, OfRunningProgramsAreTheirs) {
  const Autosave first("kept");
  write_checkpoint(first.file(), checkpoint_of(small_room(), 1));
  const Autosave second("kept");
  EXPECT_NE(first.file(), second.file());
  EXPECT_FALSE(second.left_behind());
}

TEST_F(AutosaveFiles, OfCrashedProgramsAreFoundByOne) {
  leave_behind("kept", "window-1", checkpoint_of(small_room(), 1));
  const Autosave finder("kept");
  ASSERT_TRUE(finder.left_behind());
  EXPECT_EQ(*finder.left_behind(), fs::path("kept/window-1.ckpt"));
  EXPECT_FALSE(Autosave("kept").left_behind()) << "it is offered once";
}

TEST_F(AutosaveFiles, StayUntilTheyAreForgotten) {
  leave_behind("kept", "window-1", checkpoint_of(small_room(), 1));
  EXPECT_TRUE(Autosave("kept").left_behind());
  {
    Autosave again("kept");
    EXPECT_TRUE(again.left_behind());
    again.forget_left_behind();
  }
  EXPECT_TRUE(fs::is_empty("kept"));
}

TEST_F(AutosaveFiles, WithoutContentAreRemoved) {
  fs::create_directory("kept");
  std::ofstream("kept/window-1.lock") << "";
  EXPECT_FALSE(Autosave("kept").left_behind());
  EXPECT_TRUE(fs::is_empty("kept"));
}

TEST_F(AutosaveFiles, SayWhereNothingCanBeKept) {
  std::ofstream("kept") << "a file";
  EXPECT_THROW(Autosave("kept"), std::runtime_error);
}

constexpr int window_width = 1280, window_height = 800;

// What a window keeps is what it shows; another finds it after a crash and goes on from there.
TEST_F(ViewerCheckpoint, IsKeptAndGoneOnWithAfterACrash) {
  const Scene room = small_room(8);
  {
    Offscreen window(room, window_width, window_height);
    window.controller().autosave("kept", 0);
    ASSERT_TRUE(window.draw_until_finished());
    ASSERT_TRUE(window.draw_until(
        [] { return fs::exists("kept/window-1.ckpt") && read_checkpoint("kept/window-1.ckpt").film.samples() == 8; }));
    fs::create_directory("crashed");
    fs::copy("kept/window-1.ckpt", "crashed/window-1.ckpt");
    std::ofstream("crashed/window-1.lock") << "";
  }
  EXPECT_TRUE(fs::is_empty("kept"));

  Scene other = room;
  other.spheres[0].radius *= 0.5;
  Offscreen window(other, window_width, window_height);
  window.controller().autosave("crashed", 1000);
  ASSERT_TRUE(window.draw_until_finished());
  ASSERT_TRUE(window.state().left_behind);
  EXPECT_EQ(window.state().left_behind->samples, 8);
  window.press("notice.recover");
  EXPECT_FALSE(window.state().left_behind);
  EXPECT_EQ(window.state().scene.spheres, room.spheres);
  ASSERT_TRUE(window.draw_until([&] { return window.state().frame->samples > 8; })) << "it goes on";
  EXPECT_TRUE(window.state().file.empty()) << "saving asks for a name";
  window.press("undo");
  EXPECT_EQ(window.state().scene.spheres, other.spheres);
  EXPECT_FALSE(fs::exists("crashed/window-1.ckpt"));
}

TEST_F(ViewerCheckpoint, CanBeForgotten) {
  leave_behind("kept", "window-1", checkpoint_of(small_room(), 2));
  Offscreen window(small_room(), window_width, window_height);
  window.controller().autosave("kept", 1000);
  ASSERT_TRUE(window.draw_until_finished());
  window.press("notice.forget");
  EXPECT_FALSE(window.state().left_behind);
  EXPECT_FALSE(fs::exists("kept/window-1.ckpt"));
}

TEST_F(ViewerCheckpoint, ThatIsDamagedIsTold) {
  fs::create_directory("kept");
  std::ofstream("kept/window-1.lock") << "";
  std::ofstream("kept/window-1.ckpt") << "nonsense";
  Offscreen window(small_room(), window_width, window_height);
  window.controller().autosave("kept", 1000);
  EXPECT_FALSE(window.state().left_behind);
  EXPECT_NE(window.state().message.text.find("window-1.ckpt"), std::string::npos) << window.state().message.text;
}

// The picture is the file's film, bit for bit, and a longer one replaces it.
TEST_F(ViewerCheckpoint, IsFollowedAsItGrows) {
  const Scene room = small_room(4);
  Offscreen window(room, window_width, window_height);
  ASSERT_TRUE(window.draw_until_finished());
  const auto shows = [&](int samples) {
    return window.draw_until([&, samples] {
      const auto& frame = window.state().frame;
      return frame && frame->version >= window.state().version && frame->samples == samples;
    });
  };
  Checkpoint checkpoint = checkpoint_of(room, 5);
  write_checkpoint("far.ckpt", checkpoint);
  Edits edits;
  edits.open = "far.ckpt";
  window.apply(edits);
  ASSERT_TRUE(window.state().following) << window.state().message.text;
  ASSERT_TRUE(shows(5));
  EXPECT_EQ(window.state().frame->mean.rgb, checkpoint.film.mean().rgb);
  EXPECT_TRUE(window.state().paused);

  checkpoint = checkpoint_of(room, 9);
  write_checkpoint("far.ckpt", checkpoint);
  ASSERT_TRUE(shows(9));
  EXPECT_EQ(window.state().frame->mean.rgb, checkpoint.film.mean().rgb);

  Edits go_on;
  go_on.toggle_pause = true;
  window.apply(go_on);
  EXPECT_FALSE(window.state().following);
  ASSERT_TRUE(window.draw_until([&] { return window.state().frame->samples > 9; }));
}

}  // namespace
}  // namespace glimt
