// Geometry as people have it: polygons that are not flat or not convex, triangles without area, corners repeated for
// each face. What is mended has the same area and volume, and is of a form that the compiler can lower.
#include "scene/geometry/mend.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <random>

#include "scene/geometry/convex_pieces.h"
#include "scene/geometry/mesh_measures.h"
#include "scene/geometry/room.h"
#include "scene/pick.h"
#include "unit/kernel/test_scenes.h"

namespace glimt {
namespace {

double area_of_pieces(const std::vector<std::vector<dvec3>>& pieces) {
  double area = 0;
  for (const auto& piece : pieces) area += area_of(piece);
  return area;
}

bool is_convex(const std::vector<dvec3>& v) {
  const HalfSpace plane = plane_of(v);
  for (std::size_t i = 0; i < v.size(); ++i) {
    if (std::abs(dot(plane.n, v[i]) - plane.d) > 1e-5) return false;
    const dvec3 edge = v[(i + 1) % v.size()] - v[i];
    for (const dvec3& p : v)
      if (dot(cross(plane.n, edge), p - v[i]) < -1e-5) return false;
  }
  return true;
}

/// In the plane z = 0, and turned so that no axis is special.
std::vector<dvec3> outline(const std::vector<std::array<double, 2>>& points) {
  std::vector<dvec3> v;
  const dvec3 u = normalize(dvec3{1, 0.3, -0.2}), w = normalize(cross(dvec3{0.1, -0.4, 1}, u));
  for (const auto& [x, y] : points) v.push_back(dvec3{3, -1, 2} + u * x + w * y);
  return v;
}

struct Shape {
  std::string name;
  std::vector<std::array<double, 2>> points;
  double area;          ///< by the shoelace formula
  std::size_t at_most;  ///< pieces
};

const std::vector<Shape> shapes{
    {"square", {{0, 0}, {2, 0}, {2, 2}, {0, 2}}, 4, 1},
    {"five corners, three on a line", {{0, 0}, {1, 0}, {2, 0}, {2, 1}, {0, 1}}, 2, 1},
    {"arrow", {{0, 0}, {2, 1}, {0, 2}, {0.5, 1}}, 1.5, 2},
    {"L", {{0, 0}, {3, 0}, {3, 1}, {1, 1}, {1, 3}, {0, 3}}, 5, 3},
    {"U", {{0, 0}, {3, 0}, {3, 3}, {2, 3}, {2, 1}, {1, 1}, {1, 3}, {0, 3}}, 7, 4},
    {"cross", {{1, 0}, {2, 0}, {2, 1}, {3, 1}, {3, 2}, {2, 2}, {2, 3}, {1, 3}, {1, 2}, {0, 2}, {0, 1}, {1, 1}}, 5, 5},
    {"comb",
     {{0, 0},
      {7, 0},
      {7, 3},
      {6, 3},
      {6, 1},
      {5, 1},
      {5, 3},
      {4, 3},
      {4, 1},
      {3, 1},
      {3, 3},
      {2, 3},
      {2, 1},
      {1, 1},
      {1, 3},
      {0, 3}},
     7 + 8,
     9},
    {"a frame, its hole reached by a cut",
     {{0, 0}, {3, 0}, {3, 3}, {0, 3}, {0, 0}, {1, 1}, {1, 2}, {2, 2}, {2, 1}, {1, 1}},
     8,
     7},
    {"a spike along an edge", {{0, 0}, {2, 0}, {1, 0}, {1, 1}}, 0.5, 1},
    {"a spike outwards", {{0, 0}, {1, 0}, {1, 1}, {1, 2}, {1, 1}, {0, 1}}, 1, 1},
    {"a corner twice", {{0, 0}, {2, 0}, {2, 0}, {2, 2}, {0, 2}}, 4, 1},
    {"the first corner again", {{0, 0}, {2, 0}, {2, 2}, {0, 2}, {0, 0}}, 4, 1}};

TEST(ConvexPieces, HaveTheAreaAndAreConvex) {
  for (const Shape& shape : shapes)
    for (const bool backwards : {false, true}) {
      SCOPED_TRACE(shape.name + (backwards ? ", backwards" : ""));
      std::vector<dvec3> v = outline(shape.points);
      if (backwards) std::ranges::reverse(v);
      const ConvexPieces cut = convex_pieces(v);
      EXPECT_EQ(cut.mistake, "");
      EXPECT_NEAR(area_of_pieces(cut.pieces), shape.area, 1e-12 * shape.area);
      EXPECT_LE(cut.pieces.size(), shape.at_most);
      for (const auto& piece : cut.pieces) {
        EXPECT_TRUE(is_convex(piece));
        EXPECT_GT(dot(plane_of(piece).n, plane_of(v).n), 0.999) << "the front stays the front";
      }
    }
}

TEST(ConvexPieces, WhatIsFlatAndConvexStaysAsItIs) {
  const std::vector<dvec3> v = outline(shapes[0].points);
  const ConvexPieces cut = convex_pieces(v);
  ASSERT_EQ(cut.pieces.size(), 1u);
  EXPECT_EQ(cut.pieces[0], v);
  EXPECT_FALSE(cut.bent);
}

// A quadrilateral of 2 m with a corner 1e-4 m off: two triangles, which keep the corners where they are.
TEST(ConvexPieces, BentOnesAreFlatInPieces) {
  const std::vector<dvec3> v{{-1, 0, -1}, {-1, 0, 1}, {1, 1e-4, 1}, {1, 0, -1}};
  const ConvexPieces cut = convex_pieces(v);
  EXPECT_TRUE(cut.bent);
  ASSERT_EQ(cut.pieces.size(), 2u);
  for (const auto& piece : cut.pieces) {
    EXPECT_EQ(piece.size(), 3u);
    for (const dvec3& p : piece) EXPECT_NE(std::ranges::find(v, p), v.end());
  }
}

// Star-shaped outlines of random radii: none crosses itself. The area is the sum of sin(angle) r r' / 2.
TEST(ConvexPieces, RandomOutlines) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> radius(0.2, 1);
  for (int trial = 0; trial < 300; ++trial) {
    const int corners = 3 + trial % 40;
    std::vector<std::array<double, 2>> points;
    std::vector<double> r;
    for (int i = 0; i < corners; ++i) {
      r.push_back(radius(random));
      const double angle = 2 * std::numbers::pi * i / corners;
      points.push_back({r.back() * std::cos(angle), r.back() * std::sin(angle)});
    }
    double area = 0;
    for (std::size_t i = 0; i < r.size(); ++i)
      area += std::sin(2 * std::numbers::pi / corners) * r[i] * r[(i + 1) % r.size()] / 2;
    const ConvexPieces cut = convex_pieces(outline(points));
    ASSERT_EQ(cut.mistake, "") << trial;
    EXPECT_NEAR(area_of_pieces(cut.pieces), area, 1e-12) << trial;
    EXPECT_LT(cut.pieces.size(), static_cast<std::size_t>(corners) - 1) << trial;
    for (const auto& piece : cut.pieces) EXPECT_TRUE(is_convex(piece)) << trial;
  }
}

TEST(Mend, PiecesKeepNameMaterialAndFlux) {
  const Scene scene = scene_of({}, {{"first", "white", outline(shapes[0].points)},
                                    {"L", "lamp", outline(shapes[3].points)},
                                    {"last", "white", outline(shapes[2].points)}});
  const Mended mended = mend(scene);
  double area = 0;
  for (const Polygon& p : mended.scene.polygons)
    if (p.name == "L") {
      EXPECT_EQ(p.material, "lamp");
      area += area_of(p.vertices);
    }
  EXPECT_NEAR(area, 5, 1e-12);
  ASSERT_EQ(mended.told.size(), 1u) << "one line a kind";
  EXPECT_TRUE(mended.told[0].starts_with("2 polygons are not flat")) << mended.told[0];
  EXPECT_TRUE(mended.told[0].ends_with("the first: polygon \"L\"")) << mended.told[0];
}

TEST(Mend, ASoundSceneStaysAsItIs) {
  Mesh open = cube({2, 0, 0}, 1);
  open.triangles.edit().pop_back();
  const Scene scene =
      scene_of({{"s", "white"}}, {{"p", "white", outline(shapes[0].points)}}, {cube({}, 1), open, ball(6, 8)});
  const Mended mended = mend(scene);
  EXPECT_EQ(mended.scene, scene);
  EXPECT_EQ(mended.told, std::vector<std::string>{});
}

/// Every triangle has corners of its own.
Mesh exploded(const Mesh& mesh, double noise = 0) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> off(-noise, noise);
  Mesh apart = mesh;
  auto& vertices = apart.vertices.edit();
  vertices.clear();
  for (auto& t : apart.triangles.edit())
    for (int& i : t) {
      vertices.push_back(mesh.vertices[static_cast<std::size_t>(i)] + dvec3{off(random), off(random), off(random)});
      i = static_cast<int>(vertices.size()) - 1;
    }
  return apart;
}

TEST(Mend, CornersThatAreRepeatedAreWelded) {
  for (const Mesh& mesh : {cube({}, 1), ball(8, 12), cube({1e4, 0, 0}, 1e-3), turned(cube({1, 2, 3}, 5), 0.3)}) {
    // A part in 1e7 of the size is what single precision leaves.
    const double size = length(mesh.vertices.back() - mesh.vertices.front());
    for (const double noise : {0.0, 1e-7 * size}) {
      const Mesh apart = exploded(mesh, noise);
      ASSERT_FALSE(is_closed(apart));
      const Mended mended = mend(scene_of({}, {}, {apart}));
      const Mesh& welded = mended.scene.meshes[0];
      EXPECT_TRUE(is_closed(welded));
      EXPECT_EQ(welded.vertices.size(), mesh.vertices.size());
      EXPECT_NEAR(signed_volume(welded), signed_volume(mesh), 1e-6 * std::abs(signed_volume(mesh)));
      ASSERT_EQ(mended.told.size(), 1u);
      EXPECT_TRUE(
          mended.told[0].starts_with(std::to_string(apart.vertices.size() - mesh.vertices.size()) + " vertices"))
          << mended.told[0];
      EXPECT_EQ(paths(scene_of({}, {}, {apart})), Paths{}) << "closed, so it may be of glass";
    }
  }
}

// Two cubes side by side with corners of their own are closed as they are. Welded, four triangles would share an edge.
TEST(Mend, PartsThatTouchStayApart) {
  const Mesh two = both(cube({}, 1), cube({1, 0, 0}, 1));
  EXPECT_EQ(mend(scene_of({}, {}, {two})).scene.meshes[0], two);
}

/// With its first triangle's longest edge cut at points along it, and the triangles of no area that close the gap.
Mesh with_needles(Mesh mesh, int needles) {
  const auto [a, b, c] = mesh.triangles[0];
  int from = a;
  std::vector<int> along{a};
  for (int i = 1; i <= needles; ++i) {
    const double t = static_cast<double>(i) / (needles + 1);
    const auto at = [&](int k) { return mesh.vertices[static_cast<std::size_t>(k)]; };
    mesh.vertices.edit().push_back(at(a) + (at(b) - at(a)) * t);
    along.push_back(static_cast<int>(mesh.vertices.size()) - 1);
  }
  along.push_back(b);
  mesh.triangles.edit().erase(mesh.triangles.begin());
  for (std::size_t i = 0; i + 1 < along.size(); ++i) mesh.triangles.edit().push_back({along[i], along[i + 1], c});
  // The fan of needles between the edge as it was and the points on it.
  for (std::size_t i = 1; i + 1 < along.size(); ++i) mesh.triangles.edit().push_back({along[i + 1], along[i], from});
  return mesh;
}

TEST(Mend, TrianglesWithoutAreaLeaveAClosedMeshClosed) {
  for (const Mesh& mesh : {cube({}, 1), ball(5, 7), turned(cube({1, 2, 3}, 5), 0.3)})
    for (int needles = 1; needles < 6; ++needles) {
      const Mesh needled = with_needles(mesh, needles);
      ASSERT_TRUE(is_closed(needled));
      const Mended mended = mend(scene_of({}, {}, {needled}));
      const Mesh& clean = mended.scene.meshes[0];
      EXPECT_TRUE(is_closed(clean)) << needles;
      EXPECT_NEAR(signed_volume(clean), signed_volume(mesh), 1e-12 * std::abs(signed_volume(mesh)));
      for (const auto& t : clean.triangles) {
        const std::vector<dvec3> v = triangle_vertices(clean, t);
        EXPECT_FALSE(has_no_area(v[0], v[1], v[2]));
      }
      ASSERT_EQ(mended.told.size(), 1u);
      EXPECT_TRUE(mended.told[0].starts_with(std::to_string(needles) + " triangle")) << mended.told[0];
      EXPECT_EQ(paths(scene_of({}, {}, {needled})), Paths{});
    }
}

TEST(Mend, TrianglesWithACornerTwiceOrThereTwiceGo) {
  Mesh mesh = cube({}, 1);
  mesh.triangles.edit().push_back({3, 3, 1});
  mesh.triangles.edit().insert(mesh.triangles.begin(), {2, 5, 2});
  auto again = mesh.triangles[4];
  std::ranges::rotate(again, again.begin() + 1);
  mesh.triangles.edit().push_back(again);
  const Mended mended = mend(scene_of({}, {}, {mesh}));
  EXPECT_TRUE(is_closed(mended.scene.meshes[0]));
  EXPECT_EQ(mended.scene.meshes[0].triangles.size(), 12u);
  EXPECT_EQ(mended.told.size(), 2u);
}

// A picker's ray meets an outline that is not convex where it is, and not in its bays.
TEST(Mend, ThePickerSeesTheShape) {
  const Scene scene = scene_of(
      {}, {{"U", "white", {{0, 0, 0}, {3, 0, 0}, {3, 3, 0}, {2, 3, 0}, {2, 1, 0}, {1, 1, 0}, {1, 3, 0}, {0, 3, 0}}}});
  const auto meets = [&](double x, double y, double side) {
    return pick(scene, {{x, y, side}, {0, 0, -side}}).has_value();
  };
  for (const double side : {5.0, -5.0}) {
    EXPECT_TRUE(meets(0.5, 2.5, side));
    EXPECT_TRUE(meets(2.5, 2.5, side));
    EXPECT_TRUE(meets(1.5, 0.5, side));
    EXPECT_FALSE(meets(1.5, 2.0, side));
    EXPECT_FALSE(meets(1.5, 3.5, side));
  }
}

}  // namespace
}  // namespace glimt
