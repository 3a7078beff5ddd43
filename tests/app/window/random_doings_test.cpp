// Five hundred random drags, wheels and keys in the real window. Takes minutes, so it runs only with GLIMT_LONG=1;
// tests/app/viewer/camera_test.cpp does the same with the window's contents drawn into memory.
#include <algorithm>
#include <random>

#include "app/window/real_window.h"

namespace glimt {
namespace {

namespace fs = std::filesystem;
using testing::wait_for;

class RandomDoings : public testing::WindowTest, public ::testing::WithParamInterface<const char*> {
 protected:
  void SetUp() override {
    if (std::getenv("GLIMT_LONG") == nullptr) GTEST_SKIP() << "takes minutes: GLIMT_LONG=1";
    WindowTest::SetUp();
  }

  /// report.toml, cornell.toml, or the report's room with the camera in a ball of glass; "+" adds the outside view.
  static Scene scene_for(const std::string& name) {
    const std::string base = name.substr(0, name.find('+'));
    Scene scene = read_scene(std::string(GLIMT_SCENES) + (base == "cornell" ? "/cornell.toml" : "/report.toml"));
    if (base == "glass") {
      scene.camera.eye = {2, 0, 0};
      scene.spheres.push_back({"around", "glass", scene.camera.eye, 0.9});
    }
    if (base != name) scene.camera.cutaway = Cutaway::on;
    scene.image = {100, 75};
    scene.render.spp = 16;
    return scene;
  }

  /// A drag, the wheel or a flight, somewhere in the picture; returns xdotool's words for it.
  std::string random_doing() {
    const auto [x, y, width, height] = widgets()["image"];
    const auto below = [&](double n) { return std::to_string(static_cast<int>(random_() % static_cast<unsigned>(n))); };
    const auto centred = [&](int n) {
      return std::to_string(static_cast<int>(random_() % static_cast<unsigned>(2 * n)) - n);
    };
    const std::string to =
        "mousemove --window " + in_window() + " " +
        std::to_string(std::lround(x) + static_cast<long>(random_() % static_cast<unsigned>(width))) + " " +
        std::to_string(std::lround(y) + static_cast<long>(random_() % static_cast<unsigned>(height)));
    const std::string move = " sleep 0.03 mousemove_relative -- " + centred(300) + " " + centred(200) + " sleep 0.03 ";
    const std::string wheel = random_() % 2 == 0 ? "4" : "5";
    switch (random_() % 6) {
      case 0:
        return to + " sleep 0.03 click --repeat " + below(9) + "1 --delay 5 " + wheel + " sleep 0.03";
      case 1: {
        constexpr const char* keys[]{"w", "a", "s", "d", "q", "e", "Up", "Down", "Left", "Right"};
        const std::string key = keys[random_() % 10];
        return to + " sleep 0.03 mousedown 3" + move + "click --repeat 3 " + wheel + " keydown " + key +
               " sleep 0.2 keyup " + key + " mouseup 3 sleep 0.03";
      }
      case 2:
        return to + " keydown alt sleep 0.03 mousedown 1" + move + "mouseup 1 keyup alt sleep 0.03";
      default: {
        const std::string button = std::to_string(1 + random_() % 3);
        return to + " sleep 0.03 mousedown " + button + move + "mouseup " + button + " sleep 0.03";
      }
    }
  }

  /// Share of the pixels that are shown brighter than 8 of 255 (sRGB: 8 / 255 / 12.92), in a snapshot.
  double seen_share() {
    xdotool("key shift+s");
    char file[32];
    std::snprintf(file, sizeof file, "room-%03d.exr", ++snapshots_);
    const bool written =
        wait_for([&] { return fs::exists(file) && fs::file_size(file) > 0 && read_metadata(file).contains("scene"); });
    EXPECT_TRUE(written) << file;
    last_snapshot_ = file;
    const Image picture = read_image(file);
    int seen = 0;
    for (std::size_t i = 0; i < picture.rgb.size(); i += 3)
      seen += std::max({picture.rgb[i], picture.rgb[i + 1], picture.rgb[i + 2]}) > 0.0024F ? 1 : 0;
    return 3.0 * seen / static_cast<double>(picture.rgb.size());
  }

  std::mt19937 random_{13};
};

TEST_P(RandomDoings, NeverLeadToABlackPicture) {
  std::ofstream("room.toml") << write_scene(scene_for(GetParam()));
  open_window("room.toml");
  ASSERT_TRUE(wait_for([] { return has_samples(); }));
  ASSERT_GT(seen_share(), 0.05);
  std::string doings;
  for (int i = 1; i <= 500; ++i) {
    const std::string doing = random_doing();
    xdotool(doing);
    doings += doing + '\n';
    ASSERT_FALSE(widgets().contains("notice")) << doings;
    if (i % 10 != 0) continue;
    ASSERT_GT(seen_share(), 0.05) << doings
                                  << write_scene(
                                         parse_scene(read_metadata(last_snapshot_).at("scene"), last_snapshot_));
    doings.clear();
  }
  close_window();
}

INSTANTIATE_TEST_SUITE_P(Scenes, RandomDoings,
                         ::testing::Values("report", "cornell", "glass", "report+outside", "cornell+outside",
                                           "glass+outside"),
                         [](const auto& scene) {
                           std::string name = scene.param;
                           std::ranges::replace(name, '+', '_');
                           return name;
                         });

}  // namespace
}  // namespace glimt
