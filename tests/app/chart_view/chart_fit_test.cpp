#include <memory>
#include <string>
#include <vector>

#include "app/chart_view/chart_window.h"

/// How much the chart can hold, and windows of every size that hold it.
namespace glimt {
namespace {

using testing::apart;
using testing::Offscreen;
using testing::save_screenshot;
using testing::show_chart;
using testing::small_room;
using testing::visit;

// ImGui's lists hold 2^16 vertices, and more would be drawn as garbage.
TEST(ChartFit, MostCurvesThereCanBeFitIntoALargeWindow) {
  Scene room = small_room(4);
  room.image = {200, 50};  // so that the chart is as wide as the window
  Offscreen window(room, 3840, 2160);
  ASSERT_TRUE(window.draw_until_finished());
  ViewerState state = window.state();
  state.chart.view.shown = true;
  Scene scene = state.scene;
  for (std::size_t i = 0; i < Curves::most; ++i) {
    scene.render.seed = static_cast<int>(i) + 2;
    const auto shared = std::make_shared<const Scene>(scene);
    for (int samples = 2; samples < 1 << 20; samples += samples / 4 + 1) {
      const double error = (1 + 0.02 * static_cast<double>(i)) / samples;
      state.chart.curves.add(shared, {samples, samples * 1e-3, error, Comparison{.relmse_scaled = 1.1 * error}});
    }
  }
  Edits edits;
  for (int i = 0; i < 3; ++i) window.screen().lay_out(state, 1, edits);
  window.screen().paint();
  glFinish();
  save_screenshot(window, "chart-most");
  const ImDrawData& data = *ImGui::GetDrawData();
  for (int i = 0; i < data.CmdListsCount; ++i) EXPECT_LT(data.CmdLists[i]->VtxBuffer.Size, 1 << 16);
  EXPECT_GT(data.TotalVtxCount, 100'000) << "the curves are there";
}

/// Window sizes and scales.
struct Size {
  int width, height;
  float scale;
};

class ChartSizes : public ::testing::TestWithParam<Size> {};

TEST_P(ChartSizes, NothingOverlapsOrSticksOut) {
  const auto [width, height, scale] = GetParam();
  for (const char* shape : {"square", "wide"}) {
    const bool wide = shape == std::string("wide");
    const std::vector<std::string> size{"image.width=" + std::to_string(wide ? 192 : 96), "image.height=96",
                                        "render.spp=32"};
    Offscreen window(read_scene(GLIMT_SCENES "/report.toml", size), width, height, scale);
    show_chart(window);
    visit(window);
    ASSERT_TRUE(window.draw_until([&] { return window.widgets().contains("curve.3.base"); }));
    const Layout layout = with_chart(make_layout(static_cast<float>(width), static_cast<float>(height), scale),
                                     wide ? 192 : 96, 96, scale);
    const Rect& r = layout.chart;
    EXPECT_TRUE(apart(r, layout.image) && apart(r, layout.column) && apart(r, layout.status));
    const auto& widgets = window.widgets();
    const auto is_of_chart = [](const std::string& name) {
      return name.starts_with("chart.") || name.starts_with("curve.") || name.starts_with("reference.");
    };
    for (const auto& [name, w] : widgets) {
      if (!is_of_chart(name)) continue;
      EXPECT_TRUE(w.x >= r.x && w.y >= r.y && w.x + w.width <= r.x + r.width && w.y + w.height <= r.y + r.height)
          << name << " sticks out";
      for (const auto& [other, s] : widgets)
        EXPECT_TRUE(other <= name || !is_of_chart(other) || apart(w, s)) << name << " and " << other;
    }
    window.key({key_f1});
    window.draw();
    save_screenshot(window, std::string("chart-help-") + shape + std::to_string(width));
    window.key({key_f1});
    window.draw();
    save_screenshot(window, std::string("chart-") + shape + "-" + std::to_string(width) + "-" +
                                std::to_string(static_cast<int>(scale)));
  }
}

INSTANTIATE_TEST_SUITE_P(Sizes, ChartSizes,
                         ::testing::Values(Size{1312, 828, 1}, Size{1920, 1080, 1}, Size{2560, 1600, 2}));

}  // namespace
}  // namespace glimt
