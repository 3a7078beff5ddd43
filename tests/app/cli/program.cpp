#include "app/cli/program.h"

#include <fcntl.h>
#include <pty.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <utility>

namespace glimt::program {
namespace fs = std::filesystem;
namespace {

[[noreturn]] void become_glimt(const std::vector<std::string>& arguments, const fs::path& folder, int ranks = 0) {
  std::vector<std::string> words{GLIMT_PROGRAM};
  if (ranks > 0) {
    words = {GLIMT_MPIRUN, "-n", std::to_string(ranks), GLIMT_PROGRAM};
    // More ranks than cores, and root in a container.
    for (const char* name : {"OMPI_ALLOW_RUN_AS_ROOT", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM",
                             "OMPI_MCA_rmaps_base_oversubscribe", "OMPI_MCA_mpi_yield_when_idle"})
      setenv(name, "1", 1);
    setenv("OMPI_MCA_hwloc_base_binding_policy", "none", 1);
    setenv("OMPI_MCA_plm", "isolated", 1);  // starts nothing elsewhere, so it wants no ssh
  }
  words.insert(words.end(), arguments.begin(), arguments.end());
  std::vector<char*> argv;
  for (auto& word : words) argv.push_back(word.data());
  argv.push_back(nullptr);
  unsetenv("DISPLAY");
  unsetenv("WAYLAND_DISPLAY");
  if (chdir(folder.c_str()) == 0) execv(argv[0], argv.data());
  _exit(127);
}

int wait_for(pid_t child, rusage* usage = nullptr) {
  int status = 0;
  wait4(child, &status, 0, usage);
  return WIFSIGNALED(status) ? 128 + WTERMSIG(status) : WEXITSTATUS(status);
}

std::string take(const fs::path& file) {
  std::string text;
  {
    std::ifstream stream(file, std::ios::binary);
    text.assign(std::istreambuf_iterator<char>(stream), {});
  }
  fs::remove(file);
  return text;
}

}  // namespace

Running::Running(const std::vector<std::string>& arguments, const fs::path& folder, int ranks) {
  const std::string stem = fs::path(folder).string() + "." + std::to_string(getpid());
  out_ = stem + ".out";
  err_ = stem + ".err";
  process_ = fork();
  if (process_ < 0) throw std::runtime_error("fork failed");
  if (process_ == 0) {
    dup2(open("/dev/null", O_RDONLY), STDIN_FILENO);
    dup2(open(out_.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600), STDOUT_FILENO);
    dup2(open(err_.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600), STDERR_FILENO);
    become_glimt(arguments, folder, ranks);
  }
}

Running::~Running() {
  if (process_ == 0) return;
  send(SIGKILL);
  wait();
}

void Running::send(int signal) const { kill(process_, signal); }

std::vector<pid_t> Running::children() const {
  const std::string process = std::to_string(process_);
  std::ifstream stream("/proc/" + process + "/task/" + process + "/children");
  return {std::istream_iterator<pid_t>(stream), {}};
}

Result Running::wait() {
  Result result;
  rusage usage{};
  result.status = wait_for(std::exchange(process_, 0), &usage);
  result.peak_kilobytes = usage.ru_maxrss;
  result.out = take(out_);
  result.err = take(err_);
  return result;
}

Result run(const std::vector<std::string>& arguments, const fs::path& folder, int ranks) {
  return Running(arguments, folder, ranks).wait();
}

Result run_on_terminal(const std::vector<std::string>& arguments, const fs::path& folder,
                       const std::string& interrupt_at) {
  winsize size{};
  size.ws_row = 24;
  size.ws_col = 100;
  int terminal = -1;
  const pid_t child = forkpty(&terminal, nullptr, nullptr, &size);
  if (child < 0) throw std::runtime_error("forkpty failed");
  if (child == 0) become_glimt(arguments, folder);
  Result result;
  bool pressed = interrupt_at.empty();
  char buffer[4096];
  while (true) {
    const ssize_t count = read(terminal, buffer, sizeof buffer);
    if (count <= 0) break;  // EIO once the program has closed its end
    result.out.append(buffer, static_cast<std::size_t>(count));
    if (!pressed && result.out.find(interrupt_at) != std::string::npos) pressed = write(terminal, "\x03", 1) == 1;
  }
  result.status = wait_for(child);
  close(terminal);
  return result;
}

}  // namespace glimt::program
