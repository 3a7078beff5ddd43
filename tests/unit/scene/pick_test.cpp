#include "scene/pick.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include "scene/camera_view.h"

using namespace glimt;

namespace {

constexpr ObjectId ball{ObjectKind::sphere, 0}, wall{ObjectKind::polygon, 0}, wedge{ObjectKind::mesh, 0};

/// Along z from z = 5 downwards: a wall at z = 0, in front of it a ball of radius 1 at z = 2, and to the right a
/// triangle at z = 1.
Scene three_things() {
  Scene scene;
  scene.spheres = {{"ball", "", {0, 0, 2}, 1}};
  scene.polygons = {{"wall", "", {{-4, -4, 0}, {4, -4, 0}, {4, 4, 0}, {-4, 4, 0}}}};
  scene.meshes = {{"wedge", "", {{2, 0, 1}, {3, 0, 1}, {2, 1, 1}}, {{0, 1, 2}}}};
  scene.camera = {.eye = {0, 0, 5}, .look_at = {0, 0, 0}};
  return scene;
}

WorldRay down(double x, double y) { return {{x, y, 5}, {0, 0, -1}}; }

TEST(Pick, FindsWhatIsInFront) {
  const Scene scene = three_things();
  const auto first = pick(scene, down(0, 0));
  ASSERT_TRUE(first);
  EXPECT_EQ(first->object, ball);
  EXPECT_DOUBLE_EQ(first->distance, 2);
  EXPECT_EQ(pick(scene, down(0.999, 0))->object, ball);
  EXPECT_EQ(pick(scene, down(1.001, 0))->object, wall);
  EXPECT_EQ(pick(scene, down(2.2, 0.2))->object, wedge);
  EXPECT_EQ(pick(scene, down(2.8, 0.8))->object, wall) << "beside the triangle, within its box";
  EXPECT_FALSE(pick(scene, down(5, 0)));
}

TEST(Pick, LooksThroughWhatIsLeftOut) {
  const auto behind = pick(three_things(), down(0, 0), ball);
  ASSERT_TRUE(behind);
  EXPECT_EQ(behind->object, wall);
  EXPECT_DOUBLE_EQ(behind->distance, 5);
}

TEST(Pick, SeesSurfacesFromBothSidesAndNothingBehind) {
  const Scene scene = three_things();
  EXPECT_EQ(pick(scene, {{0, 0, 2}, {1, 0, 0}})->object, ball) << "from inside";
  EXPECT_EQ(pick(scene, {{2.2, 0.2, -1}, {0, 0, 1}})->object, wall) << "from behind";
  EXPECT_FALSE(pick(scene, {{0, 0, 5}, {0, 0, 1}})) << "away from all";
}

TEST(Pick, DistanceIsInLengthsOfTheDirection) {
  EXPECT_DOUBLE_EQ(pick(three_things(), {{0, 0, 5}, {0, 0, -4}})->distance, 0.5);
}

// At a distance of 1e8 radii single precision would see no ball at all.
TEST(Pick, FarFromTheOrigin) {
  Scene scene = three_things();
  const glm::dvec3 far{3e8, -2e8, 1e8};
  scene.spheres[0].center += far;
  scene.polygons.clear();
  EXPECT_TRUE(pick(scene, {far + glm::dvec3(0.99, 0, 5), {0, 0, -1}}));
  EXPECT_FALSE(pick(scene, {far + glm::dvec3(1.01, 0, 5), {0, 0, -1}}));
}

TEST(Pick, ObjectsHaveNamesAndMaterials) {
  Scene scene = three_things();
  EXPECT_EQ(objects_of(scene), (std::vector{ball, wedge, wall}));
  EXPECT_EQ(name_of(scene, wedge), "wedge");
  material_name_of(scene, wall) = "brick";
  EXPECT_EQ(scene.polygons[0].material, "brick");
  EXPECT_TRUE(contains(scene, ball));
  EXPECT_FALSE(contains(scene, {ObjectKind::sphere, 1}));
}

// Directions and projection undo each other, whatever the camera.
TEST(CameraView, ProjectsBackWhatItLooksAt) {
  const Camera camera{.eye = {1, -2, 3}, .look_at = {4, 0.5, -6}, .up = {0.2, 1, 0}, .fov_y = 70};
  const ImageSize size{640, 360};
  const CameraView view(camera, size);
  const auto middle = view.project(camera.look_at);
  ASSERT_TRUE(middle);
  EXPECT_NEAR(middle->x, 320, 1e-9);
  EXPECT_NEAR(middle->y, 180, 1e-9);
  for (const glm::dvec2 place : {glm::dvec2(0, 0), glm::dvec2(639.5, 10), glm::dvec2(100, 359)}) {
    const auto back = view.project(view.eye + 7.0 * view.direction(place));
    ASSERT_TRUE(back);
    EXPECT_LT(glm::distance(*back, place), 1e-9);
  }
  // The upper and lower edge are half the field of view away from the middle.
  const double edge = std::acos(dot(normalize(view.direction({320, 0})), view.forward));
  EXPECT_NEAR(edge, glm::radians(35.0), 1e-12);
  EXPECT_GT(dot(view.direction({320, 0}), camera.up), dot(view.direction({320, 359}), camera.up)) << "y is down";
  EXPECT_FALSE(view.project(camera.eye - view.forward)) << "behind";
}

TEST(Pick, CutawayLooksThroughBacksThatAreNotGlass) {
  Scene scene = three_things();
  const WorldRay up{{2.2, 0.2, -5}, {0, 0, 1}}, from_ball{{0, 0, 2}, {0, 0, 1}};
  EXPECT_EQ(pick_seen(scene, up)->object, wall) << "from behind";
  scene.camera.cutaway = Cutaway::on;
  EXPECT_FALSE(pick_seen(scene, up)) << "wall and triangle look the other way";
  EXPECT_FALSE(pick_seen(scene, from_ball)) << "a ball's inside is its back";
  EXPECT_EQ(pick_seen(scene, down(2.2, 0.2))->object, wedge);
  EXPECT_EQ(pick_seen(scene, down(0, 0))->object, ball);
  scene.materials = {{.name = "", .type = "glass"}};
  EXPECT_EQ(pick_seen(scene, up)->object, wall);
  EXPECT_EQ(pick_seen(scene, from_ball)->object, ball);
}

}  // namespace
