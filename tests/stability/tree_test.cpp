// Rays through the tree of triangles: what they meet, that none passes between two triangles, and pictures of scenes
// that have one.
#include <gtest/gtest.h>

#include <limits>

#include "compile/build_tree.h"
#include "kernel/geometry/tree_walk.h"
#include "mesh_shapes.h"
#include "pictures.h"
#include "random_scene.h"
#include "same_picture.h"

using namespace glimt;

namespace {

constexpr float infinite = std::numeric_limits<float>::infinity();

TreePart part_of(const Mesh& mesh) { return {mesh.vertices, mesh.triangles, {}, false, false}; }

std::array<float, 3> floats(const dvec3& v) {
  return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)};
}

dvec3 doubles(const std::array<float, 3>& v) { return {v[0], v[1], v[2]}; }

class Random {
 public:
  explicit Random(unsigned seed) : random_(seed) {}

  double number(double low, double high) { return std::uniform_real_distribution(low, high)(random_); }
  dvec3 place(double reach) {
    const double x = number(-reach, reach), y = number(-reach, reach);
    return {x, y, number(-reach, reach)};
  }
  dvec3 direction() {
    for (;;)
      if (const dvec3 v = place(1); dot(v, v) < 1 && dot(v, v) > 0.01) return normalize(v);
  }
  std::size_t index(std::size_t count) { return std::uniform_int_distribution<std::size_t>(0, count - 1)(random_); }

 private:
  std::mt19937 random_;
};

/// Triangles of all sizes that cross each other, a closed mesh and a flat grid.
std::vector<TreePart> random_parts(unsigned seed) {
  Random random(seed);
  Mesh loose;
  std::vector<dvec3> vertices;
  std::vector<std::array<int, 3>> triangles;
  for (int i = 0; i < 200; ++i) {
    const dvec3 p = random.place(3);
    const double size = std::exp2(random.number(-8, 1));
    for (int k = 0; k < 3; ++k) vertices.push_back(p + size * random.place(1));
    triangles.push_back({3 * i, 3 * i + 1, 3 * i + 2});
  }
  loose.vertices = std::move(vertices), loose.triangles = std::move(triangles);
  Mesh grid{"", "", {{-4, -2, -4}, {4, -2, -4}, {4, -2, 4}, {-4, -2, 4}}, {{0, 1, 2}, {0, 2, 3}}};
  return {part_of(loose), part_of(bumpy_ball("", "", random.place(2), 1, 12, 0.3)), part_of(subdivided(grid, 3))};
}

/// Of one triangle, in double precision; infinite where the ray clearly misses it, NaN where that is in doubt.
double distance_to(const std::array<dvec3, 3>& v, const dvec3& origin, const dvec3& direction) {
  constexpr double doubt = 1e-5;
  const dvec3 e1 = v[1] - v[0], e2 = v[2] - v[0], p = cross(direction, e2), s = origin - v[0], q = cross(s, e1);
  const double determinant = dot(e1, p), u = dot(s, p) / determinant, w = dot(direction, q) / determinant,
               t = dot(e2, q) / determinant;
  const double least = std::min({u, w, 1 - u - w});
  if (std::abs(determinant) < doubt * length(e1) * length(e2)) return std::numeric_limits<double>::quiet_NaN();
  if (least < -doubt || t < -doubt) return std::numeric_limits<double>::infinity();
  return least < doubt || t < doubt ? std::numeric_limits<double>::quiet_NaN() : t;
}

// Failure: a triangle that the walk passes by, or one behind another. Rays from anywhere, along axes and towards
// corners too, against all triangles in double precision; a hit that rounding may decide either way is left out.
TEST(Tree, RaysMeetWhatTheListHas) {
  int compared = 0, doubtful = 0;
  for (unsigned seed = 0; seed < 50; ++seed) {
    const std::vector<TreePart> parts = random_parts(seed);
    const auto tree = tree_of(parts, dvec3{0});
    std::vector<std::array<dvec3, 3>> list;
    std::vector<std::pair<int, int>> number;
    for (std::size_t k = 0; k < parts.size(); ++k)
      for (std::size_t i = 0; i < parts[k].triangles.size(); ++i) {
        std::array<dvec3, 3> corners;
        for (std::size_t c = 0; c < 3; ++c)
          corners[c] = doubles(floats(parts[k].vertices[static_cast<std::size_t>(parts[k].triangles[i][c])]));
        list.push_back(corners);
        number.emplace_back(static_cast<int>(k), static_cast<int>(i));
      }
    ASSERT_EQ(tree->triangles, list.size());
    Random random(seed + 1000);
    for (int i = 0; i < 100 * effort; ++i) {
      TreeRay ray{floats(random.place(4)), floats(random.direction()), -1};
      if (i % 8 == 0) ray.direction = {0, i % 16 == 0 ? 1.0f : -1.0f, 0};
      const dvec3 origin = doubles(ray.origin), direction = doubles(ray.direction);
      double nearest = std::numeric_limits<double>::infinity();
      std::size_t first = 0;
      bool doubt = false;
      for (std::size_t k = 0; k < list.size(); ++k) {
        const double t = distance_to(list[k], origin, direction);
        doubt = doubt || std::isnan(t);
        if (std::abs(t - nearest) < 1e-5) doubt = true;
        if (t < nearest) nearest = t, first = k;
      }
      if (doubt) {
        ++doubtful;
        continue;
      }
      ++compared;
      const TreeHit hit = first_in_tree(*tree, ray, infinite);
      const std::string where = "scene " + std::to_string(seed) + ", ray " + std::to_string(i);
      ASSERT_EQ(hit.place < 0, nearest == std::numeric_limits<double>::infinity()) << where;
      if (hit.place < 0) continue;
      const auto place = static_cast<std::size_t>(hit.place);
      ASSERT_EQ(std::pair(tree->part[place], tree->triangle[place]), number[first]) << where;
      ASSERT_NEAR(static_cast<double>(hit.t), nearest, 2e-5) << where;
      // Any hit, up to a little beyond and up to a little before.
      ASSERT_TRUE(hidden_in_tree(*tree, ray, hit.t * 1.001f, 0, -1)) << where;
      ASSERT_FALSE(hidden_in_tree(*tree, ray, hit.t * 0.999f, 0, -1)) << where;
      // Without the triangle that is met first, by either way to leave it out.
      ray.from = hit.place;
      ASSERT_NE(first_in_tree(*tree, ray, infinite).place, hit.place) << where;
      ASSERT_FALSE(hidden_in_tree(*tree, ray, hit.t * 1.000001f, 0, -1)) << where;
      ray.from = -1;
      ASSERT_FALSE(hidden_in_tree(*tree, ray, hit.t * 1.000001f, hit.place, hit.place)) << where;
    }
  }
  EXPECT_GT(compared, 20 * doubtful / 10);
}

/// Rays from inside a closed mesh. Half of them aim at points of edges or at corners, where two and more triangles
/// meet.
void expect_none_escapes(const Mesh& mesh, const dvec3& inside, double reach, int rays, unsigned seed) {
  const auto tree = tree_of({part_of(mesh)}, dvec3{0});
#pragma omp parallel
  {
#pragma omp for
    for (int block = 0; block < 64; ++block) {
      Random random(64 * seed + static_cast<unsigned>(block));
      for (int i = 0; i < rays / 64; ++i) {
        const dvec3 origin = inside + random.place(reach);
        dvec3 direction = random.direction();
        if (i % 2 == 1) {
          const auto& t = mesh.triangles[random.index(mesh.triangles.size())];
          const auto corner = [&](std::size_t c) { return mesh.vertices[static_cast<std::size_t>(t[c])]; };
          const double along = i % 4 == 1 ? 0 : random.number(0, 1);
          direction = normalize(corner(0) * (1 - along) + corner(1) * along - origin);
        }
        const TreeRay ray{floats(origin), floats(direction), -1};
        const bool met = first_in_tree(*tree, ray, infinite).place >= 0;
        if (!met || !hidden_in_tree(*tree, ray, infinite, 0, -1)) {
          const auto number = [](float x) { return std::to_string(x); };
#pragma omp critical
          ADD_FAILURE() << "escaped: seed " << seed << ", block " << block << ", ray " << i << ", from "
                        << number(ray.origin[0]) << ' ' << number(ray.origin[1]) << ' ' << number(ray.origin[2]);
          break;
        }
      }
    }
  }
}

struct Closed {
  const char* name;
  Mesh mesh;
  dvec3 inside;
  double reach;  ///< about `inside`, where all is inside
};

std::vector<Closed> closed_meshes() {
  return {{"tetrahedron", tetrahedron("", "", {0, 0, 0}, 1), {0, 0, 0}, 0.1},
          {"dented", dented("", "", {0, 0, 0}, 1), {0.05, 0.05, 0.05}, 0.01},
          {"bumpy ball", bumpy_ball("", "", {0, 0, 0}, 1, 40, 0.3), {0, 0, 0}, 0.3},
          {"smooth ball", bumpy_ball("", "", {3, 2, 1}, 1, 300), {3, 2, 1}, 0.5},
          {"ball far away", bumpy_ball("", "", {1000, -300, 10}, 1, 100), {1000, -300, 10}, 0.5},
          {"tiny ball", bumpy_ball("", "", {0, 0, 0}, 1e-6, 60), {0, 0, 0}, 3e-7}};
}

// Failure: a ray that slips through between two triangles, at an edge or a corner, or past a box.
TEST(Tree, NoRayLeavesAClosedMesh) {
  for (const Closed& c : closed_meshes()) {
    SCOPED_TRACE(c.name);
    expect_none_escapes(c.mesh, c.inside, c.reach, 25000 * effort, 1);
  }
}

TEST(TreeLong, NoneOfAHundredMillionRaysLeavesAClosedMesh) {
  for (const Closed& c : closed_meshes()) {
    SCOPED_TRACE(c.name);
    expect_none_escapes(c.mesh, c.inside, c.reach, 17'000'000, 2);
  }
}

/// A room with a lamp, and meshes of about that many triangles.
Scene room_with_meshes(int rings, int cuts) {
  Scene scene;
  scene.name = "room with meshes";
  scene.camera = {{0, 0, 3.5}, {0, -0.5, -1}, {0, 1, 0}, 70};
  scene.image = {32, 24};
  scene.materials = {lambertian("white", dvec3{0.7}), oren_nayar("clay", 0.5, {0.6, 0.4, 0.3}),
                     mirror("mirror", dvec3{0.9}),    glass("glass", 1.5),
                     light("lamp", dvec3{10}),        lambertian("red", {0.7, 0.2, 0.2})};
  scene.polygons = box(dvec3{-4}, dvec3{4}, "white");
  scene.polygons.push_back(square_lamp(2, 3.8));
  scene.meshes = {bumpy_ball("clay ball", "clay", {-2, -2.5, -1}, 1.2, rings, 0.3),
                  bumpy_ball("glass ball", "glass", {1.5, -2.2, 0.5}, 1, rings, 0.2),
                  subdivided(dented("mirror", "mirror", {0, 0, -2.5}, 1), cuts),
                  subdivided(tetrahedron("red", "red", {2.5, 0.5, -2}, 1), cuts)};
  return scene;
}

// Failure: a picture that depends on how the work is spread, in scenes with a tree, with lamps in it and smooth
// triangles.
TEST(TreePictures, AreTheSameForAllThreadsAndLanes) {
  for (const bool smooth : {false, true})
    for (const Mis mis : {Mis::off, Mis::on}) {
      Scene scene = room_with_meshes(16, 2);
      scene.render.mis = mis;
      for (Mesh& mesh : scene.meshes) mesh.smooth = smooth;
      scene.meshes.push_back(bumpy_ball("bulb", "lamp", {-1.5, 1, 0}, 0.2, 8));
      const CompiledScene compiled = compile(scene);
      ASSERT_TRUE(compiled.tree);
      ASSERT_FALSE(compiled.tree_lamps.empty());
      const Film one = render(compiled, 4, {.threads = 1});
      for (const Execution& spread : {Execution{.threads = 3}, Execution{.threads = 2, .lanes = Lanes::scalar}}) {
        const Film other = render(compiled, 4, spread);
        for (int pixel = 0; pixel < one.width() * one.height(); ++pixel)
          for (const int half : {0, 1})
            ASSERT_EQ(one.half_sum(pixel, half), other.half_sum(pixel, half)) << "pixel " << pixel;
      }
    }
}

// Failure: an edit that waits for a tree to be built anew though no triangle has moved.
TEST(TreePictures, EditsOfOtherThingsKeepTheTree) {
  Scene scene = room_with_meshes(16, 2);
  scene.polygons.erase(scene.polygons.begin());  // no room, so that the scene's middle depends on all objects
  scene.spheres.push_back({"ball", "white", {2, -3, 2}, 0.5});
  const auto tree = compile(scene).tree;
  ASSERT_TRUE(tree);
  scene.materials[1].set(Reflecting::reflectance, {0.1, 0.2, 0.3});
  EXPECT_EQ(compile(scene).tree, tree);
  scene.camera.eye.x += 0.5;
  EXPECT_EQ(compile(scene).tree, tree);
  scene.spheres[0].center = {3.5, -3.8, 3.8};  // out of the box around the rest
  EXPECT_EQ(compile(scene).tree, tree);
  scene.meshes[0].vertices.edit()[0].x += 0.5;
  EXPECT_NE(compile(scene).tree, tree);
}

// Failure: a ray that starts on a triangle beside an edge and comes out of the mesh, or meets the neighbour from
// behind. Everything in a closed mesh is white and glows with 1, so that a path of 16 rays that stays inside sums up
// exactly 16: 131,072 paths of each. Inside balls of a million triangles one path in a million escapes, where it
// starts within a rounding error of an edge.
TEST(TreePictures, PathsStayInAClosedMesh) {
  for (const double bumps : {0.0, 0.3})
    for (const bool smooth : {false, true}) {
      Scene scene;
      scene.camera = {{0, 0, 0}, {0, 0, -1}, {0, 1, 0}, 90};
      scene.image = {64, 64};
      scene.render.roulette_depth = 64;
      scene.render.max_depth = 16;
      scene.render.path_sharing = PathSharing::off;
      scene.materials = {lambertian("white", dvec3{1}, dvec3{1})};
      scene.meshes = {bumpy_ball("ball", "white", {0, 0, 0}, 1, 20, bumps)};
      scene.meshes[0].smooth = smooth;
      const CompiledScene compiled = compile(scene);
      ASSERT_TRUE(compiled.tree);
      for (const float v : trace_all(compiled, 4 * effort, Lanes::native))
        ASSERT_EQ(v, 16) << bumps << (smooth ? ", smooth" : ", flat");
    }
}

// Failure: light that is lost or made where triangles are in a tree. The same scene of few triangles in lists and in a
// tree, and with each of them cut in 64, so that the lamp, which is a mesh too, is in the tree. One comparison in
// 10,000 runs may fail by chance.
TEST(TreePictures, AreTheListsPictures) {
  Scene few = room_with_meshes(2, 0);
  few.polygons.pop_back();
  few.meshes.push_back(tetrahedron("lamp", "lamp", {0, 2.5, 0}, 0.8));
  Scene many = few;
  for (Mesh& mesh : many.meshes) mesh = subdivided(mesh, 3);
  ASSERT_FALSE(compile(few).tree);
  ASSERT_TRUE(compile(many).tree);
  ASSERT_FALSE(compile(many).tree_lamps.empty());
  const Named list{"list", render_series(few, 8, 16 * effort, 8)}, tree{"tree", render_series(many, 8, 16 * effort, 8)};
  const double level = sidak(1e-4, 2 * comparisons(list.series));
  expect_same(list, tree, level, "many triangles");
  Series few_in_tree;
  for (int seed = 1; seed <= 8; ++seed) {
    few.render.seed = 1000 * seed + 8;
    const CompiledScene compiled = compile(few, 0);
    ASSERT_TRUE(compiled.tree);
    few_in_tree.blocks.push_back(block_means(render(compiled, 16 * effort).mean(), 8));
  }
  expect_same(list, {"tree", few_in_tree}, level, "few triangles");
}

}  // namespace
