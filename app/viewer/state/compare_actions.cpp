#include "viewer/state/compare_actions.h"

#include "viewer/widgets/labels.h"

namespace glimt {
Held picture_b(const ViewerState& state) {
  if (state.compare.with_reference && state.chart.reference) return {state.chart.reference->frame, "reference"};
  Held held = state.compare.held;
  // Curves that came later may have made the label longer.
  if (const Curve* curve = state.chart.curves.find(held.curve)) held.label = curve->label;
  return held;
}

bool can_hold(const ViewerState& state) { return state.frame && state.frame->samples > 0; }

Held picture_now(const ViewerState& state) {
  const Curve* curve = state.chart.curves.current();
  return {state.frame, label_of_picture(state), curve ? curve->id : 0};
}

std::string label_of_picture(const ViewerState& state) {
  const Curve* curve = state.chart.curves.current();
  return curve ? curve->label : "picture";
}

std::string obstacle_to_compare(const ViewerState& state) {
  const Held b = picture_b(state);
  if (!b.frame) return "Nothing is held to compare with: hold a picture first. Key: H";
  if (b.frame->size != state.scene.image)
    return "What is held is " + size_text(b.frame->size) + " pixels, the picture " + size_text(state.scene.image);
  return {};
}

}  // namespace glimt
