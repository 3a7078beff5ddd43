#pragma once

#include "viewer/state/state.h"
#include "viewer/widgets/layout.h"

namespace glimt {

/// Where the camera is outside the room or the picture is black, says so over the picture, with buttons that help.
void draw_notice(const ViewerState& state, const Rect& area, Edits& edits);

}  // namespace glimt
