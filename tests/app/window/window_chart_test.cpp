#include "app/window/real_window.h"

/// The chart in the real window, by mouse and keys alone.
namespace glimt {
namespace {

using testing::content;
using testing::wait_for;
using testing::WindowTest;

class WindowChart : public WindowTest {
 protected:
  /// Ctrl+click on a number, and types another.
  static void type_into(const std::string& control, const std::string& number) {
    point_at(control);
    xdotool("keydown ctrl sleep 0.05 click 1 sleep 0.1 keyup ctrl sleep 0.05 key ctrl+a");
    xdotool("type --delay 40 " + number);
    xdotool("keydown Return sleep 0.15 keyup Return sleep 0.1");  // ImGui misses what is over within one picture
  }

  /// The newest curve has come to the target; the mouse stays where nothing is told of what it is on.
  static void rendered() {
    std::this_thread::sleep_for(std::chrono::milliseconds(300));
    ASSERT_TRUE(wait_for([] { return finished(); })) << content("frames");
  }

  /// With GLIMT_SCREENSHOTS=FOLDER the screen is saved there.
  static void save_screenshot(const std::string& name) {
    const char* folder = std::getenv("GLIMT_SCREENSHOTS");
    if (folder == nullptr) return;
    std::filesystem::create_directories(folder);
    const auto file = std::filesystem::path(folder) / (name + ".png");
    EXPECT_EQ(std::system(("import -window " + in_window() + " " + file.string()).c_str()), 0);
  }
};

TEST_F(WindowChart, FollowsTheReportsVisit) {
  // Small, so that 30 shadow rays are soon done, but for a picture to be shown.
  std::vector<std::string> size;
  if (std::getenv("GLIMT_SCREENSHOTS") == nullptr) size = {"image.width=120", "image.height=120"};
  std::ofstream("report.toml") << write_scene(read_scene(report_scene(), size));
  open_window("report.toml");
  stop_at_the_files_samples();
  click("tab.estimator");
  point_at("image");
  xdotool("key c");
  ASSERT_TRUE(is_there("curve.0.base"));
  rendered();
  for (const char* rays : {"4", "30"}) {
    type_into("render.shadow_rays", rays);
    rendered();
  }
  type_into("render.shadow_rays", "1");
  choose("render.sampler", "sobol");
  rendered();
  ASSERT_TRUE(is_there("curve.3.base")) << content("widgets");
  EXPECT_FALSE(widgets().contains("curve.4.base"));
  click("chart.csv");
  ASSERT_TRUE(says("Saved report-chart-001.csv"));
  const std::string csv = content("report-chart-001.csv");
  for (const char* label : {"\"shadow rays 1, lattice\",", "shadow rays 4,", "shadow rays 30,", "sobol,"})
    EXPECT_NE(csv.find(std::string("\n") + label), std::string::npos) << label << " in\n" << csv;
  point_at("image", 0.5, 0.2);
  xdotool("sleep 0.5");
  save_screenshot("window-chart");
  xdotool("key c");
  EXPECT_TRUE(is_gone("curve.0.base"));
  close_window();
}

TEST_F(WindowChart, IsThereAgainAtTheNextStart) {
  open_window(report_scene());
  point_at("image");
  xdotool("key c");
  ASSERT_TRUE(is_there("chart.csv"));
  close_window();
  open_window(report_scene());
  EXPECT_TRUE(is_there("chart.csv"));
  point_at("image");
  close_window();
}

TEST_F(WindowChart, KeysCompareWithWhatIsHeld) {
  open_window(report_scene());
  point_at("image");
  ASSERT_TRUE(wait_for([] { return has_samples(); }));
  xdotool("key h");
  EXPECT_TRUE(says("Held to compare with"));
  xdotool("key x");
  EXPECT_TRUE(is_there("split"));
  xdotool("key x sleep 0.1 key x sleep 0.1 key x");
  EXPECT_TRUE(is_there("legend"));
  xdotool("key w");
  EXPECT_TRUE(wait_for([] { return widgets()["image"][2] == 16 * 400; })) << "the worst pixel, magnified";
  close_window();
}

}  // namespace
}  // namespace glimt
