// Renders that are broken off and go on, and parts of a render that are put together. The scene has glass and a mirror,
// so that light paths and connections, whose numbers come from the sample too, are among what must be equal.
#include <algorithm>
#include <chrono>
#include <csignal>
#include <map>
#include <random>
#include <thread>

#include "app/cli/checkpoint_parts.h"
#include "app/cli/cli_test.h"
#include "film/image_file.h"

using namespace glimt;
namespace fs = std::filesystem;

namespace {

/// What a picture says of its making, its time left out.
Metadata making_of(const fs::path& file) {
  Metadata metadata = read_metadata(file);
  metadata.erase("seconds");
  return metadata;
}

class Checkpoints : public CommandLine {
 protected:
  /// Renders, and expects success.
  void made(const std::string& out, const Arguments& options) const {
    const Result result = render(out, options);
    ASSERT_EQ(result.status, 0) << result.err;
  }
  /// Expects exit status 2 and these words in one line.
  static void expect_refused(const Result& result, const std::string& words) {
    EXPECT_EQ(result.status, 2) << result.out;
    EXPECT_TRUE(has(result.err, words)) << result.err;
    EXPECT_EQ(std::ranges::count(result.err, '\n'), 1) << result.err;
  }
  /// All but the last byte.
  void cut(const std::string& name) const { write(name, read(name).substr(0, read(name).size() - 1)); }
};

TEST_F(Checkpoints, ResumedItIsTheUninterruptedRender) {
  made("whole.pfm", {"--spp", "40", "--checkpoint", "whole.ckpt"});
  made("a.pfm", {"--spp", "7", "--checkpoint", "a.ckpt", "--threads", "1"});
  made("a.pfm", {"--spp", "8", "--checkpoint", "a.ckpt", "--resume", "a.ckpt", "--lanes", "1"});
  made("b.pfm", {"--spp", "40", "--checkpoint", "b.ckpt", "--resume", "a.ckpt", "--threads", "3"});
  EXPECT_TRUE(read("whole.pfm") == read("b.pfm"));
  expect_same_film(film_in(folder / "whole.ckpt"), film_in(folder / "b.ckpt"));
  EXPECT_EQ(film_in(folder / "a.ckpt").samples(), 8) << "--resume alone leaves the file as it is";
  EXPECT_GT(read_checkpoint(folder / "b.ckpt").seconds, read_checkpoint(folder / "a.ckpt").seconds) << "time adds up";
}

TEST_F(Checkpoints, AFinishedRenderIsWrittenAgain) {
  made("a.png", {"--spp", "99", "--checkpoint", "a.ckpt"});
  made("b.png", {"--spp", "99", "--checkpoint", "a.ckpt", "--resume", "a.ckpt"});
  EXPECT_TRUE(read("a.png") == read("b.png"));
}

TEST_F(Checkpoints, TheSameCommandBeginsAndGoesOn) {
  const Arguments options{"--spp", "4", "--checkpoint", "a.ckpt", "--resume", "./a.ckpt"};
  made("a.pfm", options);
  EXPECT_EQ(film_in(folder / "a.ckpt").samples(), 4);
  made("b.pfm", options);
  EXPECT_TRUE(read("a.pfm") == read("b.pfm"));
}

// Any error is below this target, so the first look ends the render: the one that the checkpoint says, for its target.
TEST_F(Checkpoints, TheErrorIsLookedAtWhereItWouldHaveBeen) {
  made("a.pfm", {"--spp", "11", "--checkpoint", "a.ckpt"});
  Checkpoint checkpoint = read_checkpoint(folder / "a.ckpt");
  checkpoint.scene.render.target_error = 1e5;
  checkpoint.next_check = 20;
  write_checkpoint(folder / "a.ckpt", checkpoint);
  made("b.pfm", {"--target-error", "1e5", "--resume", "a.ckpt", "--checkpoint", "b.ckpt"});
  EXPECT_EQ(film_in(folder / "b.ckpt").samples(), 20);
  made("c.pfm", {"--target-error", "1e4", "--resume", "a.ckpt", "--checkpoint", "c.ckpt"});
  EXPECT_EQ(film_in(folder / "c.ckpt").samples(), 11) << "another target is looked at at once";
  made("d.pfm", {"--target-error", "1e5", "--resume", "b.ckpt", "--checkpoint", "d.ckpt"});
  EXPECT_EQ(film_in(folder / "d.ckpt").samples(), 20) << "it was reached";
}

TEST_F(Checkpoints, OfAnotherRenderAreRefusedWithWhatDiffers) {
  made("a.pfm", {"--spp", "8", "--checkpoint", "a.ckpt"});
  const auto resume = [&](Arguments options) {
    options.insert(options.end(), {"--resume", "a.ckpt"});
    return render("b.pfm", options);
  };
  expect_refused(resume({"--seed", "2"}), "seed is 1, not 2");
  expect_refused(glimt({"render", scene, "-o", "b.pfm", "--size", "16x24", "--resume", "a.ckpt"}),
                 "the image is 24x16, not 16x24");
  expect_refused(resume({"--sampler", "sobol"}), "sampler is lattice, not sobol");
  expect_refused(resume({"--set", "material.clay.reflectance=[0.1, 0.2, 0.3]"}),
                 "[material.clay] has reflectance = [0.75, 0.75, 0.75], not [0.1, 0.2, 0.3]");
  const std::string cornell = GLIMT_SCENES "/cornell.toml";
  expect_refused(glimt({"render", cornell, "-o", "b.pfm", "--size", "24x16", "--resume", "a.ckpt"}),
                 "a.ckpt cannot be resumed, it is of another scene: ");
  expect_refused(resume({"--spp", "6"}), "it holds samples 0 to 7 of each pixel, and samples 0 to 5 are asked for");
  expect_refused(resume({"--samples", "8:8"}), "it holds samples 0 to 7 of each pixel, and samples 8 to 15");
  cut("a.ckpt");
  expect_refused(resume({}), "a.ckpt: is cut short or damaged");
  expect_refused(render("b.pfm", {"--resume", scene}), "is no checkpoint of glimt");
  expect_refused(render("b.pfm", {"--resume", "missing"}), "missing: cannot be read: No such file");
  expect_refused(render("b.pfm", {"--resume", "missing", "--checkpoint", "c.ckpt"}), "missing: cannot be read");
  EXPECT_FALSE(fs::exists(folder / "b.pfm") || fs::exists(folder / "c.ckpt"));
}

TEST_F(Checkpoints, AreNotReplacedByOtherRenders) {
  made("a.pfm", {"--spp", "3", "--checkpoint", "a.ckpt"});
  made("b.pfm", {"--spp", "4", "--checkpoint", "b.ckpt"});
  const std::string before = read("a.ckpt");
  expect_refused(render("a.pfm", {"--checkpoint", "a.ckpt"}), "a.ckpt is there already: go on from it with --resume");
  expect_refused(render("a.pfm", {"--checkpoint", "a.ckpt", "--resume", "b.ckpt"}), "a.ckpt is there already");
  EXPECT_TRUE(read("a.ckpt") == before);
}

TEST_F(Checkpoints, OptionsThatMakeNoSenseAreRefused) {
  for (const char* text : {"", "5", "5:", ":5", "0:0", "-1:5", "1:-5", "0:5x", "16777215:2", "99999999999:1", "0:5:5"})
    EXPECT_EQ(render("a.pfm", {"--samples", text}).status, 2) << text;
  EXPECT_EQ(render("a.pfm", {"--samples", "0:5", "--seconds", "1"}).status, 2);
  EXPECT_EQ(render("a.pfm", {"--samples", "0:5", "--target-error", "1"}).status, 2);
  EXPECT_EQ(render("a.pfm", {"--every", "1"}).status, 2) << "of no checkpoint";
  EXPECT_EQ(render("a.pfm", {"--checkpoint", "a.ckpt", "--every", "0"}).status, 2);
  EXPECT_EQ(render("a.pfm", {"--checkpoint", "missing/a.ckpt"}).status, 2);
  EXPECT_EQ(files(), 0U);
}

TEST_F(Checkpoints, WhatWasLeftByAKilledProgramIsRemoved) {
  made("a.pfm", {"--spp", "3", "--checkpoint", "a.ckpt"});
  write(".a.ckpt.glimt-1-0.tmp", read("a.ckpt").substr(0, 500));
  write(".b.ckpt.glimt-1-0.tmp", "another's");
  made("b.pfm", {"--spp", "6", "--checkpoint", "a.ckpt", "--resume", "a.ckpt"});
  made("c.pfm", {"--spp", "6"});
  EXPECT_TRUE(read("b.pfm") == read("c.pfm"));
  EXPECT_FALSE(fs::exists(folder / ".a.ckpt.glimt-1-0.tmp"));
  EXPECT_TRUE(fs::exists(folder / ".b.ckpt.glimt-1-0.tmp"));
}

class Merge : public Checkpoints {
 protected:
  void part(const std::string& name, const std::string& samples) const {
    made("part.pfm", {"--samples", samples, "--checkpoint", name});
  }
};

// Parts that begin at odd samples, and one of a single sample.
TEST_F(Merge, InAnyOrderItIsOneRenderBitForBit) {
  made("whole.exr", {"--spp", "24", "--checkpoint", "whole.ckpt"});
  made("whole.png", {"--spp", "24"});
  part("0.ckpt", "0:7");
  part("7.ckpt", "7:1");
  part("8.ckpt", "8:16");
  Arguments order{"0.ckpt", "7.ckpt", "8.ckpt"};
  std::string first;
  do {
    for (const char* out : {"m.ckpt", "m.exr", "m.png"}) {
      const Result result = glimt({"merge", order[0], order[1], order[2], "-o", out});
      ASSERT_EQ(result.status, 0) << result.err;
      EXPECT_TRUE(has(result.out, ": 24 spp of 3 checkpoints, error ")) << result.out;
      EXPECT_FALSE(has(result.out, "missing")) << result.out;
    }
    expect_same_film(film_in(folder / "m.ckpt"), film_in(folder / "whole.ckpt"));
    EXPECT_EQ(read_image(folder / "m.exr").rgb, read_image(folder / "whole.exr").rgb);
    for (const std::string ending : {".exr", ".png"})
      EXPECT_EQ(making_of(folder / ("m" + ending)), making_of(folder / ("whole" + ending)));
    const std::string all = read("m.ckpt") + read("m.exr") + read("m.png");
    EXPECT_TRUE(first.empty() || all == first) << "another order makes other files";
    first = all;
  } while (std::ranges::next_permutation(order).found);
}

TEST_F(Merge, InStepsItIsTheSameAsAtOnce) {
  made("whole.pfm", {"--spp", "12"});
  part("a", "0:3");
  part("b", "3:4");
  part("c", "7:5");
  ASSERT_EQ(glimt({"merge", "c", "a", "-o", "ac.ckpt"}).status, 0);
  ASSERT_EQ(glimt({"merge", "ac.ckpt", "b", "-o", "abc.pfm"}).status, 0);
  EXPECT_TRUE(read("abc.pfm") == read("whole.pfm"));
}

TEST_F(Merge, GapsAreToldAndCanBeFilled) {
  made("whole.pfm", {"--spp", "20"});
  part("a", "2:3");
  part("b", "9:1");
  const Result result = glimt({"merge", "b", "a", "-o", "ab.ckpt"});
  EXPECT_EQ(result.status, 0) << result.err;
  EXPECT_TRUE(has(result.out, "missing: samples 0 to 1\nmissing: samples 5 to 8\n")) << result.out;
  ASSERT_EQ(glimt({"merge", "ab.ckpt", "-o", "ab.exr"}).status, 0);
  EXPECT_EQ(read_metadata(folder / "ab.exr").at("sample_ranges"), "2:3,9:1");
  made("all.pfm", {"--spp", "20", "--resume", "ab.ckpt"});
  EXPECT_TRUE(read("all.pfm") == read("whole.pfm"));
}

TEST_F(Merge, RefusesWhatDoesNotBelongTogether) {
  part("a", "0:8");
  part("b", "7:8");
  made("part.pfm", {"--samples", "8:8", "--checkpoint", "seed", "--seed", "2"});
  ASSERT_EQ(
      glimt({"render", scene, "-o", "part.pfm", "--size", "16x16", "--samples", "8:8", "--checkpoint", "size"}).status,
      0);
  expect_refused(glimt({"merge", "a", "b", "-o", "m.exr"}), "b and a both hold sample 7 of each pixel");
  expect_refused(glimt({"merge", "a", "a", "-o", "m.exr"}), "a and a both hold samples 0 to 7 of each pixel");
  expect_refused(glimt({"merge", "a", "seed", "-o", "m.exr"}), "seed is not of the scene of a: seed is 2, not 1");
  expect_refused(glimt({"merge", "a", "size", "-o", "m.exr"}), "the image is 16x16, not 24x16");
  expect_refused(glimt({"merge", "a", "missing", "-o", "m.exr"}), "missing: cannot be read");
  expect_refused(glimt({"merge", "a", "part.pfm", "-o", "m.exr"}), "part.pfm: is no checkpoint of glimt");
  expect_refused(glimt({"merge", "a", "-o", "m.jpg"}), "a checkpoint ends in .ckpt");
  cut("b");
  expect_refused(glimt({"merge", "a", "b", "-o", "m.exr"}), "b: is cut short or damaged");
  EXPECT_FALSE(fs::exists(folder / "m.exr"));
}

class Breaks : public Checkpoints {
 protected:
  /// A part of a.ckpt is in a file that is not renamed yet.
  bool writes_a_checkpoint() const {
    return std::ranges::any_of(fs::directory_iterator(folder), [](const auto& entry) {
      std::error_code gone;
      const std::uintmax_t bytes = entry.file_size(gone);
      return entry.path().filename().string().starts_with(".a.ckpt.") && !gone && bytes > 0;
    });
  }
  Arguments command(const std::string& out, const Arguments& goal) const {
    Arguments all{"render", scene, "-o", out, "--size", size_, "--threads", "2"};
    all.insert(all.end(), goal.begin(), goal.end());
    return all;
  }

  /// Kills a render at random moments, every second time while it writes a checkpoint, until it has been killed so many
  /// times; lets it end, and compares it with one that nobody has killed.
  void kill_and_compare(const Arguments& goal, int kills, unsigned seed) {
    ASSERT_EQ(glimt(command("whole.pfm", goal)).status, 0);
    Arguments again = command("a.pfm", goal);
    again.insert(again.end(), {"--checkpoint", "a.ckpt", "--resume", "a.ckpt", "--every", "0.001"});
    std::mt19937 random(seed);
    int samples = 0, killed = 0, in_writing = 0;
    while (killed < kills) {
      program::Running running(again, folder);
      if (killed % 2 == 0)
        std::this_thread::sleep_for(std::chrono::microseconds(std::uniform_int_distribution(0, 60'000)(random)));
      else
        ASSERT_TRUE(wait_until([&] { return writes_a_checkpoint(); }));
      running.send(SIGKILL);
      const Result result = running.wait();
      ASSERT_TRUE(result.status == 128 + SIGKILL || result.status == 0) << result.err;
      ++killed;
      if (writes_a_checkpoint()) ++in_writing;
      if (!fs::exists(folder / "a.ckpt")) continue;
      const int now = film_in(folder / "a.ckpt").samples();
      EXPECT_GE(now, samples) << "lost after " << killed << " kills, seed " << seed;
      samples = now;
    }
    RecordProperty("kills_in_writing", in_writing);
    const Result result = glimt(again);
    ASSERT_EQ(result.status, 0) << result.err;
    EXPECT_TRUE(read("a.pfm") == read("whole.pfm")) << "seed " << seed;
    EXPECT_FALSE(writes_a_checkpoint()) << "nothing is left of what was killed";
  }

  std::string size_ = "96x64";
};

TEST_F(Breaks, KilledAtAnyMomentItEndsAsIfItHadNotBeen) { kill_and_compare({"--spp", "1000"}, 10, 1); }

// The error is looked at after the same samples as without the breaks. In this size a pass is shorter than the way from
// one look to the next.
TEST_F(Breaks, KilledItReachesTheTargetWithTheSameSamples) {
  size_ = "240x160";
  kill_and_compare({"--target-error", "0.002"}, 8, 2);
}

using BreaksLong = Breaks;
TEST_F(BreaksLong, KilledAHundredTimes) { kill_and_compare({"--spp", "20000"}, 100, 3); }

TEST_F(Breaks, ASignalLeavesThePictureAndTheCheckpoint) {
  made("whole.pfm", {});
  for (const int signal : {SIGINT, SIGTERM}) {
    const std::string name = std::to_string(signal);
    Arguments options = command(name + ".exr", {"--seconds", "300", "--checkpoint", name + ".ckpt", "--every", "0.01"});
    program::Running running(options, folder);
    ASSERT_TRUE(wait_until([&] { return fs::exists(folder / (name + ".ckpt")); }));
    running.send(signal);
    const Result result = running.wait();
    EXPECT_EQ(result.status, 128 + signal) << result.err;
    EXPECT_TRUE(has(result.err, "interrupted: " + name + ".exr holds the ")) << result.err;
    const Film film = film_in(folder / (name + ".ckpt"));
    EXPECT_EQ(read_image(folder / (name + ".exr")).rgb, film.mean().rgb);
    const std::string spp = std::to_string(film.samples() + 10);
    ASSERT_EQ(glimt(command("a.pfm", {"--spp", spp, "--resume", name + ".ckpt"})).status, 0);
    ASSERT_EQ(glimt(command("b.pfm", {"--spp", spp})).status, 0);
    EXPECT_TRUE(read("a.pfm") == read("b.pfm"));
  }
}

TEST_F(Breaks, ACheckpointSaysWhenToLookAtTheErrorNext) {
  program::Running running(command("a.pfm", {"--target-error", "1e-9", "--checkpoint", "a.ckpt", "--every", "0.01"}),
                           folder);
  ASSERT_TRUE(wait_until([&] { return fs::exists(folder / "a.ckpt"); }));
  running.send(SIGTERM);
  EXPECT_EQ(running.wait().status, 143);
  const Checkpoint checkpoint = read_checkpoint(folder / "a.ckpt");
  EXPECT_GT(checkpoint.next_check, checkpoint.film.samples());
}

// One sample of this picture takes minutes in one lane. The unfinished file goes as soon as signals are listened to.
TEST_F(Breaks, TheSecondInterruptEndsAtOnce) {
  write(".a.ckpt.glimt-1-0.tmp", "");
  program::Running running({"render", scene, "-o", "a.exr", "--size", "4000x4000", "--threads", "1", "--lanes", "1",
                            "--shadow-rays", "64", "--checkpoint", "a.ckpt"},
                           folder);
  ASSERT_TRUE(wait_until([&] { return files() == 0; }));
  running.send(SIGINT);
  std::this_thread::sleep_for(std::chrono::milliseconds(20));
  running.send(SIGINT);
  EXPECT_EQ(running.wait().status, 130);
  EXPECT_EQ(files(), 0U);
}

TEST_F(Breaks, ThePictureIsWrittenWhereTheCheckpointCannotBe) {
  fs::create_directory(folder / "kept");
  write("kept/.a.ckpt.glimt-1-0.tmp", "");
  program::Running running(command("a.pfm", {"--seconds", "0.3", "--checkpoint", "kept/a.ckpt"}), folder);
  ASSERT_TRUE(wait_until([&] { return fs::is_empty(folder / "kept"); }));
  fs::remove(folder / "kept");
  const Result result = running.wait();
  EXPECT_EQ(result.status, 1);
  EXPECT_TRUE(has(result.err, "kept/a.ckpt: the folder ")) << result.err;
  EXPECT_EQ(read_image(folder / "a.pfm").width, 96);
}

}  // namespace
