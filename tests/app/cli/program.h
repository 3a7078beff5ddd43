#pragma once

#include <sys/types.h>

#include <filesystem>
#include <string>
#include <vector>

/// Runs the built program `glimt` as a separate process without a display.
namespace glimt::program {

struct Result {
  int status = -1;  ///< exit status, or 128 + the signal that ended it
  std::string out, err;
  long peak_kilobytes = 0;  ///< largest resident size; 0 if it ran on a terminal
};

/// glimt running in `folder` with its output piped. It is killed with this object if it has not ended.
class Running {
 public:
  /// `ranks`: how many processes of it mpirun starts; 0: without mpirun.
  Running(const std::vector<std::string>& arguments, const std::filesystem::path& folder, int ranks = 0);
  ~Running();
  Running(const Running&) = delete;
  Running& operator=(const Running&) = delete;

  void send(int signal) const;
  /// Processes that it has started.
  std::vector<pid_t> children() const;
  Result wait();

 private:
  std::string out_, err_;  ///< files with its output
  pid_t process_ = 0;      ///< 0 once it has been waited for
};

/// Runs glimt in `folder` with its output piped.
Result run(const std::vector<std::string>& arguments, const std::filesystem::path& folder, int ranks = 0);

/// Runs glimt in `folder` on a terminal of 100 columns; `out` is what the terminal got. If `interrupt_at` is not empty,
/// presses Ctrl-C once this text was shown.
Result run_on_terminal(const std::vector<std::string>& arguments, const std::filesystem::path& folder,
                       const std::string& interrupt_at = {});

}  // namespace glimt::program
