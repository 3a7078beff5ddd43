#include "viewer/controller.h"

#include <exception>
#include <iterator>
#include <utility>

#include "scene/scene_file.h"

namespace glimt {
namespace {

/// Edits of a paused scene that are remembered for its next frame to name; the worker takes up the newest within a few.
constexpr std::size_t max_posted = 64;

}  // namespace

Controller::Controller(Scene scene, std::string stem, const std::function<void()>& wake, Execution execution)
    : stem_(std::move(stem)), snapshots_(wake), session_(execution, wake) {
  show(std::move(scene));
}

bool Controller::poll() {
  bool news = false;
  if (auto frame = session_.frame(); frame != state_.frame) {
    state_.frame = std::move(frame);
    if (state_.frame) posted_.erase(posted_.begin(), shown());
    news = true;
  }
  take_wanted_snapshot();
  if (auto message = snapshots_.take_message()) {
    state_.message = std::move(*message);
    news = true;
  }
  return news;
}

void Controller::apply(const Edits& edits) {
  if (edits.display) state_.display = *edits.display;
  if (edits.scene) {
    try {
      show(*edits.scene);
    } catch (const std::exception& error) {
      state_.message = {error.what(), true};
    }
  }
  if (edits.open) open(*edits.open);
  if (edits.toggle_pause) session_.set_paused(!session_.paused());
  state_.paused = session_.paused();
  if (edits.restart) session_.restart();
  snapshot_wanted_ |= edits.snapshot;
  take_wanted_snapshot();
}

void Controller::open(const std::filesystem::path& scene_file) {
  try {
    show(read_scene(scene_file));
    stem_ = scene_file.stem().string();
    state_.message = {"Opened " + scene_file.filename().string()};
  } catch (const std::exception& error) {
    state_.message = {error.what(), true};
  }
}

void Controller::show(Scene scene) {
  state_.version = session_.post(scene);
  state_.scene = std::move(scene);
  if (state_.message.error) state_.message = {};
  posted_[state_.version] = std::make_shared<const Scene>(state_.scene);
  if (posted_.size() > max_posted) posted_.erase(std::next(posted_.begin()));
}

Controller::Posted::const_iterator Controller::shown() const {
  // A restart's version is not posted; its scene is the one before.
  const auto after = posted_.upper_bound(state_.frame->version);
  return after == posted_.begin() ? after : std::prev(after);
}

void Controller::take_wanted_snapshot() {
  // A preview holds no samples that a reopened snapshot could come back to.
  if (!snapshot_wanted_ || !state_.frame || state_.frame->samples == 0) return;
  snapshot_wanted_ = false;
  snapshots_.write({state_.frame, shown()->second, state_.display}, stem_);
}

}  // namespace glimt
