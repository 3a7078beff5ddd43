#include "viewer/state/file_watch.h"

#include <chrono>
#include <utility>

namespace glimt {
namespace fs = std::filesystem;
namespace {

constexpr auto interval = std::chrono::milliseconds(200);

}  // namespace

FileWatch::FileWatch(std::function<void()> wake) : wake_(std::move(wake)), thread_([this] { work(); }) {}

FileWatch::~FileWatch() {
  {
    const std::lock_guard lock(mutex_);
    quit_ = true;
  }
  stop_.notify_all();
  thread_.join();
}

void FileWatch::watch(fs::path file) {
  const std::lock_guard lock(mutex_);
  file_ = std::move(file);
  known_ = seen_ = stamp_of(file_);
  changed_ = false;
}

bool FileWatch::changed() {
  const std::lock_guard lock(mutex_);
  return std::exchange(changed_, false);
}

FileWatch::Stamp FileWatch::stamp_of(const fs::path& file) {
  std::error_code missing;
  const auto time = fs::last_write_time(file, missing);
  const auto size = missing ? 0 : fs::file_size(file, missing);
  return missing ? Stamp{} : Stamp{time, size};
}

void FileWatch::work() {
  std::unique_lock lock(mutex_);
  while (!stop_.wait_for(lock, interval, [&] { return quit_; })) {
    if (file_.empty()) continue;
    const Stamp now = stamp_of(file_);
    // Editors may write in several steps or replace the file, so a change counts once two checks agree.
    const bool stays = now == std::exchange(seen_, now);
    if (!stays || now == known_ || now == Stamp{}) continue;
    known_ = now;
    changed_ = true;
    lock.unlock();
    wake_();
    lock.lock();
  }
}

}  // namespace glimt
