#include "viewer/snapshot.h"

#include <cerrno>
#include <chrono>
#include <cstdio>
#include <cstring>
#include <utility>

#include "film/image_file.h"
#include "film/metadata.h"
#include "viewer/shown_image.h"

namespace glimt {
namespace {

Message write_now(const Snapshot& snapshot, const std::string& stem) {
  try {
    const auto file = reserve_snapshot_file(".", stem, snapshot.radiance ? "exr" : "png");
    try {
      const Frame& frame = *snapshot.frame;
      const Metadata metadata = render_metadata(*snapshot.scene, frame.samples, frame.seconds);
      if (snapshot.radiance)
        write_exr(file, frame.mean, frame.error, metadata);
      else
        write_png(file, *shown_image(snapshot.frame, snapshot.display.view), snapshot.display, metadata);
    } catch (...) {
      std::error_code ignored;
      std::filesystem::remove(file, ignored);
      throw;
    }
    return {"Saved " + file.filename().string() + " (" + std::to_string(snapshot.frame->samples) +
            " samples per pixel)"};
  } catch (const std::exception& error) {
    return {std::string("Snapshot not saved: ") + error.what(), true};
  }
}

}  // namespace

bool is_complete(const Snapshot& snapshot) {
  // A preview holds no samples that a reopened snapshot could come back to.
  if (!snapshot.frame || snapshot.frame->samples == 0) return false;
  return shown_image(snapshot.frame, snapshot.radiance ? View::error : snapshot.display.view) != nullptr;
}

std::filesystem::path reserve_snapshot_file(const std::filesystem::path& folder, const std::string& stem,
                                            const std::string& ending) {
  for (int n = 1;; ++n) {
    char number[16];
    std::snprintf(number, sizeof number, "-%03d.", n);
    auto file = folder / (stem + number + ending);
    if (std::FILE* created = std::fopen(file.c_str(), "wbx")) {
      std::fclose(created);
      return file;
    }
    if (errno != EEXIST) throw ImageFileError(file.string() + ": cannot be written: " + std::strerror(errno));
  }
}

void SnapshotWriter::write(Snapshot snapshot, std::string stem) {
  std::erase_if(jobs_, [](auto& job) { return job.wait_for(std::chrono::seconds(0)) == std::future_status::ready; });
  jobs_.push_back(std::async(std::launch::async, [this, snapshot = std::move(snapshot), stem = std::move(stem)] {
    Message message = write_now(snapshot, stem);
    {
      const std::lock_guard lock(mutex_);
      message_ = std::move(message);
    }
    wake_();
  }));
}

std::optional<Message> SnapshotWriter::take_message() {
  const std::lock_guard lock(mutex_);
  return std::exchange(message_, std::nullopt);
}

}  // namespace glimt
