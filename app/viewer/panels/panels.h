#pragma once

#include "viewer/state/state.h"

/// The parts of the column of controls, one file each, drawn into the current ImGui window.
namespace glimt {

/// Name of the scene, samples done, speed, error and time, and where to stop.
void draw_progress_panel(const ViewerState& state, Edits& edits);

/// Pause, restart, undo, redo, files, snapshots.
void draw_actions_panel(const ViewerState& state, Edits& edits);

/// Exposure, tone curve, view.
void draw_display_panel(const ViewerState& state, Edits& edits);

/// A row with the colours between two numbers.
void draw_colour_scale(const char* label, const char* tip, const ColourScale& scale);

/// What the picture is compared with, and how.
void draw_compare_panel(const ViewerState& state, Edits& edits);

/// Every object by name; material, place and size of the one that is selected.
void draw_objects_panel(const ViewerState& state, Edits& edits);

/// Radiance and size of each lamp.
void draw_lamp_panel(const ViewerState& state, Edits& edits);

/// Place, direction and field of view.
void draw_camera_panel(const ViewerState& state, Edits& edits);

/// Every setting of the renderer, and the image's size.
void draw_estimator_panel(const ViewerState& state, Edits& edits);

/// What of the scene was compiled in, and what was left out.
void draw_scene_panel(const ViewerState& state);

/// The sheet of keys and mouse over the picture; true once it is clicked away.
bool draw_help_panel(const struct Rect& area);

}  // namespace glimt
