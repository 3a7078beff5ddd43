// What mouse and keys do with the camera: it stays where there is something to see.
#include <glm/geometric.hpp>
#include <random>

#include "app/viewer/offscreen.h"
#include "scene/camera_view.h"
#include "scene/clearance.h"
#include "scene/surroundings.h"
#include "scene_parts.h"
#include "viewer/state/camera_moves.h"

using namespace glimt;
using namespace glimt::testing;

namespace {

constexpr int window_width = 900, window_height = 500;
constexpr int right_button = 1, middle_button = 2;

/// Of all pixels and channels.
double mean_of(const Image& image) {
  double sum = 0;
  for (const float value : image.rgb) sum += static_cast<double>(value);
  return sum / static_cast<double>(image.rgb.size());
}

/// Share of the pixels that are shown brighter than 8 of 255, which is black to the eye (sRGB: 8 / 255 / 12.92).
double seen_share(const Image& image) {
  int seen = 0;
  for (std::size_t i = 0; i < image.rgb.size(); i += 3)
    seen += std::max({image.rgb[i], image.rgb[i + 1], image.rgb[i + 2]}) > 0.0024F ? 1 : 0;
  return 3.0 * seen / static_cast<double>(image.rgb.size());
}

struct Grip {
  glm::dvec2 place;  ///< in the image
  glm::dvec3 point;  ///< in the world
};

Grip grip_at(const Scene& scene, const glm::dvec2& place) {
  const CameraView view(scene.camera, scene.image);
  const glm::dvec3 direction = view.direction(place);
  return {place, view.eye + direction * pick(scene, {view.eye, direction})->distance};
}

glm::dvec2 now_at(const Scene& scene, const glm::dvec3& point) {
  return CameraView(scene.camera, scene.image).project(point).value_or(glm::dvec2{-1e9});
}

void drag(Offscreen& window, const glm::dvec2& from, float dx, float dy, int button = 0) {
  window.drag_in_image(static_cast<float>(from.x), static_cast<float>(from.y), dx, dy, button);
}

/// With Alt held.
void alt_drag(Offscreen& window, const glm::dvec2& from, float dx, float dy) {
  ImGui::GetIO().KeyAlt = true;
  drag(window, from, dx, dy);
  ImGui::GetIO().KeyAlt = false;
}

/// With the right button held over the middle of the picture, `pictures` are drawn while a key is down.
void fly(Offscreen& window, int key, int pictures, float notches = 0) {
  ImGuiIO& io = ImGui::GetIO();
  const ImageSize& size = window.state().scene.image;
  io.MousePos = window.in_window(static_cast<float>(size.width) / 2, static_cast<float>(size.height) / 2);
  window.draw(2);
  io.MouseDown[right_button] = true;
  window.draw(2);
  io.MouseWheel = notches;
  window.draw(1);
  io.MouseWheel = 0;
  io.KeysDown[key] = true;
  window.draw(pictures);
  io.KeysDown[key] = false;
  window.draw(1);
  io.MouseDown[right_button] = false;
  window.draw(2);
}

TEST(CameraDrag, InAClosedRoomTurnsTheViewAboutTheEye) {
  Offscreen window(small_room(), window_width, window_height);
  ASSERT_TRUE(window.draw_until_finished());
  ASSERT_TRUE(window.state().enclosed);
  const Scene before = window.state().scene;
  const Grip grip = grip_at(before, {52, 40});
  drag(window, grip.place, 40, 12);
  const Scene& after = window.state().scene;
  EXPECT_EQ(after.camera.eye, before.camera.eye);
  EXPECT_NE(after.camera.look_at, before.camera.look_at);
  const Rect r = window.widget("image");
  const glm::dvec2 mouse = grip.place + glm::dvec2(40, 12) * (96.0 / r.width);
  EXPECT_LT(glm::distance(now_at(after, grip.point), mouse), 0.6) << "near the middle the picture follows the mouse";
  EXPECT_FALSE(window.state().selected) << "a drag is no click";

  Edits edits;
  edits.undo = true;
  window.apply(edits);
  EXPECT_EQ(window.state().scene, before) << "the whole drag is one edit";
  EXPECT_FALSE(window.state().can_undo);
}

TEST(CameraDrag, WithAltOrbitsAboutThePointUnderTheMouse) {
  Offscreen window(small_room(), window_width, window_height);
  ASSERT_TRUE(window.draw_until_finished());
  const Scene before = window.state().scene;
  const Grip grip = grip_at(before, {52, 60});
  alt_drag(window, grip.place, 20, 8);
  const Scene& after = window.state().scene;
  EXPECT_NE(after.camera.eye, before.camera.eye);
  EXPECT_NEAR(distance(after.camera.eye, grip.point), distance(before.camera.eye, grip.point), 1e-2);
  EXPECT_LT(glm::distance(now_at(after, grip.point), grip.place), 0.2) << "it stays where it is in the picture";
}

TEST(CameraDrag, OutsideOrbitsAndThePanelSaysWhich) {
  Scene scene = read_scene(GLIMT_SCENES "/cornell.toml", std::vector<std::string>{"image.width=96", "image.height=96"});
  scene.render.spp = 4;
  Offscreen window(scene, window_width, window_height + 300);
  ASSERT_TRUE(window.draw_until_finished());
  ASSERT_FALSE(window.state().enclosed) << "the box is open to the front";
  const Camera before = window.state().scene.camera;
  drag(window, {48, 60}, 20, 0);
  EXPECT_NE(window.state().scene.camera.eye, before.eye);
  const Camera orbited = window.state().scene.camera;
  alt_drag(window, {48, 60}, 20, 0);
  EXPECT_EQ(window.state().scene.camera.eye, orbited.eye);
  EXPECT_NE(window.state().scene.camera.look_at, orbited.look_at);

  // The choice is in the panel: orbit, then turn.
  window.press("tab.camera");
  window.press("camera.drag");
  window.press("camera.drag.turn");
  EXPECT_EQ(window.state().drag_view, DragView::turn);
  const Camera turned = window.state().scene.camera;
  drag(window, {48, 60}, -20, 0);
  EXPECT_EQ(window.state().scene.camera.eye, turned.eye);
  EXPECT_NE(window.state().scene.camera.look_at, turned.look_at);
}

TEST(CameraFlight, KeysMoveWhileTheRightButtonIsHeld) {
  Offscreen window(small_room(), window_width, window_height);
  ASSERT_TRUE(window.draw_until_finished());
  const Camera before = window.state().scene.camera;
  ImGui::GetIO().KeysDown['W'] = true;
  window.draw(5);
  ImGui::GetIO().KeysDown['W'] = false;
  EXPECT_EQ(window.state().scene.camera, before) << "the button is not held";

  struct Case {
    int key;
    glm::dvec3 way;
  };
  // The camera looks along x, with z to its right.
  for (const auto& [key, way] : {Case{'W', {1, 0, 0}}, Case{'S', {-1, 0, 0}}, Case{'A', {0, 0, -1}},
                                 Case{'D', {0, 0, 1}}, Case{'Q', {0, -1, 0}}, Case{'E', {0, 1, 0}}}) {
    const Camera was = window.state().scene.camera;
    fly(window, key, 12);
    const glm::dvec3 step = window.state().scene.camera.eye - was.eye;
    EXPECT_GT(dot(step, way), 0.1) << static_cast<char>(key);
    EXPECT_LT(length(step - way * dot(step, way)), 1e-9) << static_cast<char>(key);
    EXPECT_LT(distance(window.state().scene.camera.look_at - was.look_at, step), 1e-9);
  }
  EXPECT_FALSE(window.screen().flying());
  EXPECT_TRUE(ImGui::GetIO().ConfigFlags == ImGuiConfigFlags_None);

  // A notch of the wheel makes it 1.25 times as fast, and does not dolly.
  const Camera slow = window.state().scene.camera;
  fly(window, 'W', 12);
  const double slow_way = distance(window.state().scene.camera.eye, slow.eye);
  Edits edits;
  edits.edit(window.state()).camera = slow;
  window.apply(edits);
  fly(window, 'W', 12, 2);
  EXPECT_NEAR(distance(window.state().scene.camera.eye, slow.eye), slow_way * 1.25 * 1.25, 1e-6 * slow_way);
}

TEST(CameraFlight, StopsShortOfTheWall) {
  Offscreen window(small_room(), window_width, window_height);
  ASSERT_TRUE(window.draw_until_finished());
  const double margin = camera_margin(window.state().scene);
  fly(window, 'S', 100);
  EXPECT_NEAR(clearance(window.state().scene, window.state().scene.camera.eye), margin, 1e-3 * margin);
  EXPECT_TRUE(window.state().enclosed);
  fly(window, 'W', 5, 40);
  EXPECT_TRUE(window.state().enclosed) << "at 7500 times the speed too";
  EXPECT_GE(clearance(window.state().scene, window.state().scene.camera.eye), margin * (1 - 1e-9));
}

TEST(CameraMoves, WheelBackwardsStaysInTheRoom) {
  Offscreen window(small_room(), window_width, window_height);
  ASSERT_TRUE(window.draw_until_finished());
  for (int i = 0; i < 20; ++i) window.scroll_in_image(48, 36, -1);
  EXPECT_TRUE(window.state().enclosed);
  const Camera back = window.state().scene.camera;
  window.scroll_in_image(48, 36, 1);
  EXPECT_GT(back.look_at.x - window.state().scene.camera.eye.x, 0) << "and comes forward at once";
  EXPECT_GT(distance(window.state().scene.camera.eye, back.eye), 0.5);
}

TEST(CameraMoves, ViewThatWouldBeBlackIsNotReached) {
  Scene scene = read_scene(GLIMT_SCENES "/cornell.toml");
  // From before the open box, half a turn away from it.
  const Camera away = approach_orbit(scene, scene.camera.eye, 3.1, 0);
  scene.camera = away;
  EXPECT_GT(lit_share(scene), 0.1);
  EXPECT_GT(lit_share(scene), 0) << "some of the box is still seen";
  scene.camera = orbit(scene.camera, scene.camera.eye, 2, 0);
  EXPECT_EQ(lit_share(scene), 0);
  EXPECT_EQ(approach(scene, pan(scene.camera, {0, 0, 1})), pan(scene.camera, {0, 0, 1}))
      << "where all is black already, any way out is free";
}

TEST(CameraMoves, SphereDoesNotComeOverTheEye) {
  Scene scene;
  scene.spheres = {{"ball", "", {0, 0, -5}, 1}};
  scene.camera = {.eye = {0, 0, 0}, .look_at = {0, 0, -5}};
  move_sphere(scene, 0, {0, 0, 4.5});
  EXPECT_GE(length(scene.spheres[0].center), 1 + camera_margin(scene) * (1 - 1e-9));
  scene.spheres[0] = {"ball", "", {0, 0, 0.2}, 1};
  move_sphere(scene, 0, {0, 0, 3});
  EXPECT_NEAR(length(scene.spheres[0].center), 1 - camera_margin(scene), 1e-9) << "the eye stays inside";
}

TEST(CameraNotice, SaysThatTheCameraIsOutsideAndBringsItBack) {
  Offscreen window(small_room(), window_width, window_height);
  ASSERT_TRUE(window.draw_until_finished());
  EXPECT_FALSE(window.widgets().contains("notice"));
  window.edit([](Scene& scene) { scene.camera.eye = {-9, 0, 0}; });
  ASSERT_TRUE(window.draw_until_finished());
  EXPECT_TRUE(window.widgets().contains("notice"));
  EXPECT_EQ(mean_of(window.state().frame->mean), 0) << "the wall hides all";
  save_screenshot(window, "outside-notice");
  window.press("notice.back");
  EXPECT_EQ(window.state().scene.camera, window.state().opened_camera);
  ASSERT_TRUE(window.draw_until_finished());
  EXPECT_FALSE(window.widgets().contains("notice"));
}

TEST(CameraNotice, FileWithTheCameraOutsideIsBroughtIntoTheMiddle) {
  Scene scene = small_room();
  scene.camera.eye = {-9, 0, 0};
  Offscreen window(scene, window_width, window_height);
  ASSERT_TRUE(window.draw_until_finished());
  ASSERT_TRUE(window.widgets().contains("notice.back"));
  window.press("notice.back");
  EXPECT_TRUE(window.state().enclosed);
  ASSERT_TRUE(window.draw_until_finished());
  EXPECT_FALSE(window.widgets().contains("notice"));
  EXPECT_GT(mean_of(window.state().frame->mean), 0.05);
}

TEST(CameraNotice, OutsideViewShowsTheRoomFromOutside) {
  Offscreen window(small_room(), window_width, window_height);
  ASSERT_TRUE(window.draw_until_finished());
  window.edit([](Scene& scene) {
    scene.camera.eye = {-16, 12, 10};
    scene.camera.look_at = {5, 0, 0};
  });
  ASSERT_TRUE(window.draw_until_finished());
  window.press("notice.cutaway");
  EXPECT_EQ(window.state().scene.camera.cutaway, Cutaway::on);
  ASSERT_TRUE(window.draw_until_finished());
  EXPECT_FALSE(window.widgets().contains("notice"));
  EXPECT_GT(window.state().frame->mean.pixel(48, 36)[0], 0.01F) << "the middle of the room is in the middle";
  save_screenshot(window, "outside-view");
}

/// Random drags, wheels and keys, one after the other; after each what is shown must be neither black nor explained.
/// GLIMT_LONG=1 makes them 500.
class RandomDoings : public ::testing::TestWithParam<const char*> {};

/// report.toml, cornell.toml, or a room with the camera in a ball of glass; "+" adds the outside view.
Scene scene_for(const std::string& name) {
  const std::string base = name.substr(0, name.find('+'));
  Scene scene = base == "cornell" ? read_scene(GLIMT_SCENES "/cornell.toml") : small_room();
  if (base == "glass") {
    scene.camera.eye = {2, 0, 0};
    scene.spheres.push_back({"around", "glass", scene.camera.eye, 0.9});
  }
  if (base != name) {
    scene.camera.cutaway = Cutaway::on;
    if (base == "report") scene.camera.eye = {-16, 12, 10}, scene.camera.look_at = {5, 0, 0};
  }
  scene.image = {48, 36};
  scene.render.spp = 2;
  return scene;
}

TEST_P(RandomDoings, NeverLeadToABlackPicture) {
  const int doings = std::getenv("GLIMT_LONG") != nullptr ? 500 : 60;
  Offscreen window(scene_for(GetParam()), 560, 320);
  ASSERT_TRUE(window.draw_until_finished());
  const double margin = camera_margin(window.state().scene);
  ASSERT_GT(seen_share(window.state().frame->mean), 0.05);
  const bool enclosed = window.state().enclosed;
  std::mt19937 random(13);
  const auto below = [&](int n) { return static_cast<int>(random() % static_cast<unsigned>(n)); };
  for (int i = 0; i < doings; ++i) {
    const float x = static_cast<float>(below(48)), y = static_cast<float>(below(36));
    const float dx = static_cast<float>(below(801) - 400), dy = static_cast<float>(below(601) - 300);
    const int what = below(6);
    std::string did;
    if (what == 0) {
      did = "wheel";
      window.scroll_in_image(x, y, static_cast<float>(below(21) - 10));
    } else if (what == 1) {
      did = "flight";
      constexpr std::array keys{'W', 'A', 'S', 'D', 'Q', 'E'};
      fly(window, keys[static_cast<std::size_t>(below(6))], 20, static_cast<float>(below(9) - 4));
    } else if (what == 2) {
      did = "alt drag";
      alt_drag(window, {x, y}, dx, dy);
    } else {
      did = "drag";
      drag(window, {x, y}, dx, dy, below(3));
    }
    const ViewerState& state = window.state();
    const std::string where =
        did + " " + std::to_string(i) + " of " + GetParam() + ", camera\n" + write_scene(state.scene);
    ASSERT_TRUE(window.draw_until_finished()) << where;
    ASSERT_FALSE(window.widgets().contains("notice")) << where;
    ASSERT_EQ(state.message.text, "") << where;
    ASSERT_GT(seen_share(state.frame->mean), 0.05) << where;
    if (state.scene.camera.cutaway == Cutaway::on) continue;
    ASSERT_GE(clearance(state.scene, state.scene.camera.eye), margin * 0.99) << where;
    ASSERT_TRUE(state.enclosed || !enclosed) << where;
  }
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
