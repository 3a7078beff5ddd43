#pragma once

#include "viewer/state/state.h"

/// The parts of the column of controls. Each has its own file and draws into the current ImGui window.
namespace glimt {

/// The scene's name, samples so far, speed, error, time, and where to stop.
void draw_progress_panel(const ViewerState& state, Edits& edits);

/// Pause, restart, undo, redo, files, snapshots.
void draw_actions_panel(const ViewerState& state, Edits& edits);

/// Exposure, tone curve, view.
void draw_display_panel(const ViewerState& state, Edits& edits);

/// A row that shows a colour scale between its two numbers.
void draw_colour_scale(const char* label, const char* tip, const ColourScale& scale);

/// What the picture is compared with, and how.
void draw_compare_panel(const ViewerState& state, Edits& edits);

/// All objects by name, and the material, place and size of the selected one.
void draw_objects_panel(const ViewerState& state, Edits& edits);

/// Radiance and size of each lamp.
void draw_lamp_panel(const ViewerState& state, Edits& edits);

/// The camera's place, direction and field of view.
void draw_camera_panel(const ViewerState& state, Edits& edits);

/// Every setting of the renderer, and the image's size.
void draw_estimator_panel(const ViewerState& state, Edits& edits);

/// What was compiled in for this scene, and what was left out.
void draw_scene_panel(const ViewerState& state);

/// The help sheet over the picture, with keys and mouse. Returns true once it is clicked away.
bool draw_help_panel(const struct Rect& area);

}  // namespace glimt
