#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "scene/geometry/mesh_measures.h"
#include "scene/validate/validate.h"
#include "unit/kernel/test_scenes.h"

namespace glimt {
namespace {

bool allowed(const Mesh& a, const Mesh& b) {
  const Paths one = paths(scene_of({}, {}, {a, b})), other = paths(scene_of({}, {}, {b, a}));
  EXPECT_EQ(one, other) << "the order of the meshes matters";
  EXPECT_TRUE(one.empty() || one == Paths{"mesh[1]"});
  // Neither the orientation nor the place and size of the whole matters.
  EXPECT_EQ(one, paths(scene_of({}, {}, {flipped(a), b})));
  const dvec3 away{1e3, -2e3, 5e2};
  EXPECT_EQ(one, paths(scene_of({}, {}, {moved(a, away), moved(b, away)})));
  EXPECT_EQ(one, paths(scene_of({}, {}, {moved(turned(a, 0.7), {}, 1e-3), moved(turned(b, 0.7), {}, 1e-3)})));
  return one.empty();
}

bool allowed(const Sphere& sphere, const Mesh& mesh) { return paths(scene_of({sphere}, {}, {mesh})).empty(); }

bool allowed(const Sphere& a, const Sphere& b) { return paths(scene_of({a, b})).empty(); }

Sphere sphere_at(const dvec3& center, double radius) { return {"", "glass", center, radius}; }

TEST(ValidateGlass, Spheres) {
  EXPECT_TRUE(allowed(sphere_at({0, 0, 0}, 1), sphere_at({3, 0, 0}, 1))) << "apart";
  EXPECT_TRUE(allowed(sphere_at({0, 0, 0}, 0.1), sphere_at({0.3, 0, 0}, 0.2)))
      << "touching; 0.1 + 0.2 is not 0.3 in doubles";
  EXPECT_TRUE(allowed(sphere_at({0, 0, 0}, 1), sphere_at({0.2, 0, 0}, 0.5))) << "nested";
  EXPECT_TRUE(allowed(sphere_at({0.5, 0, 0}, 0.5), sphere_at({0, 0, 0}, 1))) << "nested and touching";
  EXPECT_FALSE(allowed(sphere_at({0, 0, 0}, 1), sphere_at({1.999, 0, 0}, 1)));
  EXPECT_FALSE(allowed(sphere_at({0, 0, 0}, 1), sphere_at({0.501, 0, 0}, 0.5)));
  EXPECT_FALSE(allowed(sphere_at({1, 2, 3}, 1), sphere_at({1, 2, 3}, 1))) << "coincident";
}

TEST(ValidateGlass, OtherMaterialsMayOverlap) {
  EXPECT_EQ(paths(scene_of({sphere_at({0, 0, 0}, 1), {"", "white", {1, 0, 0}, 1}})), Paths{});
}

TEST(ValidateGlass, SphereAndMesh) {
  const Mesh box = cube({-1, -1, -1}, 2);
  EXPECT_TRUE(allowed(sphere_at({3, 0, 0}, 1.5), box)) << "apart";
  EXPECT_TRUE(allowed(sphere_at({2, 0.3, 0.1}, 1), box)) << "touching a face";
  EXPECT_TRUE(allowed(sphere_at({0, 0, 0}, 0.9), box)) << "the sphere within the mesh";
  EXPECT_TRUE(allowed(sphere_at({0, 0, 0}, 1), box)) << "inscribed";
  EXPECT_TRUE(allowed(sphere_at({0, 0, 0}, std::sqrt(3.0)), box)) << "circumscribed";
  EXPECT_TRUE(allowed(sphere_at({0.1, 0, 0}, 2), box)) << "the mesh within the sphere";
  EXPECT_FALSE(allowed(sphere_at({0, 0, 0}, 1.01), box)) << "faces bulge, no corner inside";
  EXPECT_FALSE(allowed(sphere_at({1.9, 0.3, 0.1}, 1), box)) << "through a face";
  EXPECT_FALSE(allowed(sphere_at({1.2, 1.2, 0}, 0.3), box)) << "through an edge";
  EXPECT_TRUE(allowed(sphere_at({1.2, 1.2, 0}, 0.28), box)) << "0.2 sqrt(2) = 0.283 from the edge";
  EXPECT_FALSE(allowed(sphere_at({1.1, 1.1, 1.1}, 0.2), box)) << "through a corner";
  EXPECT_FALSE(allowed(sphere_at({1, 1, 1}, 1), box));
  EXPECT_FALSE(allowed(sphere_at({0, 0, 0}, 1.7), box)) << "only the corners stick out";
}

TEST(ValidateGlass, Cubes) {
  const Mesh unit = cube({0, 0, 0}, 1);
  EXPECT_TRUE(allowed(unit, cube({2, 0, 0}, 1))) << "apart";
  EXPECT_TRUE(allowed(unit, cube({1, 0, 0}, 1))) << "sharing a face";
  EXPECT_TRUE(allowed(unit, cube({1, 0.3, 0.2}, 1))) << "touching in part of a face";
  EXPECT_TRUE(allowed(unit, cube({1, 1, 0}, 1))) << "sharing an edge";
  EXPECT_TRUE(allowed(unit, cube({1, 1, 1}, 1))) << "sharing a corner";
  EXPECT_TRUE(allowed(unit, cube({0.2, 0.3, 0.4}, 0.3))) << "nested";
  EXPECT_TRUE(allowed(unit, cube({0, 0, 0}, 0.5))) << "nested in a corner";
  EXPECT_TRUE(allowed(unit, cube({0.25, 0.25, 0}, 0.5))) << "nested on a face";
  EXPECT_TRUE(allowed(unit, cuboid({0, 0, 0}, {0.5, 1, 1}))) << "the half of it";
  EXPECT_FALSE(allowed(unit, cube({0.5, 0.4, 0.3}, 1))) << "corner in corner";
  EXPECT_FALSE(allowed(unit, cube({0.5, 0, 0}, 1))) << "shifted along an edge: all crossings are along edges and faces";
  EXPECT_FALSE(allowed(unit, cube({0.5, 0.5, 0}, 1)));
  EXPECT_FALSE(allowed(unit, cube({-0.5, -0.5, -0.5}, 1)));
  EXPECT_FALSE(allowed(unit, unit)) << "coincident";
  EXPECT_FALSE(allowed(unit, cuboid({0.25, 0.25, -1}, {0.75, 0.75, 2})))
      << "a bar through opposite faces, no corner inside";
  EXPECT_FALSE(allowed(unit, cuboid({0.25, 0.25, 0}, {0.75, 0.75, 2}))) << "the bar from a face on";
  EXPECT_TRUE(allowed(unit, cuboid({-1, 0, 0}, {2, 1, 1}))) << "a bar as wide as the cube holds it";
  EXPECT_FALSE(allowed(unit, cuboid({-1, 0, 0}, {2, 1, 0.5})));
  EXPECT_FALSE(allowed(cuboid({-1, 0, 0}, {2, 1, 1}), cuboid({0, -1, 0}, {1, 2, 1}))) << "a cross of flat bars";
  EXPECT_FALSE(allowed(cube({-1, -1, -1}, 2), turned(cube({-1, -1, -1}, 2), std::numbers::pi / 4)));
}

TEST(ValidateGlass, HollowMeshes) {
  const Mesh shell = both(cube({-2, -2, -2}, 4), flipped(cube({-1, -1, -1}, 2)));
  EXPECT_TRUE(allowed(shell, cube({-0.5, -0.5, -0.5}, 1))) << "in the cavity";
  EXPECT_TRUE(allowed(shell, cube({-1, -1, -1}, 2))) << "filling the cavity";
  EXPECT_TRUE(allowed(shell, cube({-1.9, -1.9, -1.9}, 0.5))) << "in the wall";
  EXPECT_TRUE(allowed(shell, cube({-3, -3, -3}, 6))) << "the shell within it";
  EXPECT_FALSE(allowed(shell, cube({-1.5, -1.5, -1.5}, 3))) << "the cavity within it, it within the shell";
  EXPECT_FALSE(allowed(shell, cube({0, 0, 0}, 1.5)));
}

TEST(ValidateGlass, MeshesInParts) {
  const Mesh parts = both(cube({0.2, 0.2, 0.2}, 0.2), cube({5, 5, 5}, 1));
  EXPECT_FALSE(allowed(parts, cube({0, 0, 0}, 1))) << "one part inside, one outside";
  EXPECT_TRUE(allowed(parts, cube({0, 0, 0}, 10)));
  EXPECT_TRUE(allowed(parts, cube({2, 2, 2}, 1)));
}

TEST(ValidateGlass, BallsOfManyTriangles) {
  const Mesh fine = ball(32, 32), coarse = ball(12, 17);
  ASSERT_TRUE(is_closed(fine));
  EXPECT_TRUE(allowed(fine, moved(fine, {}, 0.98))) << "nested shells";
  EXPECT_TRUE(allowed(fine, moved(fine, {0, 2, 0}))) << "pole to pole";
  EXPECT_FALSE(allowed(fine, moved(fine, {0, 1.99, 0})));
  EXPECT_FALSE(allowed(fine, moved(fine, {0.5, 0.4, 0.3})));
  EXPECT_FALSE(allowed(fine, coarse)) << "one's corners stick out of the other's faces";
  EXPECT_TRUE(allowed(sphere_at({0, 0, 0}, 1), fine)) << "corners on the sphere";
  EXPECT_TRUE(allowed(sphere_at({0, 0, 0}, 0.99), fine));
  EXPECT_FALSE(allowed(sphere_at({0, 0, 0}, 0.9999), fine));
}

/// For convex solids that are moved at random, whether some point is common to both can be asked of many points.
TEST(ValidateGlass, RandomBoxesAgreeWithCountingPoints) {
  std::uint32_t state = 1;
  const auto random = [&](int n) {
    state = state * 1664525u + 1013904223u;
    return static_cast<int>((state >> 16) % static_cast<std::uint32_t>(n));
  };
  int overlapping = 0;
  for (int i = 0; i < 400; ++i) {
    // Boxes on a grid of 5, so that faces, edges and corners often coincide. Half-way points of the cells decide
    // exactly.
    std::array<std::array<int, 3>, 2> low{}, high{};
    for (std::size_t b = 0; b < 2; ++b)
      for (std::size_t k = 0; k < 3; ++k) low[b][k] = random(4), high[b][k] = low[b][k] + 1 + random(5 - low[b][k]);
    int in_both = 0, in_first = 0, in_second = 0;
    for (int x = 0; x < 9; ++x)
      for (int y = 0; y < 9; ++y)
        for (int z = 0; z < 9; ++z) {
          const std::array cell{x, y, z};
          const auto in = [&](std::size_t b) {
            for (std::size_t k = 0; k < 3; ++k)
              if (cell[k] < low[b][k] || cell[k] >= high[b][k]) return false;
            return true;
          };
          in_both += in(0) && in(1), in_first += in(0), in_second += in(1);
        }
    const bool coincide = in_both == in_first && in_both == in_second;
    const bool expected = in_both == 0 || (!coincide && (in_both == in_first || in_both == in_second));
    const auto box = [&](std::size_t b) {
      return turned(cuboid(dvec3(low[b][0], low[b][1], low[b][2]), dvec3(high[b][0], high[b][1], high[b][2])), 0.3);
    };
    EXPECT_EQ(allowed(box(0), box(1)), expected) << "case " << i;
    overlapping += !expected;
  }
  EXPECT_GT(overlapping, 100);
  EXPECT_LT(overlapping, 300);
}

}  // namespace
}  // namespace glimt
