#pragma once

#include <functional>
#include <mutex>
#include <optional>
#include <thread>
#include <utility>

namespace glimt {

/// Does one piece of work at a time on its own thread. The destructor waits for it.
template <class T>
class Background {
 public:
  /// `wake` is called on that thread when the result is there.
  explicit Background(std::function<void()> wake) : wake_(std::move(wake)) {}

  /// True from start() until the result is taken.
  bool busy() const { return busy_; }
  /// May be called only while it is not busy. The work must not throw.
  void start(std::function<T()> work) {
    busy_ = true;
    thread_ = std::jthread([this, work = std::move(work)] {
      T result = work();
      {
        const std::lock_guard lock(mutex_);
        result_ = std::move(result);
      }
      wake_();
    });
  }
  /// The result, given once; nothing while it is not there.
  std::optional<T> take() {
    if (!busy_) return std::nullopt;
    const std::lock_guard lock(mutex_);
    if (result_) busy_ = false;
    return std::exchange(result_, std::nullopt);
  }

 private:
  std::function<void()> wake_;
  std::mutex mutex_;
  std::optional<T> result_;
  bool busy_ = false;
  std::jthread thread_;
};

}  // namespace glimt
