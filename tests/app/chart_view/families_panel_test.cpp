#include <algorithm>
#include <string>

#include "app/chart_view/chart_window.h"
#include "scene/fields.h"

/// The chart's page of the families of light.
namespace glimt {
namespace {

using testing::apart;
using testing::chart;
using testing::finish;
using testing::Offscreen;
using testing::save_screenshot;
using testing::show_chart;
using testing::small_room;

void open_page(Offscreen& window) {
  show_chart(window);
  finish(window);
  window.press("chart.tab.families");
}

TEST(FamiliesPanel, MeasuresWhileThePictureWaits) {
  Scene room = small_room(1 << 20);
  room.image = {192, 192};
  Offscreen window(room, 1280, 800);
  show_chart(window);
  ASSERT_TRUE(window.draw_until([&] { return window.state().frame && window.state().frame->samples > 2; }));
  window.press("chart.tab.families");
  window.press("families.measure");
  EXPECT_TRUE(chart(window).measuring);
  EXPECT_TRUE(window.state().paused) << "so that times stay true";
  window.press("measuring.stop");
  ASSERT_TRUE(window.draw_until([&] { return !chart(window).measuring; }));
  EXPECT_FALSE(chart(window).families);
  EXPECT_FALSE(window.widgets().contains("families.samples")) << "no answer";
  EXPECT_FALSE(window.state().paused);

  window.press("families.measure");
  ASSERT_TRUE(window.draw_until([&] { return chart(window).families.has_value(); })) << window.state().message.text;
  save_screenshot(window, "families-measured");
  const auto& all = chart(window).families->what.all;
  double sum = 0;
  for (const Family& family : all) sum += family.share;
  EXPECT_NEAR(sum, 1, 1e-9);
  const auto worst = std::ranges::max_element(all, {}, &Family::share) - all.begin();
  EXPECT_TRUE(window.widgets().contains("families.answer." + std::to_string(worst)));
  EXPECT_FALSE(window.widgets().contains("measured.before"));
  window.set_goal([](RenderGoal& goal) { goal.samples /= 2; });
  EXPECT_FALSE(window.widgets().contains("measured.before")) << "where rendering stops is no matter";
  window.edit([](Scene& scene) { scene.render.light_paths = 0; });
  EXPECT_TRUE(window.widgets().contains("measured.before"));
}

TEST(FamiliesPanel, SaysThatWithoutMirrorsAndGlassThereIsOneFamily) {
  Offscreen window(small_room(4), 1312, 828);
  open_page(window);
  EXPECT_TRUE(window.widgets().contains("families.bar.3"));
  EXPECT_FALSE(window.widgets().contains("families.one"));
  window.edit([](Scene& scene) {
    for (Material& material : scene.materials)
      if (is_specular(material)) material.type = "lambertian";
  });
  save_screenshot(window, "families-one");
  EXPECT_TRUE(window.widgets().contains("families.one"));
  EXPECT_FALSE(window.widgets().contains("families.bar.3"));
  window.press("families.measure");
  EXPECT_FALSE(chart(window).measuring) << "there is nothing to measure";
}

/// Window sizes and scales.
struct Size {
  int width, height;
  float scale;
};

class FamiliesSizes : public ::testing::TestWithParam<Size> {};

TEST_P(FamiliesSizes, FitIn) {
  const auto [width, height, scale] = GetParam();
  for (const int columns : {96, 192}) {
    Scene room = small_room(4);
    room.image = {columns, 96};
    Offscreen window(room, width, height, scale);
    open_page(window);
    const Rect r =
        with_chart(make_layout(static_cast<float>(width), static_cast<float>(height), scale), columns, 96, scale).chart;
    // The longest texts there can be: the worst family the last, and all shares wide.
    ViewerState state = window.state();
    Families found{.all = {}, .samples = 1 << 20};
    for (Family& family : found.all) family = {.error = 1, .share = 0.99, .low = 1, .high = 1, .pixels = 1};
    found.all[3].share = 1;
    state.chart.families = Finding<Families>{found, {}};
    Edits edits;
    for (int i = 0; i < 3; ++i) window.screen().lay_out(state, scale, edits);
    window.screen().paint();
    glFinish();
    save_screenshot(window, "families-" + std::to_string(columns) + "-" + std::to_string(width));
    const auto is_of_page = [](const std::string& name) {
      return name.starts_with("chart.") || name.starts_with("families.") || name.starts_with("measured.");
    };
    EXPECT_TRUE(window.widgets().contains("measured.before"));
    for (const auto& [name, w] : window.widgets()) {
      EXPECT_FALSE(name.starts_with("cut.")) << name;
      if (!is_of_page(name)) continue;
      EXPECT_TRUE(w.x >= r.x && w.y >= r.y && w.x + w.width <= r.x + r.width && w.y + w.height <= r.y + r.height)
          << name << " sticks out";
      for (const auto& [other, s] : window.widgets())
        EXPECT_TRUE(other <= name || !is_of_page(other) || apart(w, s)) << name << " and " << other;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Sizes, FamiliesSizes,
                         ::testing::Values(Size{1280, 800, 1}, Size{1920, 1080, 1}, Size{2560, 1600, 2}));

}  // namespace
}  // namespace glimt
