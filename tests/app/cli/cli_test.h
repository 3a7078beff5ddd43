#pragma once

#include <gtest/gtest.h>
#include <unistd.h>

#include <fstream>

#include "app/cli/program.h"

/// A test with its own folder, in which it runs the program.
class CommandLine : public testing::Test {
 protected:
  using Arguments = std::vector<std::string>;
  using Result = glimt::program::Result;

  CommandLine() { std::filesystem::create_directories(folder); }
  ~CommandLine() override { std::filesystem::remove_all(folder); }

  Result glimt(const Arguments& arguments) const { return glimt::program::run(arguments, folder); }

  /// `glimt render` of a small picture of hexagon.toml into `out`, with more options.
  Result render(const std::string& out, const Arguments& options = {}) const {
    Arguments arguments{"render", scene, "-o", out, "--size", "24x16"};
    arguments.insert(arguments.end(), options.begin(), options.end());
    return glimt(arguments);
  }

  std::string read(const std::string& name) const {
    std::ifstream stream(folder / name, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), {}};
  }
  void write(const std::string& name, const std::string& text) const {
    std::ofstream(folder / name, std::ios::binary) << text;
  }
  std::size_t files() const {
    return static_cast<std::size_t>(
        std::distance(std::filesystem::directory_iterator(folder), std::filesystem::directory_iterator()));
  }

  const std::string scene = GLIMT_SCENES "/hexagon.toml";
  const std::filesystem::path folder =
      std::filesystem::path(testing::TempDir()) / ("glimt_cli_" + std::to_string(getpid()));
};

inline bool has(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }
