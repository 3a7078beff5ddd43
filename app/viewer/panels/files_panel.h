#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "viewer/state/state.h"
#include "viewer/widgets/layout.h"

namespace glimt {

/// The sheet over the picture where a person chooses a file.
class FilesPanel {
 public:
  enum class Purpose { none, open, save, reference };

  void show(FilePurpose purpose, const ViewerState& state);
  void close() { purpose_ = FilePurpose::none; }
  bool is_open() const { return purpose_ != FilePurpose::none; }
  void draw(const Rect& area, Edits& edits);

 private:
  struct Entry {
    std::string name;
    bool is_folder = false;
  };
  void look_into(const std::filesystem::path& folder);
  void draw_entries(Edits& edits);
  void draw_name(Edits& edits);
  void choose(Edits& edits);

  FilePurpose purpose_ = FilePurpose::none;
  std::filesystem::path folder_;
  std::vector<Entry> entries_;
  std::string name_;  ///< of the file to save
};

}  // namespace glimt
