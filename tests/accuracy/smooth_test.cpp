// Smooth shading of coarse meshes: no energy is lost or made, and all estimators agree.
#include <gtest/gtest.h>

#include "mesh_shapes.h"
#include "pictures.h"
#include "same_picture.h"

using namespace glimt;

namespace {

/// A coarse ball of radius 1.
Mesh smooth_ball(const std::string& material, const dvec3& centre, int rings = 5) {
  Mesh mesh = bumpy_ball("ball of " + material, material, centre, 1, rings);
  mesh.smooth = true;
  return mesh;
}

// Failure: edges of a smooth ball that are dark, or light that comes through it. All around it walls shine evenly with
// radiance 1, so a convex object sends back just what it reflects, from every point and in every direction: paths that
// meet it have that value without noise.
TEST(SmoothShading, KeepsAllEnergyInEvenLight) {
  for (const Material& material : {lambertian("ball", dvec3{0.5}), mirror("ball", dvec3{0.5})}) {
    Scene scene;
    scene.camera = {{0, 0, 3}, {0, 0, 0}, {0, 1, 0}, 30};
    scene.image = {64, 64};
    scene.render.roulette_depth = 64;
    scene.materials = {lambertian("walls", dvec3{0}, dvec3{1}), material};
    scene.polygons = box(dvec3{-4}, dvec3{4}, "walls");
    scene.meshes = {smooth_ball("ball", {0, 0, 0})};
    const CompiledScene compiled = compile(scene);
    ASSERT_TRUE(compiled.tree);
    int on_ball = 0;
    for (const float v : trace_all(compiled, 2 * effort, Lanes::native)) {
      ASSERT_TRUE(v == 1 || std::abs(v - 0.5f) < 1e-6f) << v << ", " << material.type;
      on_ball += v < 1 ? 1 : 0;
    }
    EXPECT_GT(on_ball, 1000);
  }
}

/// Smooth balls of every kind of lobe, in a room with a lamp.
Scene room_with_balls() {
  Scene scene;
  scene.name = "smooth balls";
  scene.camera = {{0, 0, 3.5}, {0, -0.5, -1}, {0, 1, 0}, 75};
  scene.image = {32, 24};
  scene.materials = {lambertian("white", dvec3{0.7}),
                     oren_nayar("clay", 0.5, {0.6, 0.4, 0.3}),
                     mirror("mirror", dvec3{0.9}),
                     glass("glass", 1.5),
                     Material{.name = "metal", .type = "conductor"}.with(Conductor::roughness, 0.4),
                     light("lamp", dvec3{10})};
  scene.polygons = box(dvec3{-4}, dvec3{4}, "white");
  scene.polygons.push_back(square_lamp(2, 3.8));
  scene.meshes = {smooth_ball("white", {-2.2, -2, -1}), smooth_ball("clay", {0, -2.5, 0}),
                  smooth_ball("metal", {2.2, -2, -1}), smooth_ball("mirror", {-1.2, 0.5, -2}),
                  smooth_ball("glass", {1.2, 0.5, -1})};
  return scene;
}

// Failure: a cosine or a density of the wrong normal. Lamps found by chance alone, by shadow rays, and by both. One run
// in 10,000 may fail by chance.
TEST(SmoothShading, EstimatorsAgree) {
  Scene scene = room_with_balls();
  scene.render.caustics = Caustics::off;
  scene.render.light_sampling = LightSampling::none;
  const Named chance{"chance", render_series(scene, 8, 64 * effort, 8)};
  const double level = sidak(1e-4, 2 * comparisons(chance.series));
  scene.render.light_sampling = LightSampling::area;
  expect_same(chance, {"area", render_series(scene, 8, 16 * effort, 8)}, level, scene.name);
  scene.render.mis = Mis::on;
  expect_same(chance, {"mis", render_series(scene, 8, 16 * effort, 8)}, level, scene.name);
}

// Failure: the same in light paths, which meet the balls the other way around. The caustics of the mirror, the glass
// and the metal fall on matt balls and walls.
TEST(SmoothShading, LightPathsAgree) {
  Scene scene = room_with_balls();
  scene.render.light_paths = 0;
  scene.render.sphere_connections = SphereConnections::off;
  const Named chance{"chance", render_series(scene, 8, 64 * effort, 8)};
  scene.render.light_paths = 1;
  expect_same(chance, {"light paths", render_series(scene, 8, 32 * effort, 8)}, sidak(1e-4, comparisons(chance.series)),
              scene.name);
}

}  // namespace
