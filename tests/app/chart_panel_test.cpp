#include <filesystem>
#include <fstream>
#include <sstream>

#include "app/offscreen.h"
#include "app/own_folder.h"
#include "film/image_file.h"
#include "film/metadata.h"
#include "film/statistics.h"

/// The chart in the window, drawn into memory.
namespace glimt {
namespace {

namespace fs = std::filesystem;
using testing::Offscreen;
using testing::save_screenshot;
using testing::small_room;

constexpr int window_width = 1312, window_height = 828;

using ChartPanel = testing::OwnFolder;

const ChartState& chart(const Offscreen& window) { return window.state().chart; }

void show_chart(Offscreen& window) {
  Edits edits;
  edits.chart.view = ChartView{true, Across::seconds};
  window.apply(edits);
}

template <class Change>
void edit(Offscreen& window, Change change) {
  Edits edits;
  change(edits.edit(window.state()));
  window.apply(edits);
}

/// Renders to the target; the last frame is then in its curve, measured.
void finish(Offscreen& window) {
  ASSERT_TRUE(window.draw_until_finished());
  ASSERT_TRUE(window.draw_until([&] {
    const Curve* curve = chart(window).curves.current();
    return curve && curve->points.back().samples == window.state().frame->samples &&
           curve->points.back().error.has_value() == chart(window).reference_fits;
  }));
}

/// The report's visit: 1, 4 and 30 shadow rays, and another sampler.
void visit(Offscreen& window) {
  finish(window);
  for (const int rays : {4, 30}) {
    edit(window, [&](Scene& scene) { scene.render.shadow_rays = rays; });
    finish(window);
  }
  edit(window, [](Scene& scene) {
    scene.render.shadow_rays = 1;
    scene.render.sampler = Sampler::sobol;
  });
  finish(window);
}

Frame rendered(const Scene& scene) {
  Frame frame;
  Session session({.threads = 2});
  session.post(scene);
  while (!session.frame() || !session.frame()->finished) std::this_thread::sleep_for(std::chrono::milliseconds(2));
  return *session.frame();
}

void write_reference(const fs::path& file, Scene scene, int spp = 64) {
  scene.render.spp = spp;
  scene.render.seed = 99;
  const Frame frame = rendered(scene);
  Image none = frame.mean;
  write_exr(file, frame.mean, none, render_metadata(scene, frame.samples, frame.seconds));
}

void load_reference(Offscreen& window, const fs::path& file) {
  Edits edits;
  edits.chart.load_reference = file;
  window.apply(edits);
}

TEST_F(ChartPanel, ACurveForEverySettingTried) {
  Offscreen window(small_room(16), window_width, window_height);
  show_chart(window);
  visit(window);
  const auto& curves = chart(window).curves.all();
  ASSERT_EQ(curves.size(), 4U);
  EXPECT_EQ(curves[1].label, "shadow rays 4");
  EXPECT_EQ(curves[3].label, "sobol");
  for (const Curve& curve : curves) {
    EXPECT_EQ(curve.points.back().samples, 16);
    for (std::size_t i = 1; i < curve.points.size(); ++i) {
      EXPECT_GT(curve.points[i].samples, curve.points[i - 1].samples);
      EXPECT_GE(curve.points[i].seconds, curve.points[i - 1].seconds);
    }
  }
  EXPECT_EQ(curves[3].points.back().estimate, window.state().frame->relmse_estimate);

  Edits edits;
  edits.undo = true;
  window.apply(edits);
  finish(window);
  EXPECT_EQ(curves.size(), 4U) << "going back goes on with the curve there is";
  EXPECT_EQ(chart(window).curves.current(), &curves[2]);
}

TEST_F(ChartPanel, CurvesAreHiddenDeletedAndCompared) {
  Offscreen window(small_room(16), window_width, window_height);
  show_chart(window);
  visit(window);
  const auto& curves = chart(window).curves.all();
  window.press("curve.1.show");
  EXPECT_FALSE(curves[1].shown);
  window.press("curve.1.show");
  EXPECT_TRUE(curves[1].shown);
  window.press("curve.2.base", 0.2F);
  EXPECT_EQ(chart(window).curves.base(), &curves[2]);
  window.press("curve.0.delete");
  ASSERT_EQ(curves.size(), 3U);
  EXPECT_EQ(curves[0].label, "shadow rays 4, lattice");
  window.press("chart.axis");
  EXPECT_EQ(chart(window).view.across, Across::samples);
  window.press("chart.clear");
  EXPECT_TRUE(curves.empty());
  window.press("chart.hide");
  EXPECT_FALSE(chart(window).view.shown);
  EXPECT_FALSE(window.widgets().contains("chart.hide"));
}

TEST_F(ChartPanel, IsExportedIntoNewFiles) {
  std::ofstream("picture-chart-001.csv") << "precious";
  Offscreen window(small_room(16), window_width, window_height);
  show_chart(window);
  visit(window);
  for (const char* ending : {"csv", "svg"}) {
    window.press(std::string("chart.") + ending);
    ASSERT_TRUE(window.draw_until([&] { return window.state().message.text.find(ending) != std::string::npos; }));
    EXPECT_FALSE(window.state().message.error) << window.state().message.text;
  }
  std::size_t points = 0;
  for (const Curve& curve : chart(window).curves.all()) points += curve.points.size();
  std::ifstream csv("picture-chart-002.csv");
  std::size_t lines = 0;
  for (std::string line; std::getline(csv, line);) ++lines;
  EXPECT_EQ(lines, points + 1) << "the head, and every point";
  std::ostringstream svg;
  svg << std::ifstream("picture-chart-001.svg").rdbuf();
  EXPECT_NE(svg.str().find("shadow rays 30"), std::string::npos);
}

TEST_F(ChartPanel, MeasuresAgainstAReferenceFromAFile) {
  Offscreen window(small_room(16), window_width, window_height);
  show_chart(window);
  finish(window);
  write_reference("reference.exr", window.state().scene);
  load_reference(window, "reference.exr");
  ASSERT_TRUE(window.draw_until([&] { return chart(window).reference_fits; })) << window.state().message.text;
  finish(window);
  const Image reference = read_image("reference.exr");
  const auto measured = [&] { return chart(window).curves.current()->points.back().error.value().relmse; };
  EXPECT_EQ(measured(), compare(window.state().frame->mean, reference).relmse) << "what is there is measured at once";
  edit(window, [](Scene& scene) { scene.render.shadow_rays = 4; });
  finish(window);
  EXPECT_EQ(measured(), compare(window.state().frame->mean, reference).relmse);

  edit(window, [](Scene& scene) { scene.camera.fov_y += 5; });
  EXPECT_FALSE(chart(window).reference_fits);
  finish(window);
  EXPECT_FALSE(chart(window).curves.current()->points.back().error) << "another picture";
  Edits edits;
  edits.undo = true;
  window.apply(edits);
  EXPECT_TRUE(chart(window).reference_fits);
  finish(window);
  window.press("reference.drop");
  EXPECT_EQ(chart(window).reference, nullptr);
  EXPECT_EQ(error_kind(*chart(window).curves.current()), ErrorKind::estimate);
}

TEST_F(ChartPanel, ReferenceOfAnotherSceneOrSizeIsRefusedWithAReason) {
  const Scene room = small_room(16);
  Scene other = room, larger = room;
  other.spheres[0].radius *= 0.5;
  larger.image.width += 8;
  write_reference("other.exr", other, 2);
  write_reference("larger.exr", larger, 2);
  Offscreen window(room, window_width, window_height);
  finish(window);
  for (const auto& [file, reason] :
       {std::pair{"other.exr", "another scene"}, {"larger.exr", "104x72"}, {"no.exr", "no.exr"}}) {
    load_reference(window, file);
    ASSERT_TRUE(window.draw_until([&] { return window.state().message.error; })) << file;
    EXPECT_NE(window.state().message.text.find(reason), std::string::npos) << window.state().message.text;
    EXPECT_EQ(chart(window).reference, nullptr);
    edit(window, [](Scene& scene) { ++scene.render.seed; });  // which clears the message
  }
}

TEST_F(ChartPanel, FilesDroppedOntoTheChartAreReferences) {
  Offscreen window(small_room(4), window_width, window_height);
  show_chart(window);
  finish(window);
  const Rect hide = window.widget("chart.hide");
  const auto drop = [&](const char* file, float x, float y) {
    ImGui::GetIO().MousePos = {x, y};
    Edits edits;
    window.screen().drop(file, edits);
    return edits.chart.load_reference ? "reference" : edits.open ? "open" : "nothing";
  };
  EXPECT_STREQ(drop("a.exr", hide.x, hide.y), "reference");
  EXPECT_STREQ(drop("a.exr", 10, 10), "open");
  EXPECT_STREQ(drop("a.pfm", 10, 10), "reference");
  EXPECT_STREQ(drop("a.toml", hide.x, hide.y), "open");
}

TEST_F(ChartPanel, MakesAReferenceWhileThePictureWaits) {
  Offscreen window(small_room(1 << 20), window_width, window_height);
  show_chart(window);
  ASSERT_TRUE(window.draw_until([&] { return window.state().frame && window.state().frame->samples > 2; }));
  Edits edits;
  edits.chart.target = 0.02;
  edits.chart.make_reference = true;
  window.apply(edits);
  EXPECT_TRUE(window.state().paused) << "so that times stay true";
  ASSERT_TRUE(window.draw_until([&] { return chart(window).reference_fits; }));
  EXPECT_FALSE(window.state().paused);
  const Reference& made = *chart(window).reference;
  EXPECT_LE(made.frame->relmse_estimate, 0.02);
  EXPECT_NE(made.frame->mean.rgb, window.state().frame->mean.rgb) << "its random numbers are its own";
  ASSERT_TRUE(window.draw_until([&] {
    const Curve* curve = chart(window).curves.current();
    return curve && curve->points.back().error;
  }));

  edits = {};
  edits.chart.target = 1e-6;
  edits.chart.make_reference = true;
  window.apply(edits);
  ASSERT_TRUE(window.draw_until([&] { return chart(window).making != nullptr; }));
  window.press("reference.use");
  EXPECT_NE(chart(window).reference.get(), &made) << "taken as it is";
  EXPECT_EQ(chart(window).making, nullptr);
  EXPECT_FALSE(window.state().paused);
}

TEST_F(ChartPanel, AdvisesOnShadowRays) {
  Offscreen window(small_room(16), window_width, window_height);
  show_chart(window);
  finish(window);
  window.press("chart.tab.advisor");
  window.press("advice.measure");
  EXPECT_TRUE(chart(window).advising);
  window.press("advice.stop");
  ASSERT_TRUE(window.draw_until([&] { return !chart(window).advising; }));
  EXPECT_FALSE(chart(window).advice);

  window.press("advice.measure");
  ASSERT_TRUE(window.draw_until([&] { return chart(window).advice.has_value(); })) << window.state().message.text;
  const int best = chart(window).advice->best;
  EXPECT_TRUE(window.widgets().contains("advice.best." + std::to_string(best)));
  save_screenshot(window, "advice");
  edit(window, [&](Scene& scene) { scene.render.shadow_rays = best + 1; });
  window.press("advice.use");
  EXPECT_EQ(window.state().scene.render.shadow_rays, best);
  EXPECT_TRUE(window.state().can_undo);

  edit(window, [](Scene& scene) { scene.render.light_sampling = LightSampling::none; });
  window.press("advice.measure");
  ASSERT_TRUE(window.draw_until([&] { return window.state().message.error; }));
  EXPECT_NE(window.state().message.text.find("shadow rays play no part"), std::string::npos);
}

// ImGui's lists hold 2^16 vertices, and more would be drawn as garbage.
TEST_F(ChartPanel, MostCurvesThereCanBeFitIntoALargeWindow) {
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
      state.chart.curves.add(shared, {samples, samples * 1e-3, error, Comparison{.relmse = 1.1 * error}});
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

class ChartFit : public ::testing::TestWithParam<Size> {};

bool apart(const Rect& r, const Rect& s) {
  return r.x + r.width <= s.x || s.x + s.width <= r.x || r.y + r.height <= s.y || s.y + s.height <= r.y;
}

TEST_P(ChartFit, NothingOverlapsOrSticksOut) {
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
    window.screen().toggle_help();
    window.draw();
    save_screenshot(window, std::string("chart-help-") + shape + std::to_string(width));
    window.screen().toggle_help();
    window.draw();
    save_screenshot(window, std::string("chart-") + shape + "-" + std::to_string(width) + "-" +
                                std::to_string(static_cast<int>(scale)));
  }
}

INSTANTIATE_TEST_SUITE_P(Sizes, ChartFit,
                         ::testing::Values(Size{1312, 828, 1}, Size{1920, 1080, 1}, Size{2560, 1600, 2}));

}  // namespace
}  // namespace glimt
