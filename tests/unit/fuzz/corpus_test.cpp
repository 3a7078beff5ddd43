// What a fuzzer has found, and what it starts from: no file may end the program. The fuzzer itself: tests/README.md.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>

#include "unit/fuzz/targets.h"

namespace glimt::fuzz {
namespace {

namespace fs = std::filesystem;

class FuzzCorpus : public testing::TestWithParam<Target> {};

TEST_P(FuzzCorpus, EndsNoProgram) {
  const Target& target = GetParam();
  int files = 0;
  for (const auto& entry : fs::directory_iterator(fs::path(GLIMT_TESTS_DIR "/data/fuzz") / target.name)) {
    std::ifstream stream(entry.path(), std::ios::binary);
    const std::string bytes(std::istreambuf_iterator<char>(stream), {});
    RecordProperty("last_file", entry.path().string());
    target.run(bytes);
    ++files;
  }
  EXPECT_GT(files, 0);
}

INSTANTIATE_TEST_SUITE_P(, FuzzCorpus, testing::ValuesIn(targets().begin(), targets().end()),
                         [](const auto& target) { return std::string(target.param.name); });

}  // namespace
}  // namespace glimt::fuzz
