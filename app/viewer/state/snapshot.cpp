#include "viewer/state/snapshot.h"

#include <cerrno>
#include <chrono>
#include <cstdio>
#include <cstring>
#include <utility>

#include "film/file_bytes.h"
#include "film/image_file.h"
#include "film/metadata.h"
#include "viewer/picture/shown_image.h"

namespace glimt {
namespace {

/// Writes a file under a free name, and removes it if `write` throws. The message is the file's name and `what`, or why
/// it was not saved.
Message write_now(const std::string& stem, const std::string& ending, const std::string& what,
                  const std::function<void(const std::filesystem::path&)>& write) {
  try {
    const auto file = reserve_snapshot_file(".", stem, ending);
    try {
      write(file);
    } catch (...) {
      std::error_code ignored;
      std::filesystem::remove(file, ignored);
      throw;
    }
    return {"Saved " + file.filename().string() + what};
  } catch (const std::exception& error) {
    return {std::string("Not saved: ") + error.what(), true};
  }
}

void write_picture(const Snapshot& snapshot, const std::filesystem::path& file) {
  const Frame& frame = *snapshot.frame;
  Metadata metadata = render_metadata(*snapshot.scene, frame.samples, frame.seconds);
  // Rendered anew the scene comes to the same values, but not to the same bits.
  if (frame.continued_from > 0) metadata["continued_from_samples"] = std::to_string(frame.continued_from);
  if (snapshot.radiance)
    write_exr(file, frame.mean, frame.error, metadata);
  else
    write_png(file, *shown_image(snapshot.frame, snapshot.display.view), snapshot.display, metadata);
}

}  // namespace

bool is_complete(const Snapshot& snapshot) {
  // A preview has no samples, so a reopened snapshot could not render the same picture.
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
  run([snapshot = std::move(snapshot), stem = std::move(stem)] {
    const std::string what = " (" + std::to_string(snapshot.frame->samples) + " samples per pixel)";
    return write_now(stem, snapshot.radiance ? "exr" : "png", what,
                     [&](const std::filesystem::path& file) { write_picture(snapshot, file); });
  });
}

void SnapshotWriter::write(std::string text, std::string stem, std::string ending) {
  run([text = std::move(text), stem = std::move(stem), ending = std::move(ending)] {
    return write_now(stem, ending, "", [&](const std::filesystem::path& file) { replace_file(file, text); });
  });
}

void SnapshotWriter::run(std::function<Message()> job) {
  std::erase_if(jobs_, [](auto& old) { return old.wait_for(std::chrono::seconds(0)) == std::future_status::ready; });
  jobs_.push_back(std::async(std::launch::async, [this, job = std::move(job)] {
    Message message = job();
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
