#include "viewer/screen.h"
#include "viewer/state/compare_actions.h"

namespace glimt {
namespace {

constexpr float worst_pixel_zoom = 16;  ///< framebuffer pixels per picture pixel

CompareView next(CompareView view) {
  return view == CompareView::relative ? CompareView::off : static_cast<CompareView>(static_cast<int>(view) + 1);
}

}  // namespace

void Screen::press(char letter, const ViewerState& state, Edits& edits) {
  if (letter == 'c') {
    ChartView view = state.chart.view;
    view.shown = !view.shown;
    edits.chart.view = view;
  }
  Compare compare = state.compare;
  if (letter == 'h' && can_hold(state)) {
    compare.held = picture_now(state);
    edits.compare = compare;
  }
  if (letter == 'x' || letter == 'b') {
    compare.view = letter == 'x'                       ? next(compare.view)
                   : compare.view == CompareView::held ? CompareView::off
                                                       : CompareView::held;
    edits.compare = compare;
  }
  if (letter == 'w') go_to_worst_pixel(state, edits);
  if (letter == 'i') edits.inspect = !state.inspect;
}

void Screen::go_to_worst_pixel(const ViewerState& state, Edits& edits) {
  const Held b = picture_b(state);
  if (!state.frame || !obstacle_to_compare(state).empty() || !same_size(state.frame->mean, b.frame->mean)) return;
  const Pixel worst = worst_pixel(state.frame->mean, b.frame->mean);
  const auto share = [](int pixel, int pixels) {
    return (static_cast<float>(pixel) + 0.5F) / static_cast<float>(pixels);
  };
  tool_.set_zoom({worst_pixel_zoom, share(worst.x, b.frame->size.width), share(worst.y, b.frame->size.height)});
  inspector_.mark(worst);
  edits.inspect = true;
}

void Screen::drop(const std::filesystem::path& file, Edits& edits) const {
  const ImVec2 mouse = ImGui::GetIO().MousePos;
  const bool picture = file.extension() == ".exr";
  if (file.extension() == ".pfm" || (picture && is_inside(chart_, mouse.x, mouse.y)))
    edits.chart.load_reference = file;
  else
    edits.open = file;
}

}  // namespace glimt
