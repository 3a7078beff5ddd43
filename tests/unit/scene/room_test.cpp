#include "scene/geometry/room.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "scene_parts.h"

using namespace glimt;

namespace {

std::vector<Face> faces_of(const std::vector<Polygon>& polygons) {
  std::vector<Face> faces;
  for (const Polygon& p : polygons) faces.push_back({p.vertices, 0});
  return faces;
}

constexpr double tolerance = 1e-5;

TEST(Planes, OfAPolygonLookToItsFront) {
  // Counter-clockwise seen from above.
  const std::vector<dvec3> square{{0, 2, 0}, {0, 2, 3}, {3, 2, 3}, {3, 2, 0}};
  const HalfSpace h = plane_of(square);
  EXPECT_NEAR(length(h.n - dvec3{0, 1, 0}), 0, 1e-15);
  EXPECT_NEAR(h.d, 2, 1e-15);
  EXPECT_NEAR(area_of(square), 9, 1e-14);
}

TEST(Planes, ClipKeepsWhatIsInTheHalfSpace) {
  const std::vector<dvec3> square{{0, 0, 0}, {2, 0, 0}, {2, 2, 0}, {0, 2, 0}};
  EXPECT_NEAR(area_of(clip(square, {{1, 0, 0}, 0.5})), 1, 1e-14);
  EXPECT_EQ(clip(square, {{1, 0, 0}, 3}), square);
  EXPECT_TRUE(clip(square, {{1, 0, 0}, -1}).empty());
  // The corner (2, 2) is cut off: a triangle of legs 1.
  EXPECT_NEAR(area_of(clip(square, {normalize(dvec3{1, 1, 0}), 3 / std::sqrt(2.0)})), 3.5, 1e-14);
}

TEST(Room, OfABoxHasItsSixSides) {
  const auto room = find_room(faces_of(box({-1, -2, -3}, {1, 2, 3}, "")), {0.5, 0.5, 0.5}, tolerance);
  ASSERT_EQ(room.size(), 6u);
  double area = 0;
  for (const RoomFace& face : room) {
    area += area_of(face.outline);
    EXPECT_TRUE(face.front);
    EXPECT_LT(dot(face.inside.n, dvec3{0.5, 0.5, 0.5}), face.inside.d) << "normals look out";
  }
  EXPECT_NEAR(area, 2 * (2 * 4 + 4 * 6 + 2 * 6), 1e-9);
}

TEST(Room, IsNoneFromOutsideOrWithASideMissing) {
  auto faces = faces_of(box({-1, -1, -1}, {1, 1, 1}, ""));
  EXPECT_TRUE(find_room(faces, {0, 0, 2}, tolerance).empty());
  for (std::size_t i = 0; i < 6; ++i) {
    auto open = faces;
    open.erase(open.begin() + static_cast<std::ptrdiff_t>(i));
    EXPECT_TRUE(find_room(open, {0, 0, 0}, tolerance).empty()) << "without side " << i;
  }
}

// A hole a hundred times the tolerance wide lets light out; two walls that meet within it do not.
TEST(Room, SidesMustBeCovered) {
  auto walls = box({-1, -1, -1}, {1, 1, 1}, "");
  walls[1].vertices[0].x += 1e-3, walls[1].vertices[3].x += 1e-3;
  EXPECT_TRUE(find_room(faces_of(walls), {0, 0, 0}, tolerance).empty());
  walls[1].vertices[0].x -= 1e-3 - 1e-7, walls[1].vertices[3].x -= 1e-3 - 1e-7;
  EXPECT_EQ(find_room(faces_of(walls), {0, 0, 0}, tolerance).size(), 6u);
}

TEST(Room, SideMayBeMadeOfPiecesOfOneMaterial) {
  auto faces = faces_of(box({-1, -1, -1}, {1, 1, 1}, ""));
  const Face ceiling = faces[1];
  // Three strips that overlap and reach beyond the walls.
  faces.erase(faces.begin() + 1);
  auto strip = [](double a, double b) { return Face{{{a, 1, -1}, {b, 1, -1.5}, {b, 1, 1}, {a, 1, 1}}, 0}; };
  faces.push_back(strip(-1, -0.3));
  faces.push_back(strip(-0.4, 0.5));
  EXPECT_TRUE(find_room(faces, {0, 0, 0}, tolerance).empty()) << "the third is missing";
  faces.push_back(strip(0.5, 2));
  EXPECT_EQ(find_room(faces, {0, 0, 0}, tolerance).size(), 6u);
  faces.back().material = 1;
  EXPECT_TRUE(find_room(faces, {0, 0, 0}, tolerance).empty()) << "of two materials";
  faces.back().material = 0;
  std::ranges::reverse(faces.back().vertices);
  EXPECT_TRUE(find_room(faces, {0, 0, 0}, tolerance).empty()) << "one strip turns its back";
}

TEST(Room, IsTheSmallestAroundTheEye) {
  auto faces = faces_of(box({-4, -4, -4}, {4, 4, 4}, ""));
  const auto small = faces_of(box({-1, -1, -1}, {1, 1, 1}, ""));
  faces.insert(faces.end(), small.begin(), small.end());
  const auto inner = find_room(faces, {0, 0, 0}, tolerance);
  ASSERT_EQ(inner.size(), 6u);
  for (const RoomFace& face : inner) EXPECT_NEAR(area_of(face.outline), 4, 1e-9);
  // From between the two, the space is not convex; the outer box is the room and the inner one stands in it.
  const auto outer = find_room(faces, {2, 2, 2}, tolerance);
  ASSERT_EQ(outer.size(), 6u);
  for (const RoomFace& face : outer) EXPECT_NEAR(area_of(face.outline), 64, 1e-9);
}

TEST(Room, PartitionWallBoundsItOnlyWhereItIsWhole) {
  auto faces = faces_of(box({-2, -1, -1}, {2, 1, 1}, ""));
  faces.push_back({{{0.5, -1, -1}, {0.5, 1, -1}, {0.5, 1, 1}, {0.5, -1, 1}}, 0});
  const auto half = find_room(faces, {0, 0, 0}, tolerance);
  ASSERT_EQ(half.size(), 6u);
  double area = 0;
  for (const RoomFace& face : half) area += area_of(face.outline);
  EXPECT_NEAR(area, 2 * (2.5 * 2 + 2.5 * 2 + 2 * 2), 1e-9);
  for (dvec3& v : faces.back().vertices) v.y = std::min(v.y, 0.9);  // light passes above it
  const auto whole = find_room(faces, {0, 0, 0}, tolerance);
  ASSERT_EQ(whole.size(), 6u);
  area = 0;
  for (const RoomFace& face : whole) area += area_of(face.outline);
  EXPECT_NEAR(area, 2 * (4 * 2 + 4 * 2 + 2 * 2), 1e-9);
}

TEST(Room, NeedNotBeParallelToAnything) {
  // A tetrahedron, turned; from its centre all four sides bound the room.
  Mesh mesh = tetrahedron("", "", {3, 4, 5}, 2);
  std::vector<Face> faces;
  for (const auto& t : mesh.triangles) {
    Face face;
    for (const int i : t) {
      const dvec3 v = mesh.vertices[static_cast<std::size_t>(i)];
      face.vertices.push_back({v.x * 0.8 - v.y * 0.6, v.x * 0.6 + v.y * 0.8, v.z});
    }
    faces.push_back(face);
  }
  const dvec3 centre{3 * 0.8 - 4 * 0.6, 3 * 0.6 + 4 * 0.8, 5};
  const auto room = find_room(faces, centre, tolerance);
  ASSERT_EQ(room.size(), 4u);
  for (const RoomFace& face : room) EXPECT_FALSE(face.front) << "fronts look out";
}

}  // namespace
