#pragma once

#include "viewer/state.h"

/// The parts of the column of controls, one file each, drawn from top to bottom into the current ImGui window.
namespace glimt {

/// Name of the scene, samples done, speed, error and time.
void draw_progress_panel(const ViewerState& state);

/// Pause, restart, snapshot.
void draw_actions_panel(const ViewerState& state, Edits& edits);

/// Exposure.
void draw_display_panel(const ViewerState& state, Edits& edits);

/// For each sphere its material's type and the parameters of that type.
void draw_spheres_panel(const ViewerState& state, Edits& edits);

/// Every setting of the renderer.
void draw_settings_panel(const ViewerState& state, Edits& edits);

}  // namespace glimt
