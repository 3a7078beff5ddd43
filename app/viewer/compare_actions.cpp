#include "viewer/compare_actions.h"

namespace glimt {
namespace {

std::string size_text(const ImageSize& size) {
  return std::to_string(size.width) + " \u00D7 " + std::to_string(size.height);
}

}  // namespace

Held picture_b(const ViewerState& state) {
  if (!state.compare.with_reference || !state.chart.reference) return state.compare.held;
  return {state.chart.reference->frame, "reference"};
}

Held picture_now(const ViewerState& state) { return {state.frame, label_of_picture(state)}; }

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
