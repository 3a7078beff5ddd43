#pragma once

#include <string>

#include "viewer/state/state.h"

namespace glimt {

/// What the picture is compared with; its frame is null where there is nothing.
Held picture_b(const ViewerState& state);

/// Whether the picture can be held: it is more than a preview.
bool can_hold(const ViewerState& state);
/// The picture as it is now, to be held.
Held picture_now(const ViewerState& state);

/// What distinguishes the picture's settings, in the words of the chart.
std::string label_of_picture(const ViewerState& state);

/// Why the picture and B cannot be compared pixel by pixel; empty where they can.
std::string obstacle_to_compare(const ViewerState& state);

}  // namespace glimt
