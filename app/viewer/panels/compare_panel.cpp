#include <array>
#include <string>

#include "viewer/panels/panels.h"
#include "viewer/state/compare_actions.h"
#include "viewer/widgets/field_widgets.h"
#include "viewer/widgets/widgets.h"

namespace glimt {
namespace {

constexpr std::array<std::string_view, 5> views{"off", "split", "held", "difference", "relative_error"};

bool choose_view(Compare& compare) {
  int view = static_cast<int>(compare.view);
  if (!edit_choice({"compare.view", "compare",
                    "the picture A beside another, B: split by a line that can be dragged; B alone; |A - B|, which "
                    "exposure brightens; or the relative error of A. Key: X. B flips to B and back"},
                   views, view))
    return false;
  compare.view = static_cast<CompareView>(view);
  return true;
}

}  // namespace

void draw_compare_panel(const ViewerState& state, Edits& edits) {
  Compare compare = state.compare;
  bool changed = choose_view(compare);
  if (compare.view == CompareView::relative)
    draw_colour_scale("Relative error", "The root of the mean over channels of (A - B)\u00B2 / (B\u00B2 + 0.01)",
                      colour_scale(View::error));
  ButtonRow row(4);
  if (row.button("Hold", "compare.hold", "Hold the picture as it is now, as B. Key: H", can_hold(state))) {
    compare.held = picture_now(state);
    changed = true;
  }
  const bool reference = compare.with_reference && state.chart.reference;
  if (row.button(reference ? "B: ref###b" : "B: held###b", "compare.b", "What B is: the picture held, or the reference",
                 state.chart.reference != nullptr)) {
    compare.with_reference = !reference;
    changed = true;
  }
  const std::string obstacle = obstacle_to_compare(state);
  edits.worst_pixel |= row.button(
      "Worst", "compare.worst", obstacle.empty() ? "Go to the pixel with the largest relative error. Key: W" : obstacle,
      obstacle.empty());
  if (row.button(state.inspect ? "Pixel on###pixel" : "Pixel###pixel", "inspect",
                 "Tell the pixel under the mouse in numbers. Key: I"))
    edits.inspect = !state.inspect;
  if (changed) edits.compare = compare;
}

}  // namespace glimt
