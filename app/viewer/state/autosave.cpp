#include "viewer/state/autosave.h"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <stdexcept>
#include <string>
#include <system_error>
#include <utility>

#include "film/file_bytes.h"

namespace glimt {
namespace fs = std::filesystem;
namespace {

fs::path lock_of(fs::path file) { return file.replace_extension(".lock"); }

/// Opens the file and locks it until it is closed, also by a crash; -1 where another program has it.
int lock_file(const fs::path& file, int flags) {
  const int lock = open(file.c_str(), O_RDWR | O_CLOEXEC | flags, 0600);
  if (lock < 0 || flock(lock, LOCK_EX | LOCK_NB) == 0) return lock;
  close(lock);
  return -1;
}

void remove_both(const fs::path& file) {
  std::error_code ignored;
  remove_unfinished(file);
  fs::remove(file, ignored);
  fs::remove(lock_of(file), ignored);
}

}  // namespace

fs::path autosave_folder() {
  for (const auto& [variable, below] : {std::pair{"XDG_STATE_HOME", ""}, std::pair{"HOME", ".local/state"}})
    if (const char* value = std::getenv(variable); value && *value) return fs::path(value) / below / "glimt";
  return {};
}

Autosave::Autosave(fs::path folder) : folder_(std::move(folder)) {
  std::error_code failed;
  fs::create_directories(folder_, failed);
  for (int number = 1; lock_ < 0; ++number) {
    file_ = folder_ / ("window-" + std::to_string(number) + ".ckpt");
    lock_ = lock_file(lock_of(file_), O_CREAT | O_EXCL);
    if (lock_ < 0 && errno != EEXIST)
      throw std::runtime_error("nothing can be kept in " + folder_.string() + ": " +
                               std::generic_category().message(errno));
  }
  find_left_behind();
}

Autosave::~Autosave() {
  remove_both(file_);
  close(lock_);
  if (left_behind_lock_ >= 0) close(left_behind_lock_);
}

void Autosave::find_left_behind() {
  std::error_code failed;
  for (const auto& entry : fs::directory_iterator(folder_, failed)) {
    if (entry.path().extension() != ".lock" || entry.path() == lock_of(file_)) continue;
    const int lock = lock_file(entry.path(), 0);
    if (lock < 0) continue;
    const fs::path file = fs::path(entry.path()).replace_extension(".ckpt");
    const auto written = fs::last_write_time(file, failed);
    if (failed) {
      remove_both(file);  // ended before there was anything to keep
      close(lock);
    } else if (left_behind_ && written < fs::last_write_time(*left_behind_, failed)) {
      close(lock);
    } else {
      if (left_behind_lock_ >= 0) close(left_behind_lock_);
      left_behind_ = file;
      left_behind_lock_ = lock;
    }
  }
}

void Autosave::forget_left_behind() {
  if (!left_behind_) return;
  remove_both(*left_behind_);
  close(std::exchange(left_behind_lock_, -1));
  left_behind_.reset();
}

}  // namespace glimt
