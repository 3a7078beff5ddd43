// One render by several processes under mpirun. They may be more than there are cores.
#include <csignal>

#include "app/cli/checkpoint_parts.h"
#include "app/cli/cli_test.h"
#include "film/image_file.h"

using namespace glimt;
namespace fs = std::filesystem;

namespace {

class RenderRanks : public CommandLine {
 protected:
  void SetUp() override {
    if (!fs::exists(GLIMT_MPIRUN)) GTEST_SKIP() << "built without MPI";
  }
  Arguments command(const std::string& name, const Arguments& goal) const {
    Arguments all{"render", scene,       "-o", name + ".pfm",  "--size",
                  "96x64",  "--threads", "1",  "--checkpoint", name + ".ckpt"};
    all.insert(all.end(), goal.begin(), goal.end());
    return all;
  }
  /// One process alone, then so many ranks with the same goal: the same picture, the same film.
  void expect_same(const std::vector<int>& ranks, const Arguments& goal) const {
    const Result alone = glimt(command("alone", goal));
    ASSERT_EQ(alone.status, 0) << alone.err;
    for (const int count : ranks) {
      SCOPED_TRACE(std::to_string(count) + " ranks");
      const std::string name = "ranks" + std::to_string(count);
      const Result result = program::run(command(name, goal), folder, count);
      ASSERT_EQ(result.status, 0) << result.err;
      EXPECT_TRUE(read(name + ".pfm") == read("alone.pfm"));
      expect_same_film(film_in(folder / (name + ".ckpt")), film_in(folder / "alone.ckpt"));
      EXPECT_EQ(std::ranges::count(result.out, '\n'), 1) << "one line for all: " << result.out;
    }
  }
};

TEST_F(RenderRanks, AnyNumberOfThemMakeTheSamePicture) { expect_same({1, 2, 3, 5}, {"--spp", "41"}); }

TEST_F(RenderRanks, TheyStopAtTheSameError) { expect_same({2, 3}, {"--target-error", "0.002"}); }

// All light is left to chance here, so the counters of its hits are added up too.
TEST_F(RenderRanks, WhatChanceFoundIsCountedOnce) {
  Arguments goal{"--spp", "40", "--method", "naive"};
  expect_same({3}, goal);
  EXPECT_FALSE(film_in(folder / "alone.ckpt").by_chance().empty());
}

TEST_F(RenderRanks, GoOnFromACheckpointOfOneProcess) {
  ASSERT_EQ(glimt(command("whole", {"--spp", "50"})).status, 0);
  ASSERT_EQ(glimt(command("part", {"--spp", "7"})).status, 0);
  ASSERT_EQ(program::run(command("part", {"--spp", "50", "--resume", "part.ckpt"}), folder, 3).status, 0);
  EXPECT_TRUE(read("part.pfm") == read("whole.pfm"));
}

TEST_F(RenderRanks, StatisticsSayHowManyThereWere) {
  ASSERT_EQ(program::run(command("a", {"--spp", "4", "--stats", "stats.json"}), folder, 3).status, 0);
  EXPECT_TRUE(has(read("stats.json"), "\"ranks\": 3")) << read("stats.json");
}

TEST_F(RenderRanks, AMistakeIsToldOnce) {
  const Result result = program::run({"render", "missing.toml", "-o", "a.png"}, folder, 3);
  EXPECT_NE(result.status, 0);
  const std::string words = "missing.toml: ";
  const std::size_t first = result.err.find(words);
  ASSERT_NE(first, std::string::npos) << result.err;
  EXPECT_EQ(result.err.find(words, first + 1), std::string::npos) << result.err;
}

TEST_F(RenderRanks, OneThatDiesEndsTheRunWithItsCheckpointWhole) {
  Arguments goal{"--spp", "30000", "--every", "0.01"};
  program::Running running(command("a", goal), folder, 3);
  ASSERT_TRUE(wait_until([&] { return fs::exists(folder / "a.ckpt"); }));
  const std::vector<pid_t> ranks = running.children();
  ASSERT_EQ(ranks.size(), 3U);
  kill(ranks.back(), SIGKILL);
  EXPECT_NE(running.wait().status, 0);
  const int samples = film_in(folder / "a.ckpt").samples();
  ASSERT_GT(samples, 0);
  const std::string spp = std::to_string(samples + 20);
  ASSERT_EQ(program::run(command("a", {"--spp", spp, "--resume", "a.ckpt"}), folder, 2).status, 0);
  ASSERT_EQ(glimt(command("b", {"--spp", spp})).status, 0);
  EXPECT_TRUE(read("a.pfm") == read("b.pfm"));
}

TEST_F(RenderRanks, CtrlCLeavesThePictureAndTheCheckpoint) {
  program::Running running(command("a", {"--seconds", "300", "--every", "0.01"}), folder, 3);
  ASSERT_TRUE(wait_until([&] { return fs::exists(folder / "a.ckpt"); }));
  running.send(SIGINT);
  const Result result = running.wait();
  EXPECT_NE(result.status, 0);
  EXPECT_TRUE(has(result.err, "interrupted: a.pfm holds the ")) << result.err;
  EXPECT_EQ(read_image(folder / "a.pfm").rgb, film_in(folder / "a.ckpt").mean().rgb);
}

}  // namespace
