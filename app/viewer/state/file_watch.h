#pragma once

#include <condition_variable>
#include <filesystem>
#include <functional>
#include <mutex>
#include <thread>

namespace glimt {

/// Checks a few times a second, on its own thread, whether a file has changed on disk.
class FileWatch {
 public:
  /// Calls `wake` on that thread when changed() has become true.
  explicit FileWatch(std::function<void()> wake);
  ~FileWatch();
  FileWatch(const FileWatch&) = delete;
  FileWatch& operator=(const FileWatch&) = delete;

  /// Watches this file from now on, none where empty. Its present state counts as known.
  void watch(std::filesystem::path file);
  /// Whether the file has changed since the last call and has stayed the same for one check since.
  bool changed();

 private:
  void work();

  std::function<void()> wake_;
  std::mutex mutex_;
  std::condition_variable stop_;
  std::filesystem::path file_;
  struct Stamp {
    std::filesystem::file_time_type time;
    std::uintmax_t size = 0;
    bool operator==(const Stamp&) const = default;
  };
  static Stamp stamp_of(const std::filesystem::path& file);
  Stamp known_, seen_;
  bool changed_ = false, quit_ = false;
  std::thread thread_;
};

}  // namespace glimt
