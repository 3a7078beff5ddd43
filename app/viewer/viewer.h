#pragma once

#include <filesystem>

namespace glimt {

/// Opens the window on a scene file. Returns 0 when it is closed, 1 where no window can be opened, 2 where the scene
/// cannot be read. Errors are one line on stderr.
///
/// For tests and measurements: GLIMT_FRAME_LOG=FILE gets a line "TIME SAMPLES FINISHED" for each new picture on the
/// screen (seconds since 1970, samples per pixel, 0 or 1). GLIMT_WIDGET_LOG=FILE holds a line
/// "NAME<tab>X Y WIDTH HEIGHT" for every control, in window coordinates.
int run_viewer(const std::filesystem::path& scene_file);

}  // namespace glimt
