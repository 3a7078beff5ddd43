#include <filesystem>
#include <fstream>
#include <sstream>

#include "app/chart_view/chart_window.h"
#include "app/own_folder.h"
#include "film/image_file.h"
#include "film/metadata.h"
#include "film/statistics.h"
#include "pictures.h"

/// The chart in the window, drawn into memory.
namespace glimt {
namespace {

namespace fs = std::filesystem;
using testing::chart;
using testing::finish;
using testing::Offscreen;
using testing::save_screenshot;
using testing::show_chart;
using testing::small_room;
using testing::visit;

constexpr int window_width = 1312, window_height = 828;

using ChartPanel = testing::OwnFolder;

void write_reference(const fs::path& file, Scene scene, int spp = 64) {
  scene.render.spp = spp;
  scene.render.seed = 99;
  const Film film = render(compile(scene), spp);
  write_exr(file, film.mean(), film.standard_error(), render_metadata(scene, spp, 0));
}

void load_reference(Offscreen& window, const fs::path& file) {
  Edits edits;
  edits.load_reference = file;
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
  EXPECT_EQ(curves[3].points.back().estimate, window.state().frame->estimate.relmse_scaled);

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
  const auto measured = [&] { return chart(window).curves.current()->points.back().error.value().relmse_scaled; };
  EXPECT_EQ(measured(), compare(window.state().frame->mean, reference).relmse_scaled)
      << "what is there is measured at once";
  window.edit([](Scene& scene) { scene.render.shadow_rays = 4; });
  finish(window);
  EXPECT_EQ(measured(), compare(window.state().frame->mean, reference).relmse_scaled);

  window.edit([](Scene& scene) { scene.camera.fov_y += 5; });
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
    window.edit([](Scene& scene) { ++scene.render.seed; });  // which clears the message
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
    return edits.load_reference ? "reference" : edits.open ? "open" : "nothing";
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
  edits.reference_target = 0.02;
  edits.make_reference = true;
  window.apply(edits);
  EXPECT_TRUE(window.state().paused) << "so that times stay true";
  ASSERT_TRUE(window.draw_until([&] { return chart(window).reference_fits; }));
  EXPECT_FALSE(window.state().paused);
  const Reference& made = *chart(window).reference;
  EXPECT_LE(made.frame->estimate.relmse_scaled, 0.02);
  EXPECT_NE(made.frame->mean.rgb, window.state().frame->mean.rgb) << "its random numbers are its own";
  ASSERT_TRUE(window.draw_until([&] {
    const Curve* curve = chart(window).curves.current();
    return curve && curve->points.back().error;
  }));

  edits = {};
  edits.reference_target = 1e-6;
  edits.make_reference = true;
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
  EXPECT_TRUE(chart(window).measuring);
  window.press("measuring.stop");
  ASSERT_TRUE(window.draw_until([&] { return !chart(window).measuring; }));
  EXPECT_FALSE(chart(window).advice);

  window.press("advice.measure");
  ASSERT_TRUE(window.draw_until([&] { return chart(window).advice.has_value(); })) << window.state().message.text;
  const int best = chart(window).advice->what.best;
  EXPECT_TRUE(window.widgets().contains("advice.best." + std::to_string(best)));
  save_screenshot(window, "advice");
  window.edit([&](Scene& scene) { scene.render.shadow_rays = best + 1; });
  window.press("advice.use");
  EXPECT_EQ(window.state().scene.render.shadow_rays, best);
  EXPECT_TRUE(window.state().can_undo);

  window.edit([](Scene& scene) { scene.render.light_sampling = LightSampling::none; });
  window.press("advice.measure");
  ASSERT_TRUE(window.draw_until([&] { return window.state().message.error; }));
  EXPECT_NE(window.state().message.text.find("shadow rays play no part"), std::string::npos);
}

}  // namespace
}  // namespace glimt
