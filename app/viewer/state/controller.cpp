#include "viewer/state/controller.h"

#include <algorithm>
#include <exception>
#include <iterator>
#include <regex>
#include <stdexcept>
#include <utility>

#include "film/file_bytes.h"
#include "film/image_file.h"
#include "import/import.h"
#include "scene/file/scene_file.h"
#include "scene/surroundings.h"
#include "viewer/chart_view/chart_export.h"

namespace glimt {
namespace fs = std::filesystem;
namespace {

/// How many posted scenes are kept until a frame shows one of them. The worker skips to the newest within a few.
constexpr std::size_t max_posted = 64;

/// Of what has no counterpart.
std::string told_of(const std::vector<ImportNote>& notes) {
  if (notes.empty()) return {};
  std::string text = ". " + text_of(notes.front());
  if (notes.size() > 1) text += "; and " + std::to_string(notes.size() - 1) + " more, which glimt import lists";
  return text;
}

bool is_picture(const fs::path& file) { return file.extension() == ".png" || file.extension() == ".exr"; }
bool is_checkpoint(const fs::path& file) { return file.extension() == ".ckpt"; }

/// The file's name without its ending, and without the number of a snapshot.
std::string stem_of(const fs::path& file) {
  static const std::regex number("-[0-9]{3,}$");
  return is_picture(file) ? std::regex_replace(file.stem().string(), number, "") : file.stem().string();
}

/// Samples after which an all-black picture counts as black. Fewer may have missed a small lamp.
constexpr int enough_samples = 16;

bool is_black(const Frame& frame) {
  return (frame.finished || frame.samples >= enough_samples) &&
         std::ranges::all_of(frame.mean.rgb, [](float value) { return value == 0; });
}

}  // namespace

Controller::Controller(Scene scene, fs::path file, const std::function<void()>& wake, Execution execution,
                       const RenderGoal& goal, const std::optional<ImageSize>& room)
    : snapshots_(wake), watch_(wake), session_(execution, wake), charting_(state_.chart, wake, execution) {
  state_.fits_window = room.has_value();
  if (room) state_.room = next_room_ = *room;
  state_.opened_camera = scene.camera;
  state_.opened_size = scene.image;
  const RenderGoal first = goal_for(scene, goal);
  show(Document{std::make_shared<const Scene>(std::move(scene)), {}, first});
  set_file(std::move(file));
}

void Controller::recall(const Display& display, const ChartView& chart, fs::path folder, bool show_hint,
                        const std::string& note, DragView drag_view) {
  state_.display = display;
  state_.drag_view = drag_view;
  state_.chart.view = chart;
  if (!folder.empty()) state_.folder = std::move(folder);
  state_.hint = show_hint;
  if (!note.empty()) state_.message = {note, true};
}

void Controller::autosave(const fs::path& folder, double every) {
  try {
    autosave_.emplace(folder);
    session_.keep(every, [file = autosave_->file()](const Checkpoint& checkpoint) {
      try {
        write_checkpoint(file, checkpoint);
      } catch (const ImageFileError&) {  // a full disk must not disturb the window
      }
    });
    if (!autosave_->left_behind()) return;
    const Checkpoint checkpoint = read_checkpoint(*autosave_->left_behind());
    state_.left_behind = {checkpoint.scene.name, checkpoint.film.samples()};
  } catch (const CheckpointError& error) {
    autosave_->forget_left_behind();
    state_.message = {error.what(), true};
  } catch (const std::exception& error) {
    state_.message = {error.what(), true};
  }
}

bool Controller::poll() {
  bool news = false;
  // Once the scene is edited, more samples of the old one are not worth showing: the answer is on its way.
  const auto outdated = [&](const Frame& frame) {
    return state_.frame && frame.version == state_.frame->version && frame.version < state_.version;
  };
  if (auto frame = session_.frame(); frame != state_.frame && !(frame && outdated(*frame))) {
    state_.frame = std::move(frame);
    state_.black = state_.frame && is_black(*state_.frame);
    if (state_.frame) posted_.erase(posted_.begin(), shown());
    if (state_.frame && shown()->second == posted_scene_) charting_.add(state_.frame);
    news = true;
  }
  std::string error;
  news |= charting_.poll(error);
  if (!error.empty()) state_.message = {error, true};
  leave_machine_to_chart();
  news |= fit_to_room();
  take_wanted_snapshots();
  if (auto message = snapshots_.take_message()) {
    state_.message = std::move(*message);
    news = true;
  }
  if (watch_.changed()) {
    reload();
    news = true;
  }
  return news;
}

void Controller::apply(const Edits& edits) {
  if (edits.display) state_.display = *edits.display;
  if (edits.folder) state_.folder = *edits.folder;
  if (edits.select) state_.selected = *edits.select;
  if (edits.dismiss_hint || edits.scene || edits.select) state_.hint = false;
  if (edits.room && *edits.room != next_room_) {
    next_room_ = *edits.room;
    room_changed_ = std::chrono::steady_clock::now();
  }
  if (edits.fits_window) {
    state_.fits_window = *edits.fits_window;
    state_.room = next_room_;
  }
  const bool followed = state_.following;
  if (edits.scene || edits.goal || edits.toggle_pause || edits.restart) stop_following();
  if (edits.scene || edits.goal) {
    Document after = now();
    if (edits.scene)
      after.scene = std::make_shared<const Scene>(as_filed(*edits.scene, *after.scene, state_.fits_window));
    if (edits.goal) after.goal = *edits.goal;
    try {
      edit(after, edits.gesture);
    } catch (const std::exception& error) {
      state_.message = {error.what(), true};
    }
  }
  if (edits.fits_window) show(now());
  if (edits.undo) show(history_.undo(now()));
  if (edits.redo) show(history_.redo(now()));
  if (edits.open) open(*edits.open);
  if (edits.save) save(*edits.save);
  if (edits.recover) recover();
  if (edits.forget_left_behind) forget_left_behind();
  if (edits.toggle_pause && !followed) session_.set_paused(!session_.paused());
  if (edits.restart) session_.restart();
  if (edits.snapshot) want_snapshot(false);
  if (edits.snapshot_exr) want_snapshot(true);
  take_wanted_snapshots();
  state_.can_undo = history_.can_undo();
  state_.can_redo = history_.can_redo();
  if (edits.compare) {
    if (edits.compare->held.frame != state_.compare.held.frame)
      state_.message = {"Held to compare with: " + edits.compare->held.label + ". X compares, B flips"};
    state_.compare = *edits.compare;
  }
  if (edits.inspect) state_.inspect = *edits.inspect;
  if (edits.drag_view) state_.drag_view = *edits.drag_view;
  charting_.apply(edits);
  export_chart(edits);
  leave_machine_to_chart();
}

void Controller::leave_machine_to_chart() {
  if (charting_.busy() && !resume_ && !session_.paused()) {
    // Times are right only while nothing else is rendered.
    resume_ = true;
    session_.set_paused(true);
  } else if (!charting_.busy() && resume_) {
    resume_ = false;
    session_.set_paused(false);
  }
  state_.paused = session_.paused();
}

void Controller::export_chart(const Edits& edits) {
  const auto& curves = state_.chart.curves.all();
  if (edits.export_csv) snapshots_.write(curves_csv(curves), stem_ + "-chart", "csv");
  if (edits.export_svg)
    snapshots_.write(curves_svg(curves, state_.chart.view.across, state_.scene.name), stem_ + "-chart", "svg");
}

void Controller::edit(const Document& after, std::uint64_t gesture) {
  Document before = now();
  if (*after.scene == *before.scene && after.goal == before.goal) return;
  show(after, gesture);
  history_.edited(std::move(before), gesture);
}

Document Controller::now() const { return {state_.filed, state_.file, state_.goal}; }

bool Controller::fit_to_room() {
  constexpr auto rest = std::chrono::milliseconds(150);
  if (!fitting() || std::chrono::steady_clock::now() - room_changed_ < rest) return false;
  state_.room = next_room_;
  show(now());
  return true;
}

void Controller::show(const std::optional<Document>& document) {
  if (!document) return;
  stop_following();
  show(*document);
  if (document->file != state_.file) set_file(document->file);
}

void Controller::show(const Document& document, std::uint64_t gesture, std::shared_ptr<const Checkpoint> begun) {
  const auto size = state_.fits_window ? std::optional(state_.room) : std::nullopt;
  auto scene = std::make_shared<const Scene>(as_shown(*document.scene, document.goal, size));
  state_.filed = document.scene;
  if (!begun && posted_scene_ && *scene == *posted_scene_ && document.goal == state_.goal) return;
  state_.version = begun ? session_.post(std::move(begun)) : session_.post(*scene);
  state_.compiled = session_.compiled();
  state_.scene = *scene;
  state_.goal = document.goal;
  state_.enclosed = is_enclosed(*scene, scene->camera.eye);
  if (state_.selected && !contains(state_.scene, *state_.selected)) state_.selected.reset();
  if (state_.message.error) state_.message = {};
  posted_[state_.version] = scene;
  posted_scene_ = std::move(scene);
  charting_.show(posted_scene_, gesture);
  if (posted_.size() > max_posted) posted_.erase(std::next(posted_.begin()));
}

void Controller::set_file(fs::path file) {
  stem_ = stem_of(file);
  if (file.has_parent_path()) state_.folder = file.parent_path();
  if (is_picture(file) || is_importable(file)) file.clear();
  watch_.watch(file);
  state_.following = is_checkpoint(file);
  followed_ = state_.following ? std::exchange(file, {}) : fs::path();
  state_.file = std::move(file);
}

void Controller::open(const fs::path& file) {
  try {
    if (is_checkpoint(file))
      follow(file);
    else if (is_picture(file))
      open_picture(file);
    else
      open_scene(file);
    state_.opened_camera = state_.scene.camera;
    state_.opened_size = state_.filed->image;
    session_.set_paused(state_.following);
  } catch (const std::exception& error) {
    state_.message = {error.what(), true};
  }
}

void Controller::open_scene(const fs::path& file) {
  ImportedScene opened = read_or_import(file);
  Scene& scene = opened.scene;
  const RenderGoal goal = goal_for(scene, state_.goal);
  state_.opened_size = scene.image;
  edit({std::make_shared<const Scene>(std::move(scene)), state_.file, goal});
  set_file(file);
  state_.message = {"Opened " + file.filename().string() + told_of(opened.notes)};
}

void Controller::open_picture(const fs::path& file) {
  const Metadata metadata = read_metadata(file);
  const auto scene = metadata.find("scene");
  if (scene == metadata.end())
    throw std::runtime_error(file.string() + ": holds no scene; allowed are pictures that glimt has written");
  // Rendering stops at the number of samples the picture had, so it is the same picture again.
  Scene made = parse_scene(scene->second, file.string());
  RenderGoal goal = state_.goal;
  goal.stop_at = StopAt::samples;
  goal.samples = made.render.spp;
  state_.fits_window = false;
  edit({std::make_shared<const Scene>(std::move(made)), state_.file, goal});
  show(now());  // at its own size, even if edit() found nothing to change
  set_file(file);
  if (metadata.contains("exposure")) state_.display = read_display(metadata);
  state_.message = {"Opened the scene in " + file.filename().string()};
}

Document Controller::open_checkpoint(const fs::path& file) {
  Checkpoint checkpoint = read_checkpoint(file);
  if (checkpoint.scene.render.spp == max_spp) checkpoint.scene.render.spp = Settings{}.spp;  // a window's has no end
  Document before = now();
  const Document document{
      std::make_shared<const Scene>(checkpoint.scene), {}, {StopAt::never, state_.goal.samples, state_.goal.error}};
  checkpoint.scene = as_shown(checkpoint.scene, document.goal, {});
  const bool fitted = std::exchange(state_.fits_window, false);
  try {
    show(document, 0, std::make_shared<const Checkpoint>(std::move(checkpoint)));
  } catch (...) {
    state_.fits_window = fitted;
    throw;
  }
  return before;
}

void Controller::follow(const fs::path& file) {
  const bool paused = session_.paused();
  session_.set_paused(true);  // before there is a film to add to
  try {
    history_.edited(open_checkpoint(file), 0);
  } catch (...) {
    session_.set_paused(paused);
    throw;
  }
  set_file(file);
  state_.message = {"Follows " + file.filename().string() + " as it grows. Space goes on from what there is"};
}

void Controller::stop_following() {
  if (!state_.following) return;
  state_.following = false;
  watch_.watch({});
  session_.set_paused(false);
}

void Controller::recover() {
  if (!state_.left_behind) return;
  try {
    history_.edited(open_checkpoint(*autosave_->left_behind()), 0);
    set_file({});
    state_.opened_camera = state_.scene.camera;
    state_.opened_size = state_.filed->image;
    session_.set_paused(false);
    state_.message = {"Goes on with " + state_.left_behind->scene};
    forget_left_behind();  // not where it failed: the samples are still there to be merged or opened by hand
  } catch (const std::exception& error) {
    state_.message = {error.what(), true};
  }
}

void Controller::forget_left_behind() {
  if (autosave_) autosave_->forget_left_behind();
  state_.left_behind.reset();
}

void Controller::save(const fs::path& file) {
  try {
    replace_file(file, write_scene(*state_.filed, fs::absolute(file).parent_path()));
    set_file(file);
    state_.message = {"Saved " + file.filename().string()};
  } catch (const std::exception& error) {
    state_.message = {error.what(), true};
  }
}

void Controller::reload() {
  try {
    if (state_.following) {
      open_checkpoint(followed_);
      return;
    }
    edit({std::make_shared<const Scene>(read_scene(state_.file)), state_.file, state_.goal});
    state_.opened_camera = state_.scene.camera;
    state_.message = {"Read " + state_.file.filename().string() + " again, which has changed"};
  } catch (const std::exception& error) {
    state_.message = {error.what(), true};
  }
  state_.can_undo = history_.can_undo();
  state_.can_redo = history_.can_redo();
}

Controller::Posted::const_iterator Controller::shown() const {
  // A restart has a version that was not posted; its scene is the one posted before.
  const auto after = posted_.upper_bound(state_.frame->version);
  return after == posted_.begin() ? after : std::prev(after);
}

void Controller::want_snapshot(bool radiance) {
  wanted_.push_back({.frame = {}, .scene = {}, .display = state_.display, .radiance = radiance});
}

void Controller::take_wanted_snapshots() {
  std::erase_if(wanted_, [&](Snapshot& snapshot) {
    snapshot.frame = state_.frame;
    if (!is_complete(snapshot)) return false;
    snapshot.scene = shown()->second;
    snapshots_.write(std::move(snapshot), stem_);
    return true;
  });
  bool error_wanted = state_.display.view == View::error || state_.inspect;
  for (const Snapshot& snapshot : wanted_) error_wanted |= snapshot.radiance || snapshot.display.view == View::error;
  session_.set_error_wanted(error_wanted);
}

}  // namespace glimt
