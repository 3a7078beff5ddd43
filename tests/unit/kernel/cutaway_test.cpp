// A cutaway changes what the camera's own ray meets first, and nothing else. So a path from an eye outside the room has
// the value of the path, with the same random numbers, that begins where the ray comes out behind what is cut away.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "given_rays.h"
#include "pictures.h"
#include "scene/file/scene_file.h"

using namespace glimt;

namespace {

/// A box [-1, 1]^3 with a lamp, balls of mirror, glass and matt, and a tetrahedron.
Scene furnished_box() {
  Scene scene;
  scene.materials = {lambertian("white", dvec3{0.5}), lambertian("grey", dvec3{0.3}), light("lamp", {4, 5, 6}),
                     mirror("mirror", dvec3{0.9}), glass("glass", 1.5)};
  scene.polygons = box(dvec3{-1}, dvec3{1}, "white");
  scene.polygons.push_back(square_lamp(0.6, 0.9));
  scene.spheres = {{"mirror", "mirror", {-0.5, -0.6, -0.4}, 0.3},
                   {"glass", "glass", {0.5, -0.6, 0.4}, 0.3},
                   {"matt", "grey", {0.4, -0.2, -0.5}, 0.3}};
  scene.meshes = {tetrahedron("solid", "grey", {-0.4, 0.2, 0.4}, 0.3)};
  scene.camera = {.eye = {0, 0, 0.95}, .look_at = {0, 0, 0}};
  return scene;
}

Scene cut(Scene scene, const dvec3& eye) {
  scene.camera.look_at = scene.camera.look_at == eye ? eye + dvec3{1, 0, 0} : scene.camera.look_at;
  scene.camera.eye = eye;
  scene.camera.cutaway = Cutaway::on;
  return scene;
}

struct Comparison {
  int paths = 0, different = 0;
  double cut = 0, plain = 0;
};

/// Paths along the ray from `eye` in the cut scene, and from `begin` in the plain one.
void compare(Comparison& all, const CompiledScene& cut, const dvec3& eye, const CompiledScene& plain,
             const dvec3& begin, const dvec3& w) {
  for (int sample = 0; sample < 4; ++sample) {
    const double a = trace_green(cut, eye, w, all.paths, sample), b = trace_green(plain, begin, w, all.paths, sample);
    all.cut += a;
    all.plain += b;
    if (std::abs(a - b) > 1e-3 * (a + b)) ++all.different;
  }
  all.paths += 4;
}

/// Rounding sends a few paths another way at the edge of something.
void expect_same(const Comparison& c) {
  EXPECT_LT(c.different, 0.02 * c.paths);
  EXPECT_NEAR(c.cut, c.plain, 0.02 * c.plain);
  EXPECT_GT(c.plain, 0);
}

dvec3 random_in_box(std::mt19937& random, double half) {
  std::uniform_real_distribution<double> u(-half, half);
  const double x = u(random), y = u(random);
  return {x, y, u(random)};
}

TEST(Cutaway, RaysFromOutsideBeginBehindTheWall) {
  const Scene scene = furnished_box();
  const CompiledScene plain = compile(scene);
  std::mt19937 random(1);
  Comparison c;
  for (int i = 0; i < 500; ++i) {
    const dvec3 target = random_in_box(random, 0.95);
    dvec3 eye = random_in_box(random, 4);
    // Not from above: from behind the ceiling the lamp's back is seen, which is cut away too.
    while (std::max({std::abs(eye.x), std::abs(eye.y), std::abs(eye.z)}) < 1.1 || eye.y > 1)
      eye = random_in_box(random, 4);
    const dvec3 w = normalize(target - eye);
    double entry = 0;
    for (int axis = 0; axis < 3; ++axis)
      if (std::abs(eye[axis]) > 1) entry = std::max(entry, (std::abs(eye[axis]) - 1) / std::abs(w[axis]));
    compare(c, compile(cut(scene, eye)), eye, plain, eye + w * (entry + 1e-6), w);
  }
  expect_same(c);
}

TEST(Cutaway, RaysPastTheRoomMeetNothing) {
  const CompiledScene c = compile(cut(furnished_box(), {0, 0, 5}));
  for (const dvec3& w : {dvec3{0, 0, 1}, normalize(dvec3{1, 0, -1}), dvec3{0, 1, 0}})
    EXPECT_EQ(trace_green(c, {0, 0, 5}, w, 0, 0), 0);
}

// The walls' fronts look outwards, or the room is one mesh, or a sphere: what is seen is the inside.
TEST(Cutaway, AnyClosedRoomIsSeenFromInside) {
  Scene scene = furnished_box();
  const dvec3 eye{0, 0, 5}, w{0, 0, -1};
  for (Polygon& p : scene.polygons)
    if (p.material == "white") std::ranges::reverse(p.vertices);
  EXPECT_GT(trace_green(compile(cut(scene, eye)), eye, w, 0, 0), 0);
  std::erase_if(scene.polygons, [](const Polygon& p) { return p.material == "white"; });
  Scene with_mesh = scene, with_sphere = scene;
  for (const bool inwards : {false, true}) {
    with_mesh.meshes = {box_mesh(dvec3{-1}, dvec3{1}, "white", inwards)};
    EXPECT_GT(trace_green(compile(cut(with_mesh, eye)), eye, w, 0, 0), 0);
    EXPECT_TRUE(compile(cut(with_mesh, eye)).cutaway);
  }
  with_sphere.spheres.push_back({"room", "white", {0, 0, 0}, 2});
  EXPECT_GT(trace_green(compile(cut(with_sphere, eye)), eye, w, 0, 0), 0);
  EXPECT_EQ(trace_green(compile(cut(with_sphere, eye)), eye, {0, 1, 0}, 0, 0), 0);
}

// A panel in the way, of which the camera sees the back or the front, from inside the room and from outside.
TEST(Cutaway, BacksAreLookedThroughAndFrontsAreNot) {
  Scene scene = furnished_box();
  const double z = 0.85, behind = 0.8;
  scene.polygons.push_back({"panel", "grey", {{-0.9, -0.9, z}, {0.9, -0.9, z}, {0.9, 0.9, z}, {-0.9, 0.9, z}}});
  Mesh two{"pair", "grey", {{-0.9, -0.9, behind}, {0.9, -0.9, behind}, {0.9, 0.9, behind}, {-0.9, 0.9, behind}}, {}};
  two.triangles = {{0, 1, 2}, {0, 2, 3}};
  scene.meshes.push_back(two);
  for (const bool back : {true, false}) {
    if (back) {
      std::ranges::reverse(scene.polygons.back().vertices);
      for (auto& t : scene.meshes.back().triangles.edit()) std::swap(t[0], t[1]);
    } else {
      std::ranges::reverse(scene.polygons.back().vertices);
    }
    const CompiledScene plain = compile(scene);
    std::mt19937 random(2);
    for (const double from : {0.95, 3.0}) {
      const CompiledScene with_cut = compile(cut(scene, {0, 0, from}));
      Comparison c;
      for (int i = 0; i < 200; ++i) {
        const dvec3 eye{0, 0, from}, way = normalize(random_in_box(random, 0.8) * dvec3{1, 1, 0} - eye);
        const double depth = from - (back ? behind - 1e-6 : z + 1e-6);
        compare(c, with_cut, eye, plain, eye + way * (depth / -way.z), way);
      }
      expect_same(c);
    }
  }
}

TEST(Cutaway, EyeInASolidOrBallLooksThroughIt) {
  const Scene scene = furnished_box();
  const CompiledScene plain = compile(scene);
  std::mt19937 random(3);
  Comparison c;
  for (int i = 0; i < 200; ++i) {
    const Sphere& ball = scene.spheres[2];
    const dvec3 w = normalize(random_in_box(random, 1) + dvec3{1e-3, 0, 0});
    compare(c, compile(cut(scene, ball.center)), ball.center, plain, ball.center + w * (ball.radius + 1e-6), w);
    // The tetrahedron's corners are 0.3 away, and a ray from its centre leaves it before that.
    const dvec3 centre{-0.4, 0.2, 0.4};
    double leave = 1e9;
    for (const dvec3& corner : scene.meshes[0].vertices)
      if (const double along = dot(centre - corner, w); along > 0) leave = std::min(leave, 0.3 * 0.1 / along);
    compare(c, compile(cut(scene, centre)), centre, plain, centre + w * (leave + 1e-6), w);
  }
  expect_same(c);
}

// Nothing turns its back to a camera in this room, so there is nothing to cut away.
TEST(Cutaway, WithoutBacksThePictureIsTheSameBitForBit) {
  Scene scene = read_scene(GLIMT_SCENES "/report.toml");
  scene.image = {40, 30};
  scene.render.light_paths = 0;
  const auto plain = trace_all(compile(scene), 4, Lanes::native);
  scene.camera.cutaway = Cutaway::on;
  EXPECT_EQ(first_difference(plain, trace_all(compile(scene), 4, Lanes::native)), -1);
}

TEST(Cutaway, LeavesNoHalfOfTheCausticsOut) {
  Scene scene = read_scene(GLIMT_SCENES "/report.toml");
  EXPECT_GT(compile(scene).light_paths, 0);
  scene.camera.cutaway = Cutaway::on;
  EXPECT_EQ(compile(scene).light_paths, 0) << "all of them are left to chance";
}

}  // namespace
