#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <vector>

#include "scene/scene.h"
#include "viewer/state/render_goal.h"

namespace glimt {

/// A scene as its file holds it, that file, and how far the scene is rendered.
struct Document {
  std::shared_ptr<const Scene> scene;
  std::filesystem::path file;
  RenderGoal goal = {};
};

/// The edits that can be undone and redone.
class History {
 public:
  /// Records the state before an edit. Edits of one gesture (not 0) are undone together.
  void edited(Document before, std::uint64_t gesture);
  /// Goes back or forward one step from the present state; nothing where there is no further step.
  std::optional<Document> undo(Document now) { return move(undo_, redo_, std::move(now)); }
  std::optional<Document> redo(Document now) { return move(redo_, undo_, std::move(now)); }
  bool can_undo() const { return !undo_.empty(); }
  bool can_redo() const { return !redo_.empty(); }

 private:
  std::optional<Document> move(std::vector<Document>& from, std::vector<Document>& to, Document now);

  std::vector<Document> undo_, redo_;
  std::uint64_t gesture_ = 0;
};

}  // namespace glimt
