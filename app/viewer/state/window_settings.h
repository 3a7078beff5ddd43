#pragma once

#include <filesystem>
#include <string>

#include "film/display.h"
#include "viewer/state/camera_moves.h"
#include "viewer/state/charting.h"

namespace glimt {

/// What the window remembers from one start to the next.
struct WindowSettings {
  int width = 1312, height = 828;  ///< design units; a picture of 400 x 400 fits exactly doubled
  Display display;
  std::filesystem::path folder;  ///< where the files' sheet opens; empty: the current folder
  bool hint_seen = false;        ///< the hint for the first start is not needed any more
  ChartView chart;
  DragView drag_view = DragView::automatic;
  bool fits_window = true;  ///< the picture's size follows the free space in the window
};

/// glimt/window.toml in the user's configuration directory ($XDG_CONFIG_HOME, else ~/.config); empty where there is
/// none.
std::filesystem::path window_settings_file();

/// Reads the file. A missing file gives the defaults. A damaged file does too, and then `note` says so.
WindowSettings read_window_settings(const std::filesystem::path& file, std::string& note);

/// Throws ImageFileError (film/image_file.h) where the file cannot be written.
void write_window_settings(const std::filesystem::path& file, const WindowSettings& settings);

}  // namespace glimt
