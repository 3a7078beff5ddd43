#include <gtest/gtest.h>
#include <unistd.h>

#include <atomic>
#include <chrono>
#include <cstdlib>
#include <fstream>
#include <glm/geometric.hpp>
#include <numbers>
#include <string>
#include <thread>

#include "film/display.h"
#include "film/image_file.h"
#include "scene/camera_view.h"
#include "scene/fields.h"
#include "scene/file/scene_file.h"
#include "viewer/picture/outline.h"
#include "viewer/state/camera_moves.h"
#include "viewer/state/edit.h"
#include "viewer/state/file_watch.h"
#include "viewer/state/history.h"
#include "viewer/state/render_goal.h"
#include "viewer/state/snapshot.h"
#include "viewer/state/window_settings.h"
#include "viewer/widgets/colour.h"
#include "viewer/widgets/labels.h"
#include "viewer/widgets/layout.h"

/// The parts of the window that need no OpenGL.
namespace glimt {
namespace {

TEST(Snapshot, NamesTheFolderThatCannotBeWritten) {
  try {
    reserve_snapshot_file("/proc/nowhere", "picture", "png");
    FAIL() << "nothing can be written there";
  } catch (const ImageFileError& error) {
    EXPECT_NE(std::string(error.what()).find("/proc/nowhere"), std::string::npos) << error.what();
  }
}

TEST(Edit, SharedMaterialIsCopiedUnderAnUnusedName) {
  Scene scene;
  scene.materials = {Material{.name = "white"}, Material{.name = "ball"}};
  scene.spheres = {Sphere{.name = "ball", .material = "white"}, Sphere{.name = "other", .material = "white"}};
  Material glass{.name = "any", .type = "glass"};
  set_material(scene, {ObjectKind::sphere, 0}, glass);
  ASSERT_EQ(scene.spheres[0].material, "ball-2") << "\"ball\" is taken";
  EXPECT_EQ(find_material(scene, "ball-2")->type, "glass");
  EXPECT_EQ(find_material(scene, "white")->type, "lambertian");

  set_material(scene, {ObjectKind::sphere, 0}, Material{.name = "any", .type = "mirror"});
  EXPECT_EQ(scene.materials.size(), 3U) << "its own by now";
  EXPECT_EQ(find_material(scene, "ball-2")->type, "mirror");
}

TEST(Edit, LampsGrowAboutTheirMiddle) {
  Scene scene;
  scene.materials = {Material{.name = "lamp", .type = "light"}, Material{.name = "white"}};
  scene.polygons = {
      Polygon{.name = "square", .material = "lamp", .vertices = {{1, 5, 0}, {3, 5, 0}, {3, 5, 2}, {1, 5, 2}}}};
  scene.spheres = {Sphere{.name = "bulb", .material = "lamp", .center = {1, 2, 3}, .radius = 2},
                   Sphere{.name = "", .material = "white"}};
  const ObjectId bulb{ObjectKind::sphere, 0}, square{ObjectKind::polygon, 0};
  EXPECT_EQ(lamps_of(scene), (std::vector{bulb, square}));
  EXPECT_EQ(size_of(scene, bulb), 4);
  EXPECT_EQ(size_of(scene, square), 2);
  scale(scene, bulb, 0.5);
  scale(scene, square, 2);
  EXPECT_EQ(scene.spheres[0].radius, 1);
  EXPECT_EQ(scene.polygons[0].vertices[0], glm::dvec3(0, 5, -1));
  EXPECT_EQ(scene.polygons[0].vertices[2], glm::dvec3(4, 5, 3));
}

TEST(Edit, SaysWhyAShapeCannotBeOfAMaterial) {
  const Scene scene = read_scene(GLIMT_SCENES "/report.toml");
  const ObjectId wall{ObjectKind::polygon, 0}, glass{ObjectKind::sphere, 3}, solid{ObjectKind::mesh, 0};
  EXPECT_NE(obstacle_to(scene, wall, "glass").find("open"), std::string::npos);
  for (const auto& info : material_infos()) {
    EXPECT_EQ(obstacle_to(scene, glass, info.name), "") << info.name;
    EXPECT_EQ(obstacle_to(scene, wall, info.name) == "", info.name != "glass") << info.name;
  }
  EXPECT_EQ(obstacle_to(scene, solid, "glass"), "") << "a tetrahedron is closed";
}

TEST(RenderGoal, StopsTheWindowAndLeavesTheFile) {
  Scene file;
  file.render.spp = 50;
  file.render.target_error = 0.25;
  EXPECT_FALSE(has_target(as_shown(file, {}, {}).render));
  const Scene samples = as_shown(file, {.stop_at = StopAt::samples, .samples = 7}, {});
  EXPECT_EQ(samples.render.spp, 7);
  EXPECT_EQ(samples.render.target_error, 0);
  EXPECT_EQ(as_shown(file, {.stop_at = StopAt::error, .error = 0.5}, {}).render.target_error, 0.5);
  EXPECT_EQ(as_filed(samples, file, false), file);
  EXPECT_EQ(goal_for(file, {}).samples, 50);
  EXPECT_EQ(goal_for(file, {}).error, 0.25);
  const Scene fitted = as_shown(file, {}, ImageSize{123, 45});
  EXPECT_EQ(fitted.image, (ImageSize{123, 45}));
  EXPECT_EQ(as_filed(fitted, file, true), file);
  EXPECT_EQ(as_filed(fitted, file, false).image, fitted.image) << "a size that was typed";
  // The grid of sub-pixel centres has as many cells as there are samples.
  file.render.sampler = Sampler::centres;
  EXPECT_EQ(as_shown(file, {}, {}).render.spp, 50);
}

Document document(const std::string& name) {
  Scene scene;
  scene.name = name;
  return {std::make_shared<const Scene>(scene), name + ".toml"};
}

TEST(History, GoesBackAndForth) {
  History history;
  EXPECT_FALSE(history.undo(document("a")));
  history.edited(document("a"), 0);
  history.edited(document("b"), 0);
  EXPECT_EQ(history.undo(document("c"))->file, "b.toml");
  EXPECT_EQ(history.undo(document("b"))->file, "a.toml");
  EXPECT_FALSE(history.can_undo());
  EXPECT_EQ(history.redo(document("a"))->file, "b.toml");
  history.edited(document("b"), 0);
  EXPECT_FALSE(history.can_redo()) << "another way was taken";
}

TEST(History, EditsOfOneGestureAreOne) {
  History history;
  history.edited(document("a"), 7);
  history.edited(document("b"), 7);
  history.edited(document("c"), 7);
  history.edited(document("d"), 8);
  EXPECT_EQ(history.undo(document("e"))->file, "d.toml");
  EXPECT_EQ(history.undo(document("d"))->file, "a.toml");
  history.redo(document("a"));
  history.edited(document("d"), 7);
  EXPECT_EQ(history.undo(document("f"))->file, "d.toml") << "after an undo a gesture does not go on";
}

TEST(CameraMoves, OrbitStopsShortOfThePole) {
  const Camera camera{.eye = {0, 0, 5}, .look_at = {0, 0, 0}};
  const Camera up = orbit(camera, camera.look_at, 0, -10);
  EXPECT_NEAR(distance(up.eye, up.look_at), 5, 1e-12);
  EXPECT_GT(up.eye.y, 4.9) << "high above";
  EXPECT_GT(length(cross(normalize(up.look_at - up.eye), up.up)), 0.04);
  EXPECT_EQ(up.up, camera.up);
  const Camera quarter = orbit(camera, camera.look_at, std::numbers::pi / 2, 0);
  EXPECT_LT(distance(quarter.eye, glm::dvec3(5, 0, 0)), 1e-12);
  const Camera beyond = orbit(up, up.look_at, 0, -1);
  EXPECT_LT(distance(beyond.eye, up.eye), 1e-9);
}

TEST(CameraMoves, DollyNeverArrives) {
  Camera camera{.eye = {0, 0, 5}, .look_at = {0, 0, 0}};
  EXPECT_EQ(dolly(camera, 0.5).eye, glm::dvec3(0, 0, 2.5));
  for (int i = 0; i < 1000; ++i) camera = dolly(camera, 0.5);
  EXPECT_GT(camera.eye.z, 0);
}

// A tangent from the eye touches the sphere: its outline is seen at asin(radius / distance) from the middle.
TEST(Outline, OfASphereIsItsCircleOfTangents) {
  Scene scene;
  scene.camera = {.eye = {0, 0, 5}, .look_at = {0, 0, 0}, .fov_y = 60};
  scene.image = {200, 200};
  scene.spheres = {Sphere{.name = "", .material = "", .center = {0, 0, 0}, .radius = 2}};
  const double pixel = 2 * std::tan(std::numbers::pi / 6) / 200;
  const double expected = std::tan(std::asin(2.0 / 5)) / pixel;
  const auto pieces = outline_of(scene, {ObjectKind::sphere, 0});
  ASSERT_GT(pieces.size(), 50U);
  for (const OutlinePiece& piece : pieces) {
    EXPECT_NEAR(glm::distance(piece.from, glm::dvec2(100, 100)), expected, 1e-6);
    EXPECT_FALSE(piece.hidden);
  }
  scene.polygons = {Polygon{.name = "",
                            .material = "",
                            .vertices = {{0, -3, 3}, {3, -3, 3}, {3, 3, 3}, {0, 3, 3}}}};  // before the right half
  for (const OutlinePiece& piece : outline_of(scene, {ObjectKind::sphere, 0}))
    EXPECT_EQ(piece.hidden, piece.from.x + piece.to.x > 200) << piece.from.x;
  scene.spheres[0].radius = 6;
  EXPECT_TRUE(outline_of(scene, {ObjectKind::sphere, 0}).empty()) << "the camera is inside";
}

// A cube seen from the front shows its four front edges and not the diagonals of its faces.
TEST(Outline, OfAMeshIsItsSilhouette) {
  Scene scene;
  scene.camera = {.eye = {0, 0, 8}, .look_at = {0, 0, 0}};
  scene.meshes = {Mesh{
      .name = "",
      .material = "",
      .vertices = {{-1, -1, 1}, {1, -1, 1}, {1, 1, 1}, {-1, 1, 1}, {-1, -1, -1}, {1, -1, -1}, {1, 1, -1}, {-1, 1, -1}},
      .triangles = {{0, 1, 2},
                    {0, 2, 3},
                    {5, 4, 7},
                    {5, 7, 6},
                    {1, 5, 6},
                    {1, 6, 2},
                    {4, 0, 3},
                    {4, 3, 7},
                    {3, 2, 6},
                    {3, 6, 7},
                    {4, 5, 1},
                    {4, 1, 0}}}};
  const CameraView view(scene.camera, scene.image);
  const glm::dvec2 low = *view.project({-1, 1, 1}), high = *view.project({1, -1, 1});
  double length = 0;
  for (const OutlinePiece& piece : outline_of(scene, {ObjectKind::mesh, 0})) {
    length += glm::distance(piece.from, piece.to);
    const bool on_frame = std::abs(piece.from.x - low.x) < 1e-6 || std::abs(piece.from.x - high.x) < 1e-6 ||
                          std::abs(piece.from.y - low.y) < 1e-6 || std::abs(piece.from.y - high.y) < 1e-6;
    EXPECT_TRUE(on_frame);
  }
  EXPECT_NEAR(length, 4 * (high.x - low.x), 1e-6);
}

class SettingsFile : public ::testing::Test {
 protected:
  void SetUp() override { std::filesystem::remove_all(folder); }
  void TearDown() override { std::filesystem::remove_all(folder); }
  const std::filesystem::path folder =
      std::filesystem::path(::testing::TempDir()) / ("glimt_settings_" + std::to_string(getpid()));
  const std::filesystem::path file = folder / "glimt" / "window.toml";
  std::string note;
};

TEST_F(SettingsFile, SurviveARestart) {
  EXPECT_EQ(read_window_settings(file, note).width, WindowSettings{}.width) << "none yet";
  WindowSettings settings{.width = 900,
                          .height = 700,
                          .display = {.exposure = -1.25, .tone = Tone::filmic},
                          .folder = "/a \"b\"",
                          .hint_seen = true,
                          .chart = {true, Across::samples},
                          .drag_view = DragView::orbit};
  write_window_settings(file, settings);
  const WindowSettings back = read_window_settings(file, note);
  EXPECT_EQ(note, "");
  EXPECT_EQ(back.width, 900);
  EXPECT_EQ(back.height, 700);
  EXPECT_EQ(back.display, settings.display);
  EXPECT_EQ(back.folder, settings.folder);
  EXPECT_EQ(back.chart, settings.chart);
  EXPECT_EQ(back.drag_view, settings.drag_view);
  EXPECT_TRUE(back.hint_seen);
}

TEST_F(SettingsFile, DamagedOnesAreIgnoredWithANote) {
  std::filesystem::create_directories(file.parent_path());
  for (const char* text : {"width = ", "width = \"wide\"", "height = -5", "width = 99999999999", "hint_seen = 1",
                           "drag_view = \"up\"", "\x01\xff"}) {
    std::ofstream(file) << text;
    note.clear();
    const WindowSettings back = read_window_settings(file, note);
    EXPECT_EQ(back.width, WindowSettings{}.width);
    EXPECT_EQ(back.height, WindowSettings{}.height);
    EXPECT_NE(note.find(file.string()), std::string::npos) << text << ": " << note;
  }
}

TEST_F(SettingsFile, AreInTheUsersConfigurationDirectory) {
  setenv("XDG_CONFIG_HOME", folder.c_str(), 1);
  EXPECT_EQ(window_settings_file(), file);
  setenv("XDG_CONFIG_HOME", "", 1);
  setenv("HOME", "/home/me", 1);
  EXPECT_EQ(window_settings_file(), "/home/me/.config/glimt/window.toml");
}

TEST_F(SettingsFile, WatchTellsOfAChangeOnce) {
  std::filesystem::create_directories(folder);
  const auto watched = folder / "scene.toml";
  std::ofstream(watched) << "a";
  std::atomic<int> woken{0};
  FileWatch watch([&] { ++woken; });
  watch.watch(watched);
  const auto wait = [&](int times) {
    for (int i = 0; i < 6000 && woken < times; ++i) std::this_thread::sleep_for(std::chrono::milliseconds(10));
    return woken.load();
  };
  std::ofstream(watched) << "bb";
  EXPECT_EQ(wait(1), 1);
  EXPECT_TRUE(watch.changed());
  EXPECT_FALSE(watch.changed());
  std::ofstream(folder / "other") << "ccc";
  std::filesystem::rename(folder / "other", watched);  // as editors save
  EXPECT_EQ(wait(2), 2);
  EXPECT_TRUE(watch.changed());
}

TEST(Layout, MagnifiedPicturesKeepThePointUnderTheMouse) {
  const Rect area{0, 0, 960, 800};
  const PicturePlace fitted = place_image(400, 400, area, 1);
  const Zoom zoom = zoomed(fitted, area, 5, 300, 250);
  const PicturePlace place = place_image(400, 400, area, 1, zoom);
  EXPECT_EQ(place.zoom, 5);
  const auto share = [](const PicturePlace& p, float x) { return (x - p.rect.x) / p.rect.width; };
  EXPECT_NEAR(share(place, 300), share(fitted, 300), 1e-3);
  const PicturePlace far = place_image(400, 400, area, 1, moved(place, area, 1e6F, -1e6F));
  EXPECT_EQ(far.rect.x, 0) << "no empty space at the side";
  EXPECT_EQ(far.rect.y + far.rect.height, 800);
  const PicturePlace small = place_image(400, 400, area, 1, {.zoom = 1});
  EXPECT_EQ(small.rect.x, 280) << "in the middle where it fits";
  EXPECT_EQ(place_image(400, 400, area, 1, {}).zoom, 2) << "0 is fitted";
}

TEST(Layout, PicturesAreMagnifiedByWholeNumbersWhereThatCostsLittle) {
  const PicturePlace doubled = place_image(400, 400, {0, 0, 960, 800}, 1);
  EXPECT_EQ(doubled.zoom, 2);
  EXPECT_TRUE(doubled.whole);
  EXPECT_EQ(doubled.rect.x, 80);
  const PicturePlace uneven = place_image(400, 400, {0, 0, 600, 600}, 1);  // 1 instead of 1.5 would cost a third
  EXPECT_EQ(uneven.zoom, 1.5F);
  EXPECT_FALSE(uneven.whole);
  const PicturePlace shrunk = place_image(1920, 1080, {0, 0, 960, 800}, 1);
  EXPECT_EQ(shrunk.zoom, 0.5F);
  EXPECT_FALSE(shrunk.whole);
  EXPECT_EQ(place_image(400, 400, {0, 0, 400, 400}, 2).zoom, 2) << "framebuffer pixels count";
}

TEST(Colour, SwatchesLookAsInThePicture) {
  for (int code = 0; code < 256; ++code) {
    const double linear = linear_from_srgb(code / 255.0);
    EXPECT_NEAR(255 * srgb_from_linear(linear), code, 1e-9);
    const auto value = static_cast<float>(linear);
    EXPECT_EQ(to_srgb8(Image{1, 1, {value, value, value}}, {.dither = Dither::off})[0], code);
  }
}

TEST(Labels, AreWords) {
  EXPECT_EQ(label_of("shadow_rays"), "Shadow rays");
  EXPECT_EQ(label_of("oren-nayar"), "Oren-Nayar");
  EXPECT_EQ(label_of("ior"), "Refractive index");
  EXPECT_EQ(unit_of("roughness", "slope angle, radians"), "rad");
  EXPECT_EQ(unit_of("roughness", "from smooth to roughest"), "");
  EXPECT_EQ(unit_of("radius", "radius, metres"), "m");
}

}  // namespace
}  // namespace glimt
