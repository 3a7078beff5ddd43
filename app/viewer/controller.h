#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <string>

#include "render/session.h"
#include "viewer/snapshot.h"
#include "viewer/state.h"

namespace glimt {

/// Owns what the window shows and carries out what its user asks for. Knows neither OpenGL nor ImGui; no function waits
/// for rendering.
class Controller {
 public:
  /// Starts to render the scene; snapshots are called after `stem`. `wake` is called on other threads when poll() has
  /// news. Throws SceneError.
  Controller(Scene scene, std::string stem, const std::function<void()>& wake, Execution execution = {});

  const ViewerState& state() const { return state_; }
  /// Takes in finished frames and snapshots; true where there was one.
  bool poll();
  /// Carries out edits. One that is refused, and a scene file that cannot be read, change nothing and say why in the
  /// message.
  void apply(const Edits& edits);

 private:
  using Posted = std::map<std::uint64_t, std::shared_ptr<const Scene>>;  ///< by version

  /// The scene that the frame shows.
  Posted::const_iterator shown() const;
  void show(Scene scene);
  void open(const std::filesystem::path& scene_file);
  void take_wanted_snapshot();

  ViewerState state_;
  std::string stem_;
  Posted posted_;                 ///< back to the one the frame shows
  bool snapshot_wanted_ = false;  ///< to be taken of the next frame with samples
  SnapshotWriter snapshots_;
  Session session_;
};

}  // namespace glimt
