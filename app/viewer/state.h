#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>

#include "film/display.h"
#include "render/session.h"
#include "scene/scene.h"

namespace glimt {

/// One line for the person at the window.
struct Message {
  std::string text;
  bool error = false;
};

/// All that the panels show. They read it; the controller alone changes it.
struct ViewerState {
  Scene scene;                ///< as edited; the frame may still show the one before
  std::uint64_t version = 0;  ///< of the scene; frames of this or a later one show it
  Display display;
  bool paused = false;
  std::shared_ptr<const Frame> frame;  ///< the newest; null before the first
  Message message;
};

/// What a person asked for while one picture of the window was drawn.
struct Edits {
  std::optional<Scene> scene;
  std::optional<Display> display;
  std::optional<std::filesystem::path> open;  ///< another scene file
  bool toggle_pause = false;
  bool restart = false;
  bool snapshot = false;
  bool quit = false;

  /// The scene to write an edit into.
  Scene& edit(const ViewerState& state) { return scene ? *scene : scene.emplace(state.scene); }
};

}  // namespace glimt
