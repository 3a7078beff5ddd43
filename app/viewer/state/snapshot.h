#pragma once

#include <filesystem>
#include <functional>
#include <future>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "viewer/state/state.h"

namespace glimt {

/// A picture of what the window shows, and what made it.
struct Snapshot {
  std::shared_ptr<const Frame> frame;
  std::shared_ptr<const Scene> scene;  ///< the one that the frame shows
  Display display;
  bool radiance = false;  ///< an EXR of radiance, not a PNG
};

/// Whether the frame holds what the snapshot shows.
bool is_complete(const Snapshot& snapshot);

/// Creates the first of STEM-001.ENDING, STEM-002.ENDING, ... that does not exist in the folder. The file is empty; it
/// reserves the name. Throws ImageFileError.
std::filesystem::path reserve_snapshot_file(const std::filesystem::path& folder, const std::string& stem,
                                            const std::string& ending);

/// Writes files in the background. The destructor waits until all are written.
class SnapshotWriter {
 public:
  /// Calls `wake` on another thread when a message is there.
  explicit SnapshotWriter(std::function<void()> wake) : wake_(std::move(wake)) {}

  /// Writes STEM-NNN.png or .exr into the current folder, never over another file.
  void write(Snapshot snapshot, std::string stem);
  /// The same for a text, as STEM-NNN.ENDING.
  void write(std::string text, std::string stem, std::string ending);
  /// What became of the last file, given once.
  std::optional<Message> take_message();

 private:
  void run(std::function<Message()> job);

  std::function<void()> wake_;
  std::mutex mutex_;
  std::optional<Message> message_;
  std::vector<std::future<void>> jobs_;
};

}  // namespace glimt
