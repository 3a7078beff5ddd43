#include <cmath>
#include <filesystem>
#include <fstream>
#include <glm/geometric.hpp>

#include "app/own_folder.h"
#include "app/viewer/offscreen.h"
#include "film/image_file.h"
#include "film/metadata.h"
#include "pictures.h"
#include "scene/camera_view.h"
#include "scene/file/scene_file.h"
#include "viewer/state/edit.h"

/// What a person does with the mouse on the picture, with files, and with undo; drawn into memory.
namespace glimt {
namespace {

namespace fs = std::filesystem;
using testing::Offscreen;
using testing::small_room;

constexpr int window_width = 1280, window_height = 800;

using ViewerEdit = testing::OwnFolder;

ObjectId object_called(const Scene& scene, const std::string& name) {
  for (const ObjectId& object : objects_of(scene))
    if (name_of(scene, object) == name) return object;
  throw std::runtime_error("no object called " + name);
}

/// Where the middle of a sphere is in the image.
glm::dvec2 middle_of(const Scene& scene, const std::string& sphere) {
  const CameraView view(scene.camera, scene.image);
  return view.project(scene.spheres[object_called(scene, sphere).index].center).value();
}

void click(Offscreen& window, const glm::dvec2& place) {
  window.click_in_image(static_cast<float>(place.x), static_cast<float>(place.y));
}

void open(Offscreen& window, const fs::path& file) {
  Edits edits;
  edits.open = file;
  window.apply(edits);
}

// A picture of the very scene and goal that are open: nothing is edited, and yet it is shown in its own size.
TEST_F(ViewerEdit, APictureOpensInItsOwnSize) {
  Scene room = small_room(2);
  room.render.spp = 2;
  Offscreen window(room, window_width, window_height);
  window.set_goal([](RenderGoal& goal) { goal.stop_at = StopAt::samples, goal.samples = 2; });
  const Film film = render(compile(room), 2);
  write_exr("room.exr", film.mean(), film.standard_error(), render_metadata(room, 2, 0));
  Edits fit, open;
  fit.fits_window = true;
  window.apply(fit);
  ASSERT_NE(window.state().scene.image, room.image);
  open.open = "room.exr";
  window.apply(open);
  EXPECT_FALSE(window.state().message.error) << window.state().message.text;
  EXPECT_FALSE(window.state().can_undo) << "nothing was edited";
  EXPECT_FALSE(window.state().fits_window);
  EXPECT_EQ(window.state().scene.image, room.image);
}

TEST_F(ViewerEdit, ClickSelectsWhatIsSeenThere) {
  Offscreen window(small_room(), window_width, window_height);
  ASSERT_TRUE(window.draw_until_finished());
  const Scene scene = window.state().scene;
  for (const Sphere& sphere : scene.spheres) {
    const glm::dvec2 place = middle_of(scene, sphere.name);
    const Rect r = window.widget("image");
    const auto x = static_cast<int>(r.x + place.x * r.width / 96), y = static_cast<int>(r.y + place.y * r.height / 72);
    click(window, place);
    EXPECT_EQ(window.state().selected, object_called(scene, sphere.name));
    EXPECT_TRUE(window.widgets().contains("object.radius"));
    // The outline is in its colour somewhere to the left of the middle.
    bool outlined = false;
    for (int i = 0; i < 300 && x - i > 0; ++i) {
      const auto [red, green, blue] = window.pixel(x - i, y);
      outlined |= red > 240 && std::abs(green - 190) < 12 && std::abs(blue - 92) < 25;
    }
    EXPECT_TRUE(outlined) << sphere.name;
  }
  click(window, {48, 70});
  EXPECT_EQ(window.state().selected, object_called(scene, "floor"));
  EXPECT_FALSE(window.widgets().contains("object.radius"));
  window.key({key_escape});
  EXPECT_FALSE(window.state().selected);
  EXPECT_EQ(window.state().scene, scene) << "looking changes nothing";
}

TEST_F(ViewerEdit, MiddleDragPansAndTheWheelDollies) {
  Offscreen window(small_room(), window_width, window_height);
  ASSERT_TRUE(window.draw_until_finished());
  const Camera before = window.state().scene.camera;
  window.drag_in_image(48, 36, 30, 0, 2);
  const Camera panned = window.state().scene.camera;
  EXPECT_LT(distance(panned.look_at - panned.eye, before.look_at - before.eye), 1e-9);
  EXPECT_LT(panned.eye.z, before.eye.z) << "z is to the right: the picture follows the mouse, so the camera goes left";
  EXPECT_NEAR(panned.eye.x, before.eye.x, 1e-9);

  window.scroll_in_image(48, 36, 2);
  const Camera near = window.state().scene.camera;
  EXPECT_NEAR(distance(near.eye, near.look_at), 0.81 * distance(panned.eye, panned.look_at), 1e-9);
  EXPECT_EQ(near.look_at, panned.look_at);

  window.press("tab.camera");
  window.press("camera.reset");
  EXPECT_EQ(window.state().scene.camera, before);
}

TEST_F(ViewerEdit, SelectedSphereFollowsTheMouse) {
  Offscreen window(small_room(), window_width, window_height);
  ASSERT_TRUE(window.draw_until_finished());
  const glm::dvec2 place = middle_of(window.state().scene, "lambertian");
  click(window, place);
  const Scene before = window.state().scene;
  window.drag_in_image(static_cast<float>(place.x), static_cast<float>(place.y), 0, -60);
  EXPECT_EQ(window.state().scene.camera, before.camera);
  const auto index = object_called(before, "lambertian").index;
  const double zoom = window.widget("image").width / 96;
  // Its front point moves by 60 window coordinates and the middle, which is further away, by a little less.
  const double risen = place.y - middle_of(window.state().scene, "lambertian").y;
  EXPECT_NEAR(risen * zoom, 60, 12);
  EXPECT_EQ(window.state().scene.spheres[index].radius, before.spheres[index].radius);
}

TEST_F(ViewerEdit, CtrlScrollMagnifiesThePictureAlone) {
  Offscreen window(small_room(), window_width, window_height);
  ASSERT_TRUE(window.draw_until_finished());
  const Scene before = window.state().scene;
  const ImVec2 under = window.in_window(30, 20);
  ImGui::GetIO().KeyCtrl = true;
  window.scroll_in_image(30, 20, 3);
  ImGui::GetIO().KeyCtrl = false;
  const ImVec2 now = window.in_window(30, 20);
  EXPECT_NEAR(now.x, under.x, 1.5F);
  EXPECT_NEAR(now.y, under.y, 1.5F);
  EXPECT_GT(window.widget("image").width, 1280);
  EXPECT_EQ(window.state().scene, before);
  // A click goes where the magnified picture shows the thing.
  click(window, middle_of(before, "mirror"));
  window.key({'f'});
  window.draw();
  EXPECT_LT(window.widget("image").width, 1280);
}

TEST_F(ViewerEdit, UndoAndRedoOfEveryEditBringTheSamplesBack) {
  Offscreen window(small_room(64), window_width, window_height);
  ASSERT_TRUE(window.draw_until_finished());
  std::vector<Scene> scenes{window.state().scene};
  const Frame first = *window.state().frame;
  const auto did = [&](const char* what) {
    ASSERT_NE(window.state().scene, scenes.back()) << what << ": " << window.state().message.text;
    scenes.push_back(window.state().scene);
  };
  window.press("object.lambertian");
  window.press("object.type");
  window.press("object.type.mirror");
  did("material");
  window.drag("object.radius", 0.7F);
  did("radius");
  window.press("tab.lamp");
  window.drag("lamp.lamp.size", 0.7F);
  did("size of the lamp");
  window.press("tab.estimator");
  window.press("render.shadow_rays", 0.5F);
  did("shadow rays");
  window.press("stop_at.number", 0.3F);
  did("target");
  open(window, fs::path(GLIMT_SCENES) / "cornell.toml");
  did("another file");
  EXPECT_EQ(window.state().file.filename(), "cornell.toml");

  for (std::size_t i = scenes.size() - 1; i-- > 0;) {
    window.press("undo");
    EXPECT_EQ(window.state().scene, scenes[i]) << i;
  }
  EXPECT_EQ(window.state().file.filename(), "picture.toml");
  EXPECT_FALSE(window.state().can_undo);
  ASSERT_TRUE(window.draw_until_finished());
  EXPECT_EQ(window.state().frame->seconds, first.seconds) << "the samples are those from before, not new ones";
  EXPECT_EQ(first_difference(window.state().frame->mean.rgb, first.mean.rgb), -1);
  for (std::size_t i = 1; i < scenes.size(); ++i) {
    window.press("redo");
    EXPECT_EQ(window.state().scene, scenes[i]) << i;
  }
  EXPECT_FALSE(window.state().can_redo);
}

TEST_F(ViewerEdit, TargetCanBeAnError) {
  Offscreen window(small_room(), window_width, window_height);
  ASSERT_TRUE(window.draw_until_finished());
  const auto version = window.state().frame->version;
  window.press("stop_at");
  window.press("stop_at.error");
  EXPECT_GT(window.state().scene.render.target_error, 0);
  window.press("stop_at.number", 0.8F);  // logarithmic from 1e-7 to 1 between the ends of the grab: 10^-1.2
  EXPECT_NEAR(std::log10(window.state().scene.render.target_error), -1.2, 0.1);
  ASSERT_TRUE(window.draw_until_finished());
  EXPECT_EQ(window.state().frame->version, version) << "never restarts";
  EXPECT_LE(window.state().frame->estimate.relmse_scaled, window.state().scene.render.target_error);
}

TEST_F(ViewerEdit, SnapshotReopensAsTheSameImage) {
  std::vector<float> made;
  Scene scene;
  const Display display{.exposure = 1.5, .tone = Tone::filmic};
  {
    Offscreen window(small_room(24), window_width, window_height);
    window.draw();
    window.press("object.oren-nayar");
    window.drag("object.roughness", 0.9F);
    Edits edits;
    edits.display = display;
    window.apply(edits);
    ASSERT_TRUE(window.draw_until_finished());
    scene = window.state().scene;
    made = window.state().frame->mean.rgb;
    window.press("snapshot");
    window.press("snapshot_exr");
    ASSERT_TRUE(window.draw_until([] {
      return fs::exists("picture-001.png") && fs::exists("picture-001.exr") && fs::file_size("picture-001.exr") > 0;
    }));
  }
  EXPECT_EQ(first_difference(read_image("picture-001.exr").rgb, made), -1) << "linear radiance, every bit";

  Offscreen window(read_scene(fs::path(GLIMT_SCENES) / "furnace.toml"), window_width, window_height);
  open(window, fs::absolute("picture-001.png"));
  EXPECT_FALSE(window.state().message.error) << window.state().message.text;
  EXPECT_EQ(window.state().scene, scene);
  EXPECT_EQ(window.state().display, display);
  ASSERT_TRUE(window.draw_until_finished());
  EXPECT_EQ(first_difference(window.state().frame->mean.rgb, made), -1);
  // And again from there, under a name that does not grow.
  window.press("snapshot");
  ASSERT_TRUE(window.draw_until([] { return fs::exists("picture-002.png"); }));
}

TEST_F(ViewerEdit, FileThatIsNoSceneIsRefusedByName) {
  Offscreen window(small_room(), window_width, window_height);
  ASSERT_TRUE(window.draw_until_finished());
  const Scene before = window.state().scene;
  write_png("plain.png", {1, 1, {0, 0, 0}}, {}, {});
  std::ofstream("notes.txt") << "no scene\n";
  for (const char* file : {"plain.png", "notes.txt", "missing.toml", "missing.png"}) {
    open(window, file);
    EXPECT_TRUE(window.state().message.error) << file;
    EXPECT_NE(window.state().message.text.find(file), std::string::npos) << window.state().message.text;
    EXPECT_EQ(window.state().scene, before);
  }
}

TEST_F(ViewerEdit, SceneFileChangedOnDiskIsReadAgain) {
  Scene scene = small_room();
  std::ofstream("room.toml") << write_scene(scene);
  Offscreen window(scene, window_width, window_height);
  open(window, "room.toml");
  ASSERT_TRUE(window.draw_until_finished());

  scene.spheres[0].radius = 0.5;
  std::ofstream("room.toml") << write_scene(scene);
  ASSERT_TRUE(window.draw_until([&] { return window.state().scene == scene; }));
  ASSERT_TRUE(window.draw_until_finished());
  EXPECT_TRUE(window.state().can_undo);

  std::ofstream("room.toml") << write_scene(scene) << "\n[camera]\neye = 3\n";
  ASSERT_TRUE(window.draw_until([&] { return window.state().message.error; }));
  EXPECT_TRUE(window.state().message.text.starts_with("room.toml:")) << window.state().message.text;
  EXPECT_EQ(window.state().scene, scene) << "the last good one stays";

  scene.spheres[0].radius = 0.7;
  std::ofstream("room.toml") << write_scene(scene);
  ASSERT_TRUE(window.draw_until([&] { return window.state().scene == scene; }));
  EXPECT_FALSE(window.state().message.error);
}

TEST_F(ViewerEdit, SavesAndOpensByTheSheets) {
  Offscreen window(small_room(), window_width, window_height);
  ASSERT_TRUE(window.draw_until_finished());
  Edits edits;
  edits.folder = folder;
  window.apply(edits);
  window.press("save");
  window.press("files.save");
  ASSERT_TRUE(fs::exists("picture.toml")) << window.state().message.text;
  const Scene saved = window.state().scene;
  EXPECT_EQ(read_scene("picture.toml"), saved);

  window.press("object.mirror");
  window.press("object.type");
  window.press("object.type.glass");
  ASSERT_NE(window.state().scene, saved);
  window.press("open");
  window.press("files.picture.toml");
  EXPECT_EQ(window.state().scene, saved);
}

TEST_F(ViewerEdit, HintGoesWithTheFirstDoing) {
  Offscreen window(small_room(), window_width, window_height);
  window.controller().recall({}, {}, {}, true, "");
  ASSERT_TRUE(window.draw_until_finished());
  EXPECT_TRUE(window.state().hint);
  click(window, {48, 70});
  EXPECT_FALSE(window.state().hint);
}

}  // namespace
}  // namespace glimt
