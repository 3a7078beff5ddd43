#pragma once

#include <chrono>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "render/session.h"
#include "viewer/state/file_watch.h"
#include "viewer/state/history.h"
#include "viewer/state/snapshot.h"
#include "viewer/state/state.h"

namespace glimt {

/// Owns what the window shows and carries out what its user asks for. Knows neither OpenGL nor ImGui; no function waits
/// for rendering.
class Controller {
 public:
  /// Starts to render the scene, which is from `file`. `wake` is called on other threads when poll() has news. Throws
  /// SceneError.
  /// With `room` the picture has the size of the room for it in the window, framebuffer pixels.
  Controller(Scene scene, std::filesystem::path file, const std::function<void()>& wake, Execution execution = {},
             const RenderGoal& goal = {}, const std::optional<ImageSize>& room = {});

  const ViewerState& state() const { return state_; }
  /// poll() will have news though nothing wakes the window: the room for the picture has changed.
  bool fitting() const { return state_.fits_window && next_room_ != state_.room; }
  /// What the window remembers from its last start. To be called before the first edits.
  void recall(const Display& display, const ChartView& chart, std::filesystem::path folder, bool show_hint,
              const std::string& note, DragView drag_view = DragView::automatic);
  /// Takes in finished frames and snapshots, and a scene file that has changed on disk; true where there was one.
  bool poll();
  /// Carries out edits. One that is refused, and a file that cannot be read, change nothing and say why in the message.
  void apply(const Edits& edits);

 private:
  using Posted = std::map<std::uint64_t, std::shared_ptr<const Scene>>;  ///< by version

  /// The scene that the frame shows.
  Posted::const_iterator shown() const;
  Document now() const;
  void show(const Document& document, std::uint64_t gesture = 0);
  void show(const std::optional<Document>& document);
  void edit(const Document& after, std::uint64_t gesture = 0);
  /// Gives the picture the size of its room, once that has rested for a while. False where it has it already.
  bool fit_to_room();
  void set_file(std::filesystem::path file);
  void open(const std::filesystem::path& file);
  void open_scene(const std::filesystem::path& file);
  void open_picture(const std::filesystem::path& file);
  void save(const std::filesystem::path& file);
  void reload();
  void want_snapshot(bool radiance);
  void export_chart(const Edits& edits);
  void leave_machine_to_chart();
  void take_wanted_snapshots();

  ViewerState state_;
  ImageSize next_room_{};  ///< for the picture; becomes state_.room once the window is not being resized any more
  std::chrono::steady_clock::time_point room_changed_;
  std::string stem_;                           ///< of snapshots
  std::shared_ptr<const Scene> posted_scene_;  ///< the same as state_.scene
  History history_;
  Posted posted_;                 ///< back to the one the frame shows
  std::vector<Snapshot> wanted_;  ///< of the next frame that holds what they are to show
  SnapshotWriter snapshots_;
  FileWatch watch_;
  Session session_;
  Charting charting_;
  bool resume_ = false;  ///< once the chart needs the machine no more
};

}  // namespace glimt
