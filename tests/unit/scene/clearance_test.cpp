#include "scene/clearance.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <random>

#include "scene/pick.h"
#include "scene/surroundings.h"
#include "scene_parts.h"

using namespace glimt;

namespace {

constexpr double margin = 0.05;

Scene empty_box() {
  Scene scene;
  scene.materials = {lambertian("white", dvec3{0.5}), glass("glass", 1.5), light("lamp", dvec3{1})};
  scene.polygons = box(dvec3{-1}, dvec3{1}, "white");
  return scene;
}

// A triangle with corners (0,0), (1,0), (0,1) at z = 0: nearest are its face, an edge or a corner.
TEST(Clearance, IsTheDistanceToTheNearestFaceEdgeCornerOrSphere) {
  Scene scene;
  scene.meshes = {{"m", "", {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}}};
  EXPECT_DOUBLE_EQ(clearance(scene, {0.25, 0.25, -2}), 2) << "face";
  EXPECT_DOUBLE_EQ(clearance(scene, {0.5, -3, 4}), 5) << "edge y = 0";
  EXPECT_DOUBLE_EQ(clearance(scene, {-3, 0.5, 4}), 5) << "edge x = 0";
  EXPECT_DOUBLE_EQ(clearance(scene, {1, 1, 0}), std::sqrt(0.5)) << "edge x + y = 1";
  EXPECT_DOUBLE_EQ(clearance(scene, {-3, -4, 0}), 5) << "corner (0, 0)";
  EXPECT_DOUBLE_EQ(clearance(scene, {5, -3, 0}), 5) << "corner (1, 0)";
  EXPECT_DOUBLE_EQ(clearance(scene, {-3, 5, 0}), 5) << "corner (0, 1)";
  scene.spheres = {{"s", "", {0, 0, 10}, 2}};
  EXPECT_DOUBLE_EQ(clearance(scene, {0, 0, 9}), 1) << "inside a sphere";
  EXPECT_DOUBLE_EQ(clearance(scene, {0, 0, 15}), 3);
  EXPECT_TRUE(std::isinf(clearance(Scene{}, {})));
}

TEST(Slide, FreeWaysEndWhereTheyShould) {
  const dvec3 to{0.3, -0.7, 0.8};
  EXPECT_EQ(slide(empty_box(), {-0.9, 0, 0}, to, margin), to);
  EXPECT_EQ(slide(empty_box(), to, to, margin), to);
}

TEST(Slide, StopsShortOfAWallAndGoesOnAlongIt) {
  const dvec3 ahead = slide(empty_box(), {0, 0, 0}, {7, 0, 0}, margin);
  EXPECT_NEAR(ahead.x, 1 - margin, 1e-3 * margin);
  EXPECT_LT(std::hypot(ahead.y, ahead.z), 1e-9);
  // Nearest to the goal (5, 0.5) in what is left of the room is (1 - margin, 0.5); beyond a corner, the corner.
  const dvec3 along = slide(empty_box(), {0, 0, 0}, {5, 0.5, 0}, margin);
  EXPECT_NEAR(along.x, 1 - margin, 0.01 * margin);
  EXPECT_NEAR(along.y, 0.5, 0.1);
  const dvec3 corner = slide(empty_box(), {0, 0, 0}, {5, 4, 0}, margin);
  EXPECT_NEAR(corner.x, 1 - margin, 0.01 * margin);
  EXPECT_NEAR(corner.y, 1 - margin, 0.01 * margin);
}

TEST(Slide, GoesRoundASphere) {
  Scene scene = empty_box();
  scene.spheres = {{"ball", "white", {0, 0, 0}, 0.3}};
  const dvec3 to{0.8, 0.1, 0};
  const dvec3 end = slide(scene, {-0.8, 0.1, 0}, to, margin);
  EXPECT_EQ(end, to) << "the ball is off the way, so its sides lead past it";
}

// 1000 ways of up to 20 times the box's width, with balls and a wedge in it. Were a surface crossed, the point would be
// outside the box, or in a ball.
TEST(Slide, CrossesNothingHoweverLongTheWay) {
  Scene scene = empty_box();
  scene.spheres = {{"a", "white", {0.4, -0.5, 0.2}, 0.4}, {"b", "white", {-0.5, 0.3, -0.4}, 0.3}};
  scene.meshes = {tetrahedron("t", "white", {-0.4, -0.5, 0.5}, 0.4)};
  std::mt19937 random(1);
  std::uniform_real_distribution<double> coordinate(-20, 20);
  dvec3 p{0, 0.8, 0};
  for (int i = 0; i < 1000; ++i) {
    const dvec3 to{coordinate(random), coordinate(random), coordinate(random)};
    const dvec3 was = p;
    p = slide(scene, p, i % 2 == 0 ? to : p + to * 0.02, margin);
    ASSERT_GE(clearance(scene, p), margin * (1 - 1e-9)) << "way " << i;
    for (int axis = 0; axis < 3; ++axis) ASSERT_LT(std::abs(p[axis]), 1) << "way " << i << " from " << was.x;
    for (const Sphere& s : scene.spheres) ASSERT_GT(length(p - s.center), s.radius) << "way " << i;
  }
}

TEST(Slide, FromTooNearMovesOffFirst) {
  const dvec3 end = slide(empty_box(), {0.99, 0, 0}, {0.99, 0.5, 0}, margin);
  EXPECT_NEAR(end.x, 1 - margin, 0.01 * margin);
  EXPECT_NEAR(end.y, 0.5, margin);
  // In a gap narrower than two margins it keeps the distance it has.
  Scene narrow;
  narrow.materials = {lambertian("white", dvec3{0.5})};
  narrow.polygons = box({-1, -0.02, -1}, {1, 0.02, 1}, "white");
  const dvec3 through = slide(narrow, {0, 0, 0}, {0.5, 0, 0}, margin);
  EXPECT_NEAR(through.x, 0.5, 1e-9);
}

TEST(Surroundings, BoxIsClosedUntilAWallIsMissing) {
  Scene scene = empty_box();
  EXPECT_DOUBLE_EQ(size_of(scene), std::sqrt(12.0));
  EXPECT_TRUE(is_enclosed(scene, {0.5, 0.9, -0.3}));
  EXPECT_FALSE(is_enclosed(scene, {0.5, 1.1, -0.3}));
  scene.spheres = {{"ball", "glass", {0, 0, 0}, 0.5}};
  EXPECT_TRUE(is_enclosed(scene, {0, 0, 0})) << "glass is looked through";
  scene.polygons.erase(scene.polygons.begin());
  EXPECT_FALSE(is_enclosed(scene, {0, 0, 0}));
  EXPECT_FALSE(is_enclosed(scene, {0.5, 0.9, -0.3}));
}

TEST(Surroundings, PlaceInTheRoomIsBeforeALamp) {
  Scene scene = empty_box();
  const dvec3 outside{0, 0, 9};
  const auto unlit = place_in_room(scene, outside);
  ASSERT_TRUE(unlit) << "without a lamp, the middle";
  EXPECT_LT(length(*unlit), 1e-9);
  scene.polygons.push_back(square_lamp(0.5, 0.9));
  const auto place = place_in_room(scene, outside);
  ASSERT_TRUE(place);
  EXPECT_LT(length(*place - dvec3(0, -0.05, 0)), 1e-6) << "between lamp (y = 0.9) and floor (y = -1)";
  scene.polygons.erase(scene.polygons.begin());
  EXPECT_FALSE(place_in_room(scene, outside));
}

TEST(Surroundings, OfTwoRoomsTheNearer) {
  Scene scene = empty_box();
  scene.polygons.push_back(square_lamp(0.5, 0.9));
  for (const Polygon& p : std::vector(scene.polygons)) {
    scene.polygons.push_back(p);
    for (dvec3& v : scene.polygons.back().vertices) v.x += 10;
  }
  for (const double x : {0.0, 10.0}) EXPECT_NEAR(place_in_room(scene, {x, 0, 9})->x, x, 1e-6);
}

}  // namespace
