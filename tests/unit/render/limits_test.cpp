#include "render/limits.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <fstream>
#include <limits>

#include "app/own_folder.h"

using namespace glimt;

namespace {

namespace fs = std::filesystem;

/// A machine with 8 GB to spare whose files are in a folder.
class MemoryLimit : public glimt::testing::OwnFolder {
 protected:
  void SetUp() override {
    OwnFolder::SetUp();
    write("proc/meminfo", "MemTotal: 16000000 kB\nMemFree: 1000 kB\nMemAvailable:   8000000 kB\n");
  }
  static void write(const fs::path& file, const std::string& text) {
    fs::create_directories(file.parent_path());
    std::ofstream(file) << text;
  }
  static std::uint64_t left() { return free_memory("."); }
  static constexpr std::uint64_t machine = 8'192'000'000;
};

TEST_F(MemoryLimit, IsWhatTheMachineHasLeft) {
  EXPECT_EQ(left(), machine);
  write("proc/self/cgroup", "0::/\n");
  EXPECT_EQ(left(), machine) << "a group without a limit";
  fs::remove("proc/meminfo");
  EXPECT_EQ(left(), std::numeric_limits<std::uint64_t>::max());
}

// Version 2: the group, or one above it. Pages of files make room, so they do not count as used.
TEST_F(MemoryLimit, IsThatOfTheControlGroup) {
  write("proc/self/cgroup", "0::/slurm/job_7/step_0\n");
  write("sys/fs/cgroup/slurm/job_7/memory.max", "3000000000\n");
  write("sys/fs/cgroup/slurm/job_7/memory.current", "1000000000\n");
  write("sys/fs/cgroup/slurm/job_7/memory.stat", "anon 600000000\ninactive_file 400000000\n");
  write("sys/fs/cgroup/slurm/job_7/step_0/memory.max", "max\n");
  write("sys/fs/cgroup/slurm/job_7/step_0/memory.current", "5\n");
  EXPECT_EQ(left(), 2'400'000'000U);
  write("sys/fs/cgroup/slurm/memory.max", "100\n");
  write("sys/fs/cgroup/slurm/memory.current", "70\n");
  EXPECT_EQ(left(), 30U);
  write("sys/fs/cgroup/slurm/memory.current", "200\n");
  EXPECT_EQ(left(), 0U) << "more is used than allowed";
}

// In a container the group's path is another machine's, and the limit stands where the groups are mounted.
TEST_F(MemoryLimit, IsThatOfTheContainer) {
  write("proc/self/cgroup", "5:cpu,cpuacct:/docker/1234\n4:memory:/docker/1234\n");
  write("sys/fs/cgroup/memory/memory.limit_in_bytes", "2000000000\n");
  write("sys/fs/cgroup/memory/memory.usage_in_bytes", "900000000\n");
  write("sys/fs/cgroup/memory/memory.stat", "inactive_file 1\ntotal_inactive_file 100000000\n");
  EXPECT_EQ(left(), 1'200'000'000U);
}

TEST_F(MemoryLimit, IsThatOfTheAddressSpace) {
  write("proc/self/statm", "1000 5 5\n");
  write("proc/self/limits",
        "Max resident set     unlimited    unlimited    bytes\nMax address space    unlimited    unlimited    bytes\n");
  EXPECT_EQ(left(), machine);
  write("proc/self/limits", "Max address space    6000000000    unlimited    bytes\n");
  EXPECT_EQ(left(), 6'000'000'000U - 1000U * static_cast<unsigned>(getpagesize()));
}

// The files of this machine are read as well.
TEST_F(MemoryLimit, IsKnownHere) {
  EXPECT_GT(free_memory(), 0U);
  EXPECT_LT(free_memory(), std::numeric_limits<std::uint64_t>::max());
}

TEST(ThreadLimit, ThreadsThatThereAreCanBeStarted) {
  for (const int threads : {1, 2, 50}) EXPECT_EQ(startable_threads(threads), threads);
}

}  // namespace
