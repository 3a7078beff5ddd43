#pragma once

#include <chrono>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "render/session.h"
#include "viewer/state/autosave.h"
#include "viewer/state/file_watch.h"
#include "viewer/state/history.h"
#include "viewer/state/snapshot.h"
#include "viewer/state/state.h"

namespace glimt {

/// Owns what the window shows and carries out what the person asks for. Uses neither OpenGL nor ImGui. No function
/// waits for rendering.
class Controller {
 public:
  /// Starts to render the scene, which came from `file`. `wake` is called on other threads when poll() has news. With
  /// `room`, the picture has that size: the free space in the window, framebuffer pixels. Throws SceneError.
  Controller(Scene scene, std::filesystem::path file, const std::function<void()>& wake, Execution execution = {},
             const RenderGoal& goal = {}, const std::optional<ImageSize>& room = {});

  const ViewerState& state() const { return state_; }
  /// Whether the picture waits for its new size, so that poll() will have news without a wake.
  bool fitting() const { return state_.fits_window && next_room_ != state_.room; }
  /// Takes what the window remembers from its last start. Call it before the first edits.
  void recall(const Display& display, const ChartView& chart, std::filesystem::path folder, bool show_hint,
              const std::string& note, DragView drag_view = DragView::automatic);
  /// Keeps scene and samples in this folder every so many seconds, and offers what a crashed program has left there.
  void autosave(const std::filesystem::path& folder, double every = 30);
  /// Takes in finished frames and snapshots, and a scene file that has changed on disk; true where there was one.
  bool poll();
  /// Carries out edits. An edit that is refused, or a file that cannot be read, changes nothing; the message says why.
  void apply(const Edits& edits);

 private:
  using Posted = std::map<std::uint64_t, std::shared_ptr<const Scene>>;  ///< by version

  /// The scene that the frame shows.
  Posted::const_iterator shown() const;
  Document now() const;
  /// With `begun`, which is of the document's scene as shown, from its samples on.
  void show(const Document& document, std::uint64_t gesture = 0, std::shared_ptr<const Checkpoint> begun = {});
  void show(const std::optional<Document>& document);
  void edit(const Document& after, std::uint64_t gesture = 0);
  /// Gives the picture the size of its room once that has not changed for a while. Returns true if it did.
  bool fit_to_room();
  void set_file(std::filesystem::path file);
  void open(const std::filesystem::path& file);
  void open_scene(const std::filesystem::path& file);
  void open_picture(const std::filesystem::path& file);
  /// Shows its samples and returns what there was before.
  Document open_checkpoint(const std::filesystem::path& file);
  void follow(const std::filesystem::path& file);
  void stop_following();
  void recover();
  void forget_left_behind();
  void save(const std::filesystem::path& file);
  void reload();
  void want_snapshot(bool radiance);
  void export_chart(const Edits& edits);
  void leave_machine_to_chart();
  void take_wanted_snapshots();

  ViewerState state_;
  ImageSize next_room_{};  ///< for the picture; becomes state_.room once the window keeps its size
  std::chrono::steady_clock::time_point room_changed_;
  std::string stem_;                           ///< begins the names of snapshots
  std::shared_ptr<const Scene> posted_scene_;  ///< the same as state_.scene
  History history_;
  Posted posted_;                 ///< from the one that the frame shows on
  std::vector<Snapshot> wanted_;  ///< taken from the next frame that holds what they show
  SnapshotWriter snapshots_;
  FileWatch watch_;
  std::optional<Autosave> autosave_;  ///< lives longer than the session, which writes it
  Session session_;
  Charting charting_;
  std::filesystem::path followed_;  ///< the checkpoint that is followed
  bool resume_ = false;             ///< once the chart needs the machine no more
};

}  // namespace glimt
