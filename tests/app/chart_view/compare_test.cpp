#include "viewer/state/compare.h"

#include <cmath>

#include "app/viewer/offscreen.h"
#include "film/display.h"
#include "viewer/state/compare_actions.h"

/// The picture compared with another: exact numbers, and what the window draws.
namespace glimt {
namespace {

using testing::Offscreen;
using testing::save_screenshot;
using testing::small_room;

constexpr int image_width = 96, image_height = 72, zoom = 6;
constexpr int window_width = image_width * zoom + 352, window_height = image_height * zoom + 400;

void compare_by(Offscreen& window, CompareView view) {
  Edits edits;
  edits.compare = window.state().compare;
  edits.compare->view = view;
  window.apply(edits);
}

void press(Offscreen& window, char letter) { window.key({letter}); }

/// Renders 4 spp, holds it, and goes on with another seed and 30 shadow rays.
void hold_and_change(Offscreen& window) {
  ASSERT_TRUE(window.draw_until_finished());
  press(window, 'h');
  ASSERT_TRUE(window.state().compare.held.frame);
  window.edit([](Scene& scene) { scene.render.shadow_rays = 30; });
  ASSERT_TRUE(window.draw_until_finished());
  ASSERT_NE(window.state().frame->mean.rgb, window.state().compare.held.frame->mean.rgb);
}

/// The middle of a pixel of the picture as it is on the screen.
std::array<int, 3> shown_at(const Offscreen& window, int x, int y) {
  const Rect r = window.widget("image");
  const float size = r.width / image_width;
  return window.pixel(static_cast<int>(r.x + (static_cast<float>(x) + 0.5F) * size),
                      static_cast<int>(r.y + (static_cast<float>(y) + 0.5F) * size));
}

/// Expects these pixels of columns [from, to) on the screen, below the labels at the top.
void expect_shown(const Offscreen& window, const Image& image, const Display& display, int from, int to) {
  const auto bytes = to_srgb8(image, display);
  for (int y = 8; y < image_height; ++y)
    for (int x = from; x < to; ++x) {
      const std::uint8_t* p = &bytes[3 * static_cast<std::size_t>(y * image_width + x)];
      ASSERT_EQ(shown_at(window, x, y), (std::array<int, 3>{p[0], p[1], p[2]})) << x << ", " << y;
    }
}

// a = (1, 2, 3), b = (1, 1, 5): differences 0, 1, 2; e = (0 + 1 / 1.01 + 4 / 25.01) / 3.
TEST(Compare, NumbersAreExact) {
  const Image a{2, 1, {1, 2, 3, 0, 0, 0}}, b{2, 1, {1, 1, 5, 0, 0, 0}};
  EXPECT_EQ(difference(a, b).rgb, (std::vector<float>{0, 1, 2, 0, 0, 0}));
  const Image relative = relative_error(a, b);
  EXPECT_NEAR(relative.rgb[0], std::sqrt((1 / 1.01 + 4 / 25.01) / 3), 1e-6);
  EXPECT_EQ(relative.rgb[0], relative.rgb[2]);
  EXPECT_EQ(relative.rgb[3], 0);
  EXPECT_EQ(worst_pixel(a, b).x, 0);
  EXPECT_EQ(worst_pixel({2, 2, std::vector<float>(12, 1)}, {2, 2, {1, 1, 1, 1, 1, 1, 1, 1, 0, 1, 1, 1}}).y, 1);
}

TEST(Compare, SplitShowsAAtTheLeftAndBAtTheRight) {
  Offscreen window(small_room(), window_width, window_height);
  hold_and_change(window);
  compare_by(window, CompareView::split);
  // Copies: the frame on the screen is another when its error has come.
  const Image a = window.state().frame->mean, b = window.state().compare.held.frame->mean;
  expect_shown(window, a, window.state().display, 0, image_width / 2 - 1);
  expect_shown(window, b, window.state().display, image_width / 2 + 1, image_width);

  // The line is dragged to a quarter of the picture.
  const Rect line = window.widget("split"), r = window.widget("image");
  window.drag("split", (r.x + r.width / 4 - line.x) / line.width);
  EXPECT_NEAR(window.state().compare.line, 0.25, 0.01);
  EXPECT_FALSE(window.state().can_undo && window.state().scene.render.shadow_rays == 1) << "the camera stays";
  expect_shown(window, b, window.state().display, image_width / 4 + 1, image_width);
}

TEST(Compare, KeyFlipsToBAndBack) {
  Offscreen window(small_room(), window_width, window_height);
  hold_and_change(window);
  press(window, 'b');
  EXPECT_EQ(window.state().compare.view, CompareView::held);
  expect_shown(window, window.state().compare.held.frame->mean, window.state().display, 0, image_width);
  press(window, 'b');
  EXPECT_EQ(window.state().compare.view, CompareView::off);
  expect_shown(window, window.state().frame->mean, window.state().display, 0, image_width);
}

TEST(Compare, DifferenceIsBrightenedByExposureAndRelativeErrorIsOnAScale) {
  Offscreen window(small_room(), window_width, window_height);
  hold_and_change(window);
  // Copies: the frame on the screen is another when its error has come.
  const Image a = window.state().frame->mean, b = window.state().compare.held.frame->mean;
  Edits edits;
  edits.display = Display{.exposure = 2};
  window.apply(edits);
  compare_by(window, CompareView::difference);
  expect_shown(window, difference(a, b), {.exposure = 2}, 0, image_width);
  compare_by(window, CompareView::relative);
  expect_shown(window, relative_error(a, b), {.exposure = 0, .view = View::error}, 0, image_width);
  EXPECT_TRUE(window.widgets().contains("legend"));
}

TEST(Compare, OtherSizeIsRefusedWithAReason) {
  Offscreen window(small_room(), window_width, window_height);
  ASSERT_TRUE(window.draw_until_finished());
  EXPECT_NE(obstacle_to_compare(window.state()).find("hold"), std::string::npos);
  press(window, 'h');
  EXPECT_EQ(obstacle_to_compare(window.state()), "");
  compare_by(window, CompareView::difference);
  window.edit([](Scene& scene) { scene.image = {64, 48}; });
  ASSERT_TRUE(window.draw_until_finished());
  EXPECT_EQ(obstacle_to_compare(window.state()), "What is held is 96 \u00D7 72 pixels, the picture 64 \u00D7 48");
}

TEST(Compare, GoesToTheWorstPixelAndTellsIt) {
  Offscreen window(small_room(), window_width, window_height);
  hold_and_change(window);
  // Copies: the frame on the screen is another when its error has come.
  const Image a = window.state().frame->mean, b = window.state().compare.held.frame->mean;
  const Pixel worst = worst_pixel(a, b);
  window.press("compare.worst");
  EXPECT_TRUE(window.state().inspect);
  ASSERT_TRUE(window.draw_until([&] { return !window.state().frame->error.rgb.empty(); }));
  // Magnified, with that pixel in sight.
  const Rect r = window.widget("image");
  const float side = r.width / image_width;
  EXPECT_EQ(side, 16);
  const float x = r.x + (static_cast<float>(worst.x) + 0.5F) * side,
              y = r.y + (static_cast<float>(worst.y) + 0.5F) * side;
  EXPECT_TRUE(x > 0 && x < static_cast<float>(window_width - 352) && y > 0 &&
              y < static_cast<float>(window_height - 28));
  save_screenshot(window, "compare-worst");

  const auto lines = pixel_lines(window.state(), worst);
  const auto value = [&](const std::string& label) {
    for (const auto& line : lines)
      if (line[0] == label) return line[1];
    return std::string("missing");
  };
  EXPECT_EQ(value("Pixel"), std::to_string(worst.x) + ", " + std::to_string(worst.y));
  EXPECT_EQ(value("Samples"), "4");
  EXPECT_EQ(std::stof(value("B")), std::stof(value("B")));
  EXPECT_NEAR(std::stof(value("Radiance")), a.pixel(worst.x, worst.y)[0], 0.01F * (1 + a.pixel(worst.x, worst.y)[0]));
  const float error = window.state().frame->error.pixel(worst.x, worst.y)[0];
  EXPECT_NEAR(std::stof(value("Standard error")), error, 0.01F * (1 + error));
  const float relative = 100 * relative_error(a.pixel(worst.x, worst.y), b.pixel(worst.x, worst.y));
  EXPECT_NEAR(std::stof(value("Relative error")), relative, 0.01F * relative);
}

TEST(Compare, LooksRight) {
  if (std::getenv("GLIMT_SCREENSHOTS") == nullptr) GTEST_SKIP() << "pictures to be looked at, with GLIMT_SCREENSHOTS";
  for (const float scale : {1.0F, 2.0F}) {
    const std::vector<std::string> settings{"render.spp=32"};
    Offscreen window(read_scene(GLIMT_SCENES "/report.toml", settings), static_cast<int>(1312 * scale),
                     static_cast<int>(828 * scale), scale);
    ASSERT_TRUE(window.draw_until_finished());
    press(window, 'h');
    window.edit([](Scene& scene) { scene.render.sampler = Sampler::sobol; });
    ASSERT_TRUE(window.draw_until_finished());
    press(window, 'i');
    for (const auto& [view, name] : {std::pair{CompareView::split, "split"},
                                     {CompareView::held, "held"},
                                     {CompareView::difference, "difference"},
                                     {CompareView::relative, "relative"}}) {
      compare_by(window, view);
      ImGui::GetIO().MousePos = window.in_window(200, 300);
      window.draw(4);
      save_screenshot(window, std::string("compare-") + name + "-" + std::to_string(static_cast<int>(scale)));
    }
  }
}

}  // namespace
}  // namespace glimt
