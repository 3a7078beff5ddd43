#include <gtest/gtest.h>

#include "pictures.h"
#include "scene/file/scene_file.h"
#include "scene_parts.h"

using namespace glimt;

// Scenes whose every pixel is known. The probability of a false alarm is alpha for each picture.
namespace {

constexpr double alpha = 1e-4;

/// Every block of 4x4 pixels and the mean of all have that radiance, by t-tests over independent pictures.
void expect_uniform(const Scene& scene, const dvec3& radiance, int samples) {
  const Series series = render_series(scene, 8, samples, 4);
  const double level = sidak(alpha, static_cast<double>(series.size()) + 3);
  for (std::size_t i = 0; i < series.size(); ++i) {
    const Estimate e = series.block(i);
    ASSERT_GT(likelihood(e, radiance[static_cast<int>(i % 3)]), level)
        << scene.name << ": block " << i / 3 << ", channel " << i % 3 << " is " << e.mean << " +- " << e.error;
  }
  for (std::size_t c = 0; c < 3; ++c) {
    std::vector<double> means;
    for (const auto& blocks : series.blocks) {
      means.push_back(0);
      for (std::size_t i = c; i < blocks.size(); i += 3)
        means.back() += 3 * blocks[i] / static_cast<double>(blocks.size());
    }
    const Estimate e = estimate(means);
    EXPECT_GT(likelihood(e, radiance[static_cast<int>(c)]), level)
        << scene.name << ": channel " << c << " is " << e.mean << " +- " << e.error;
  }
}

// The derivation is in the file: E / (1 - rho) is (1, 2, 4).
TEST(Furnace, EveryPixelHasItsExactRadiance) {
  Scene scene = read_scene(GLIMT_SCENES "/furnace.toml");
  scene.image = {80, 80};
  for (const Sampler sampler :
       {Sampler::independent, Sampler::stratified, Sampler::lattice, Sampler::sobol, Sampler::centres})
    for (const Roulette roulette : {Roulette::throughput, Roulette::constant}) {
      scene.name = "sampler " + std::to_string(static_cast<int>(sampler)) + ", roulette " +
                   std::to_string(static_cast<int>(roulette));
      scene.render.sampler = sampler;
      scene.render.roulette = roulette;
      expect_uniform(scene, {1, 2, 4}, 2 * effort);
    }
}

// By the same argument a Lambertian sphere of the walls' material cannot be seen.
TEST(Furnace, SphereOfTheWallsMaterialCannotBeSeen) {
  Scene scene = read_scene(GLIMT_SCENES "/furnace.toml");
  scene.image = {80, 80};
  scene.spheres = {{"ball", "wall", {-0.5, 0.2, -1}, 0.8}};
  expect_uniform(scene, {1, 2, 4}, 4 * effort);
}

/// A closed box that glows with E = (0.25, 1, 3) and reflects nothing, so that every ray that reaches it ends with E.
Scene glowing_box() {
  Scene scene;
  scene.materials = {lambertian("wall", dvec3{0}, {0.25, 1, 3})};
  scene.polygons = box({-2, -1.5, -3}, {2, 1.5, 3}, "wall");
  scene.camera = {{0.3, 0.1, 2.5}, {0, 0, 0}, {0, 1, 0}, 50};
  scene.image = {48, 48};
  return scene;
}

/// Every sample of every path, as a multiple of E: roulette apart, not only their mean is known.
void expect_each_sample(Scene scene, double multiple, double allowed) {
  scene.render.roulette_depth = 64;  // of the paths left then, too few to be seen go on
  const CompiledScene compiled = compile(scene);
  const auto rgb = trace_all(compiled, 2 * effort, Lanes::native);
  for (std::size_t i = 0; i < rgb.size(); ++i) {
    const double wanted = multiple * std::array{0.25, 1.0, 3.0}[i % 3];
    ASSERT_NEAR(rgb[i], wanted, allowed * wanted)
        << scene.name << ", " << replay(compiled, static_cast<std::ptrdiff_t>(i));
  }
}

TEST(GlowingBox, IsSeenAsItGlows) { expect_each_sample(glowing_box(), 1, 0); }

// Reflection or refraction is chosen by Fresnel and both keep all light. What refraction into the glass divides by n^2,
// refraction out of it multiplies by n^2 again: a camera outside sees E.
TEST(GlowingBox, GlassOutsideTheCameraCannotBeSeen) {
  for (const Fresnel fresnel : {Fresnel::exact, Fresnel::schlick}) {
    Scene scene = glowing_box();
    scene.materials.push_back(glass("glass", 1.5, fresnel));
    scene.spheres = {{"ball", "glass", {0, 0, 0}, 0.9}};
    scene.name = "glass sphere";
    expect_each_sample(scene, 1, 1e-5);
  }
}

// Total reflection holds some paths for long in spheres within spheres and in solids with corners. Roulette ends them,
// so here means are known.
TEST(GlowingBox, NestedGlassCannotBeSeen) {
  for (const Fresnel fresnel : {Fresnel::exact, Fresnel::schlick}) {
    Scene scene = glowing_box();
    scene.materials.push_back(glass("glass", 1.5, fresnel));
    scene.materials.push_back(glass("heavy", 2.4, fresnel));
    scene.materials.push_back(glass("bubble", 1, fresnel));
    scene.spheres = {{"ball", "glass", {0, 0, 0}, 0.9},
                     {"in it", "heavy", {0.1, 0.2, 0}, 0.5},
                     {"air in that", "bubble", {0.1, 0.2, 0}, 0.25}};
    expect_uniform(scene, {0.25, 1, 3}, 4 * effort);
  }
}

TEST(GlowingBox, GlassSolidsCannotBeSeen) {
  Scene scene = glowing_box();
  scene.materials.push_back(glass("glass", 1.5));
  scene.meshes = {tetrahedron("convex", "glass", {-0.7, 0, 0}, 0.8), dented("not convex", "glass", {0.8, 0, 0}, 0.8)};
  expect_uniform(scene, {0.25, 1, 3}, 4 * effort);
}

TEST(GlowingBox, PerfectMirrorsCannotBeSeen) {
  Scene scene = glowing_box();
  scene.materials.push_back(mirror("mirror", dvec3{1}));
  scene.spheres = {{"a", "mirror", {-0.6, 0, 0}, 0.5}, {"b", "mirror", {0.6, 0, 0}, 0.5}};
  scene.meshes = {tetrahedron("c", "mirror", {0, 0.9, 0}, 0.4)};
  scene.name = "mirrors";
  expect_each_sample(scene, 1, 1e-5);
}

// What its single bounce loses, EON reflects again and again: with reflectance 1 it keeps all light.
TEST(GlowingBox, WhiteEonSphereCannotBeSeen) {
  for (const double roughness : {0.0, 0.4, 1.0}) {
    Scene scene = glowing_box();
    scene.materials.push_back(eon("white", roughness, dvec3{1}));
    scene.spheres = {{"ball", "white", {0, 0, 0}, 0.9}};
    scene.name = "EON of roughness " + std::to_string(roughness);
    expect_uniform(scene, {0.25, 1, 3}, 16 * effort);
  }
}

// Radiance over the square of the index is the same along a ray through surfaces that keep all light (the fundamental
// theorem of radiometry): in glass of index n, what is E outside is n^2 E. The camera is in the middle of a sphere, so
// that all its rays leave at normal incidence, or are reflected back through the middle.
TEST(GlowingBox, CameraInGlassSeesTheSquareOfItsIndex) {
  for (const double n : {0.75, 1.33, 1.5, 2.0}) {
    Scene scene = glowing_box();
    scene.materials.push_back(glass("glass", n));
    scene.spheres = {{"ball", "glass", {0.3, 0.1, 2}, 0.8}};
    scene.camera.eye = {0.3, 0.1, 2.3};
    scene.name = "in glass of index " + std::to_string(n);
    expect_each_sample(scene, n * n, 1e-5);
  }
}

// A sphere around the camera and the room, seen from inside.
TEST(GlowingBox, MayBeASphere) {
  Scene scene = glowing_box();
  scene.polygons.clear();
  scene.materials.push_back(mirror("mirror", dvec3{1}));
  scene.spheres = {{"sky", "wall", {0, 0, 0}, 20}, {"ball", "mirror", {0, 0, 0}, 1}};
  expect_each_sample(scene, 1, 1e-5);
}

}  // namespace
