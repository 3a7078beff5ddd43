#pragma once

#include <filesystem>
#include <string>
#include <vector>

/// The built program `glimt` as tests run it: as a process of its own, without a display.
namespace glimt::program {

struct Result {
  int status = -1;  ///< exit status, or 128 + the signal that ended it
  std::string out, err;
};

/// Runs glimt in `folder` with its output piped.
Result run(const std::vector<std::string>& arguments, const std::filesystem::path& folder);

/// Runs glimt in `folder` with a terminal of 100 columns; `out` is what the terminal got. Where `interrupt_at` is not
/// empty, Ctrl-C is pressed once that text has been shown.
Result run_on_terminal(const std::vector<std::string>& arguments, const std::filesystem::path& folder,
                       const std::string& interrupt_at = {});

}  // namespace glimt::program
