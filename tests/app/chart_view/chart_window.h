#pragma once

#include "app/viewer/offscreen.h"

/// The window with its chart, and the steps that several tests share.
namespace glimt::testing {

inline const ChartState& chart(const Offscreen& window) { return window.state().chart; }

inline void show_chart(Offscreen& window) {
  Edits edits;
  edits.chart_view = ChartView{true, Across::seconds};
  window.apply(edits);
}

/// Renders to the target, until the last frame is measured and in its curve.
inline void finish(Offscreen& window) {
  ASSERT_TRUE(window.draw_until_finished());
  ASSERT_TRUE(window.draw_until([&] {
    const Curve* curve = chart(window).curves.current();
    return curve && curve->points.back().samples == window.state().frame->samples &&
           curve->points.back().error.has_value() == chart(window).reference_fits;
  }));
}

/// Tries what the report tried, 1, 4 and 30 shadow rays, and another sampler.
inline void visit(Offscreen& window) {
  finish(window);
  for (const int rays : {4, 30}) {
    window.edit([&](Scene& scene) { scene.render.shadow_rays = rays; });
    finish(window);
  }
  window.edit([](Scene& scene) {
    scene.render.shadow_rays = 1;
    scene.render.sampler = Sampler::sobol;
  });
  finish(window);
}

}  // namespace glimt::testing
