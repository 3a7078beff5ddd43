#include "app/window/real_window.h"

#include <stb_image.h>

#include <algorithm>
#include <cstdio>
#include <set>

#include "material/oren_nayar.h"
#include "scene/fields.h"
#include "scene/pick.h"

namespace glimt {
namespace {

namespace fs = std::filesystem;
using testing::content;
using testing::have;
using testing::Process;
using testing::wait_for;
using testing::WindowTest;

const Material& material_of(const Scene& scene, const std::string& sphere) {
  for (const auto& s : scene.spheres) {
    if (s.name == sphere) return *find_material(scene, s.material);
  }
  throw std::runtime_error("no sphere called " + sphere);
}

TEST_F(WindowTest, EditsSceneTakesSnapshotAndQuits) {
  open_window(report_scene());

  click("object.lambertian");
  choose("object.type", "glass");
  ASSERT_TRUE(is_there("object.ior")) << content("widgets");

  click("object.oren-nayar");
  drag("object.roughness", 0.5, 0.25);

  // Taken until the edits are in it: a snapshot shows what is on the screen, which is a moment behind.
  Scene made;
  ASSERT_TRUE(wait_for([&] {
    made = snapshot("report");
    return material_of(made, "oren-nayar").get(OrenNayar::roughness) < 0.5;
  })) << content("program.log");
  const Scene before = read_scene(report_scene());
  EXPECT_EQ(material_of(made, "lambertian").type, "glass");
  EXPECT_NEAR(material_of(made, "oren-nayar").get(OrenNayar::roughness), 0.39, 0.03);  // a quarter of pi/2
  EXPECT_EQ(material_of(made, "glass"), material_of(before, "glass"));
  EXPECT_EQ(made.polygons, before.polygons);
  EXPECT_EQ(made.camera, before.camera);

  close_window();
}

TEST_F(WindowTest, FollowsItsSize) {
  open_window(report_scene());
  const double before = widgets()["snapshot"][0];
  xdotool("search --onlyvisible --name glimt windowsize 800 600");
  EXPECT_TRUE(wait_for([&] {
    const auto all = widgets();
    const auto& r = all.at("snapshot");
    return r[0] < before && r[0] + r[2] < 800;
  })) << content("widgets");
  close_window();
}

TEST_F(WindowTest, SpacePausesAndResumes) {
  open_window(report_scene());
  const auto pictures = [] {
    const std::string text = content("frames");
    return std::count(text.begin(), text.end(), '\n');
  };
  point_at("image");
  xdotool("key space");
  // The frames stop once it is paused; the mouse stays still.
  ASSERT_TRUE(wait_for([&] {
    const auto before = pictures();
    std::this_thread::sleep_for(std::chrono::milliseconds(500));
    return pictures() == before;
  }));
  const auto before = pictures();
  xdotool("key space");
  EXPECT_TRUE(wait_for([&] { return pictures() > before + 10; }));
  close_window();
}

/// The small window manager that decorates, moves and minimises windows.
class ManagedWindow : public WindowTest {
 protected:
  void SetUp() override {
    if (!have("twm")) GTEST_SKIP() << "needs twm (package twm)";
    WindowTest::SetUp();
    if (IsSkipped() || HasFatalFailure()) return;
    std::ofstream config("twmrc");
    config << "RandomPlacement\nNoGrabServer\n";
    for (const char* font : {"Title", "Menu", "Icon", "Resize", "IconManager"}) config << font << "Font \"fixed\"\n";
    config.close();
    setenv("LC_ALL", "C", 1);
    manager_ = std::make_unique<Process>(std::vector<std::string>{"twm", "-f", "twmrc"}, "manager.log");
    room_ = read_scene(report_scene(), small_);
    std::ofstream("room.toml") << write_scene(room_);
    open_window("room.toml");
  }

  /// Drags everything with a number in the panel that is up.
  static void move_sliders() {
    for (const auto& [name, ignored] : widgets()) {
      const std::string group = name.substr(0, name.find('.') + 1), key = name.substr(name.rfind('.') + 1);
      static const std::set<std::string> groups{"render.", "lamp.", "camera.", "object.", "image."};
      // Neither menus nor colours nor what is typed.
      static const std::set<std::string> others{
          "seed",    "method",   "roulette", "reset",   "type",           "reflectance",        "radiance", "emission",
          "formula", "caustics", "mis",      "sampler", "light_sampling", "sphere_connections", "stop_at",  "fresnel"};
      if (name == "exposure" || (groups.contains(group) && !others.contains(key) && !names_an_object(name)))
        drag(name, 0.45, 0.55);
    }
  }

  static bool names_an_object(const std::string& widget) {
    const Scene scene = read_scene(report_scene());
    for (const auto& object : objects_of(scene))
      if (widget == "object." + name_of(scene, object)) return true;
    return false;
  }

  static std::size_t pictures() {
    const std::string text = content("frames");
    return static_cast<std::size_t>(std::count(text.begin(), text.end(), '\n'));
  }

  const std::vector<std::string> small_{"image.width=120", "image.height=90", "render.spp=16"};
  Scene room_;
};

std::vector<unsigned char> pixels_of(const std::string& file) {
  int width = 0, height = 0, channels = 0;
  unsigned char* data = stbi_load(file.c_str(), &width, &height, &channels, 3);
  if (data == nullptr) return {};
  const std::vector<unsigned char> pixels(data, data + 3 * static_cast<std::ptrdiff_t>(width) * height);
  stbi_image_free(data);
  return pixels;
}

TEST_F(ManagedWindow, EveryMaterialOnEverySphere) {
  for (const Sphere& sphere : room_.spheres) {
    click("object." + sphere.name);
    for (const auto& info : material_infos()) {
      choose("object.type", std::string(info.name));
      for (const auto& field : info.fields) EXPECT_TRUE(is_there("object." + std::string(field.key))) << field.key;
    }
    choose("object.type", sphere.name == "mirror" ? "light" : "mirror");
  }
  Scene made;
  ASSERT_TRUE(wait_for([&] {
    made = snapshot("room");
    return material_of(made, room_.spheres.back().name).type == "mirror";
  }));
  for (const Sphere& sphere : room_.spheres)
    EXPECT_EQ(material_of(made, sphere.name).type, sphere.name == "mirror" ? "light" : "mirror");
  close_window();
}

TEST_F(ManagedWindow, EverySliderMovesAndEverythingIsUndone) {
  click("object.oren-nayar");
  ASSERT_TRUE(is_there("object.roughness"));
  move_sliders();
  const std::array<std::array<const char*, 2>, 3> tabs{
      {{"tab.lamp", "lamp.lamp.size"}, {"tab.camera", "camera.fov_y"}, {"tab.estimator", "image.size"}}};
  for (const auto& [tab, control] : tabs) {
    click(tab);
    ASSERT_TRUE(is_there(control)) << control << " in\n" << content("widgets");
    move_sliders();
  }
  point_at("image");
  // How many samples were there when the snapshot was taken is no part of the edits.
  const auto untargeted = [](Scene scene) {
    scene.render = without_target(scene.render);
    return scene;
  };
  // A snapshot shows what is on the screen, which is a moment behind: two that are alike show the last edit.
  Scene edited;
  ASSERT_TRUE(wait_for([&] {
    const Scene before = std::exchange(edited, untargeted(snapshot("room")));
    std::this_thread::sleep_for(std::chrono::milliseconds(200));
    return edited == before && edited.image != room_.image;
  }));
  EXPECT_NE(material_of(edited, "oren-nayar").get(OrenNayar::roughness),
            material_of(room_, "oren-nayar").get(OrenNayar::roughness));
  EXPECT_NE(edited.spheres, room_.spheres);
  EXPECT_NE(edited.camera, room_.camera);
  EXPECT_NE(edited.render.shadow_rays, room_.render.shadow_rays);
  EXPECT_NE(edited.image, room_.image);
  EXPECT_NE(edited.polygons, room_.polygons) << "the lamp's size";

  const auto ends_with = [&](const char* key, const Scene& scene) {
    for (int i = 0; i < 40; ++i) xdotool(std::string("key ") + key);
    return wait_for([&] { return untargeted(snapshot("room")) == untargeted(scene); });
  };
  EXPECT_TRUE(ends_with("ctrl+z", room_));
  EXPECT_TRUE(ends_with("ctrl+shift+z", edited));
  close_window();
}

TEST_F(ManagedWindow, MouseSelectsAndOrbits) {
  stop_at_the_files_samples();
  ASSERT_FALSE(widgets().contains("object.type"));
  point_at("image", 0.5, 0.95);
  xdotool("sleep 0.05 click 1 sleep 0.05");
  EXPECT_TRUE(is_there("object.type")) << "the floor is selected";
  xdotool("key Escape");
  EXPECT_TRUE(is_gone("object.type"));
  ASSERT_TRUE(wait_for([] { return finished(); }));
  const Camera before = snapshot("room").camera;
  drag("image", 0.5, 0.55);
  std::this_thread::sleep_for(std::chrono::milliseconds(300));
  ASSERT_TRUE(wait_for([] { return finished(); }));
  EXPECT_NE(snapshot("room").camera, before);
  xdotool("key Home");
  std::this_thread::sleep_for(std::chrono::milliseconds(300));
  ASSERT_TRUE(wait_for([] { return finished(); }));
  EXPECT_EQ(snapshot("room").camera, before);
  close_window();
}

TEST_F(ManagedWindow, MinimisedItRestsAndComesBack) {
  ASSERT_TRUE(wait_for([&, before = pictures()] { return pictures() > before + 3; }));
  xdotool("windowsize --sync " + in_window() + " 900 640");
  ASSERT_TRUE(wait_for([] { return widgets()["snapshot"][0] < 900; }));
  const std::string id = folder_.string() + "/id";
  ASSERT_EQ(std::system(("echo " + in_window() + " > " + id).c_str()), 0);
  // Under a frame it is not where it would be without a window manager.
  EXPECT_NE(std::system(("xdotool getwindowgeometry $(cat " + id + ") | grep -q 'Position: 0,0 '").c_str()), 0);
  xdotool("windowminimize $(cat " + id + ")");
  ASSERT_TRUE(wait_for([] {
    const auto before = pictures();
    std::this_thread::sleep_for(std::chrono::milliseconds(400));
    return pictures() == before;
  })) << "nothing is drawn that nobody sees";
  const auto before = pictures();
  xdotool("windowmap $(cat " + id + ")");
  EXPECT_TRUE(wait_for([&] { return pictures() > before + 3; }));
  point_at("image");
  close_window();
}

TEST_F(ManagedWindow, SnapshotReopensAsTheSamePicture) {
  stop_at_the_files_samples();
  click("object.glass");
  choose("object.type", "oren-nayar");
  drag("exposure", 0.5, 0.55);
  point_at("image");
  ASSERT_TRUE(wait_for([] { return finished(); }));
  const Scene made = snapshot("room");
  const std::string picture = last_snapshot_;
  xdotool("key ctrl+z");
  xdotool("key ctrl+o");
  click("files." + picture);
  ASSERT_TRUE(says("Opened the scene in " + picture)) << content("widgets");
  ASSERT_TRUE(wait_for([] { return finished(); }));
  EXPECT_EQ(snapshot("room"), made);
  EXPECT_FALSE(pixels_of(picture).empty());
  EXPECT_EQ(pixels_of(picture), pixels_of(last_snapshot_)) << "bit for bit";
  close_window();
}

TEST_F(ManagedWindow, FollowsItsFile) {
  stop_at_the_files_samples();
  Scene other = room_;
  other.spheres[0].radius = 0.5;
  std::ofstream("room.toml") << write_scene(other);
  EXPECT_TRUE(says("Read room.toml again"));
  std::ofstream("room.toml") << write_scene(other) << "oops\n";
  EXPECT_TRUE(says("room.toml:")) << content("widgets");
  point_at("image");
  ASSERT_TRUE(wait_for([] { return finished(); }));
  EXPECT_EQ(snapshot("room"), other) << "the last good scene stays";
  std::ofstream("room.toml") << write_scene(room_);
  EXPECT_TRUE(says("Read room.toml again"));
  close_window();
}

TEST_F(ManagedWindow, SettingsSurviveARestartAndDamage) {
  click("display.tone");
  click("display.tone.filmic");
  xdotool("windowsize --sync " + in_window() + " 1000 700");
  ASSERT_TRUE(wait_for([] { return widgets()["snapshot"][0] < 1000; }));
  point_at("image");
  close_window();
  const fs::path file = folder_ / "config/glimt/window.toml";
  ASSERT_TRUE(fs::exists(file));
  open_window("room.toml");
  const auto& r = widgets()["snapshot"];
  EXPECT_LT(r[0] + r[2], 1000) << "as large as it was";
  point_at("image");
  snapshot("room");
  EXPECT_EQ(read_metadata(last_snapshot_).at("tone"), "filmic");
  close_window();

  std::ofstream(file) << "width = \"wide\"";
  open_window("room.toml");
  EXPECT_TRUE(says("damaged"));
  point_at("image");
  close_window();
}

TEST_F(WindowTest, DisplayThatDoesNotAnswerIsNamed) {
  server_.reset();
  Process program({GLIMT_PROGRAM, report_scene()}, "program.log");
  EXPECT_EQ(program.wait(), 1);
  const std::string said = content("program.log");
  EXPECT_NE(said.find("cannot open a window"), std::string::npos) << said;
  EXPECT_NE(said.find(std::getenv("DISPLAY")), std::string::npos) << said;
}

TEST_F(WindowTest, SceneThatCannotBeReadIsNamed) {
  std::ofstream("bad.toml") << "name = 1\n";
  Process program({GLIMT_PROGRAM, "bad.toml"}, "program.log");
  EXPECT_EQ(program.wait(), 2);
  const std::string said = content("program.log");
  EXPECT_TRUE(said.starts_with("bad.toml:1:")) << said;
  EXPECT_EQ(std::count(said.begin(), said.end(), '\n'), 1) << "one line";
}

}  // namespace
}  // namespace glimt
