#pragma once

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <string>

namespace glimt::testing {

/// A test with its own folder, which is the current folder and is removed after the test.
class OwnFolder : public ::testing::Test {
 protected:
  void SetUp() override {
    std::filesystem::create_directories(folder);
    std::filesystem::current_path(folder);
  }
  void TearDown() override {
    std::filesystem::current_path(came_from);
    std::filesystem::remove_all(folder);
  }
  const std::filesystem::path came_from = std::filesystem::current_path();
  const std::filesystem::path folder =
      std::filesystem::path(::testing::TempDir()) / ("glimt_test_" + std::to_string(getpid()));
};

}  // namespace glimt::testing
