// Caustics by light paths and by chance are one picture. The probability of a false alarm is alpha for each test.
#include <gtest/gtest.h>

#include "film/statistics.h"
#include "same_picture.h"
#include "scene/file/scene_file.h"
#include "scene_parts.h"
#include "stability/samples.h"

using namespace glimt;

namespace {

constexpr double alpha = 1e-4;
constexpr double pi = std::numbers::pi;

/// A white box, 4 m wide and 2 m high, with a square lamp of that edge 5 cm under its ceiling.
Scene room_with_lamp(const std::string& name, double edge) {
  Scene scene;
  scene.name = name;
  scene.materials = {lambertian("white", {0.7, 0.6, 0.5}), light("lamp", dvec3{4 / (edge * edge)}), glass("glass", 1.5),
                     mirror("mirror", {0.9, 0.8, 0.9})};
  scene.polygons = box({-2, -1, -2}, {2, 1, 2}, "white");
  scene.polygons.push_back(square_lamp(edge, 0.95));
  scene.camera = {{0, 0, 1.9}, {0, -0.3, 0}, {0, 1, 0}, 75};
  scene.image = {32, 32};
  return scene;
}

Scene with_ball(const std::string& name, double edge, const std::string& material) {
  Scene scene = room_with_lamp(name, edge);
  scene.spheres = {{"ball", material, {0.1, -0.4, 0}, 0.5}};
  return scene;
}

std::vector<Scene> scenes() {
  std::vector<Scene> all;
  for (const char* file : {"hexagon", "cornell"}) {
    all.push_back(read_scene(GLIMT_SCENES "/" + std::string(file) + ".toml"));
    all.back().name = file;
    all.back().image = {32, 32};
  }
  all.push_back(with_ball("glass under the lamp", 1, "glass"));
  all.push_back(with_ball("mirror only", 1, "mirror"));
  all.push_back(with_ball("a small lamp", 0.2, "glass"));
  all.push_back(with_ball("a lamp as large as the ceiling", 4, "glass"));

  all.push_back(room_with_lamp("three balls in a row", 0.7));
  for (const auto& [ior, x] : {std::pair{1.05, -1.2}, {1.5, 0.0}, {2.4, 1.2}}) {
    const std::string material = "glass " + std::to_string(ior);
    all.back().materials.push_back(glass(material, ior));
    all.back().spheres.push_back({material, material, {x, -0.5, -0.3}, 0.45});
  }

  all.push_back(with_ball("nested glass", 1, "glass"));
  all.back().materials.push_back(glass("air", 1));
  all.back().materials.push_back(glass("dense", 2, Fresnel::schlick));
  all.back().spheres.push_back({"bubble", "air", {0.1, -0.4, 0}, 0.3});
  all.back().spheres.push_back({"core", "dense", {0.1, -0.4, 0}, 0.15});

  // Diffuse things in the same glass as the camera are seen straight, the others through its surface.
  all.push_back(with_ball("camera in glass", 1, "glass"));
  all.back().spheres = {{"around", "glass", {0, 0, 1}, 0.9}, {"clay", "white", {0.2, -0.1, 0.8}, 0.3}};

  all.push_back(with_ball("two lamps", 0.6, "glass"));
  all.back().materials.push_back(light("panel", {3, 1, 2}));
  all.back().polygons.push_back({"panel", "panel", {{1.9, -1, -1}, {1.9, -1, 0}, {1.9, 0.2, 0}, {1.9, 0.2, -1}}});
  std::ranges::reverse(all.back().polygons.back().vertices);
  all.back().spheres.push_back({"second", "mirror", {1, -0.7, 0.5}, 0.3});

  all.push_back(with_ball("a bulb, and one in glass", 0.5, "mirror"));
  all.back().materials.push_back(light("bulb", {8, 6, 4}));
  all.back().spheres.push_back({"bulb", "bulb", {-1.2, 0.2, -0.6}, 0.25});
  all.back().spheres.push_back({"cover", "glass", {1.2, 0.3, -0.6}, 0.35});
  all.back().spheres.push_back({"filament", "bulb", {1.2, 0.3, -0.6}, 0.2});

  for (const char* material : {"mirror", "glass"}) {
    all.push_back(room_with_lamp(std::string("tetrahedron of ") + material, 1));
    all.back().meshes = {tetrahedron("block", material, {0, -0.5, 0}, 0.7)};
  }
  all.push_back(with_ball("a mirror for a wall, rough and EON around it", 0.8, "glass"));
  all.back().polygons[0].material = "clay";
  all.back().polygons[2].material = "mirror";
  all.back().polygons[3].material = "eon";
  all.back().materials.push_back(oren_nayar("clay", 0.8, {0.6, 0.6, 0.7}));
  all.back().materials.push_back(eon("eon", 1, {0.8, 0.6, 0.5}));

  // Paths must not begin on the part of a lamp that is behind the wall, nor in a block.
  all.push_back(with_ball("a lamp that reaches out of the room and into a block", 1, "glass"));
  all.back().polygons.back().vertices = {{-1, 0.3, 1}, {-1, 0.3, -1}, {-1, 1.8, -1}, {-1, 1.8, 1}};
  all.back().meshes = {box_mesh({-1.5, 0.1, 0.2}, {-0.8, 0.6, 0.7}, "white", false)};
  return all;
}

/// Pictures by those settings; `first_seed` is their own, so that no two series share random numbers.
Series pictures(Scene scene, const std::vector<Caustics>& parts, double light_paths, int samples, int first_seed) {
  Series series;
  for (int seed = first_seed; seed < first_seed + 16; ++seed) {
    std::vector<double> sum;
    for (const Caustics part : parts) {
      scene.render.seed = seed + 1000 * static_cast<int>(part);
      scene.render.caustics = part;
      scene.render.light_paths = light_paths;
      const std::vector<double> means = block_means(render(compile(scene), samples).mean(), 8);
      sum.resize(means.size());
      for (std::size_t i = 0; i < means.size(); ++i) sum[i] += means[i];
    }
    series.blocks.push_back(std::move(sum));
  }
  return series;
}

class LightPaths : public testing::TestWithParam<Scene> {};

TEST_P(LightPaths, AndChanceMakeOnePicture) {
  Scene scene = GetParam();
  scene.render.sampler = Sampler::independent;
  const int samples = 10 * effort;
  // What chance finds of a small lamp is so rare that means of few paths are far from normal.
  const int chance = scene.name == "a small lamp" ? 8 : 2;
  std::vector<Named> all{
      {"chance", pictures(scene, {Caustics::on}, 0, chance * samples, 10001)},
      {"light paths", pictures(scene, {Caustics::on}, 0.2, samples, 20001)},
      {"few light paths", pictures(scene, {Caustics::on}, 0.02, samples, 30001)},
      {"off + only, by light paths", pictures(scene, {Caustics::off, Caustics::only}, 0.2, samples, 40001)},
      {"off + only, by chance", pictures(scene, {Caustics::off, Caustics::only}, 0, chance * samples, 50001)}};
  scene.render.sampler = Sampler::lattice;
  all.push_back({"lattice", pictures(scene, {Caustics::on}, 0.2, samples, 60001)});
  scene.render.max_depth = 4;
  const std::size_t whole = all.size();
  all.push_back({"depth 4, chance", pictures(scene, {Caustics::on}, 0, chance * samples, 70001)});
  all.push_back({"depth 4, light paths", pictures(scene, {Caustics::on}, 0.2, samples, 80001)});

  const auto n = static_cast<double>(whole);
  const double level = sidak(alpha, (n * (n - 1) / 2 + 1) * comparisons(all[0].series));
  for (std::size_t i = 0; i < all.size(); ++i)
    for (std::size_t k = 0; k < i; ++k) {
      if ((i < whole) == (k < whole)) expect_same(all[i], all[k], level, scene.name);
    }
}

INSTANTIATE_TEST_SUITE_P(Scenes, LightPaths, testing::ValuesIn(every_third(scenes())),
                         [](const auto& scene) { return case_name(scene.param); });
INSTANTIATE_TEST_SUITE_P(MoreScenesLong, LightPaths, testing::ValuesIn(every_third(scenes(), true)),
                         [](const auto& scene) { return case_name(scene.param); });

// A scene without mirrors or glass has nothing to aim at: not a bit of its picture depends on the setting.
TEST(LightPaths, AreNoneWithoutMirrorsAndGlass) {
  Scene scene = room_with_lamp("white", 1);
  scene.render.light_paths = 4;
  const CompiledScene with = compile(scene);
  EXPECT_EQ(with.light_paths, 0);
  scene.render.light_paths = 0;
  EXPECT_EQ(render(with, 2).mean().rgb, render(compile(scene), 2).mean().rgb);
}

/// Where a ray of a small lamp goes: lamp, sphere of radius 1 and wall are centred on the x axis.
struct AxisRay {
  double height;   ///< on the wall, metres; negative past the focus
  double through;  ///< share of the light that Fresnel lets in and out again
};

/// By Snell's law in the plane; sines and cosines of the angles against the axis.
AxisRay through_sphere(double angle, double lamp_x, double ior, double wall_x) {
  const double sin_i = -lamp_x * std::sin(angle), theta_i = std::asin(sin_i), theta_t = std::asin(sin_i / ior);
  const double chord = pi - 2 * theta_t;                 // seen from the centre
  const double leaves = pi - (theta_i - angle) - chord;  // polar angle of the point of exit
  const double slope = angle - 2 * (theta_i - theta_t);  // deviated twice
  const double through = 1 - fresnel_exact(std::cos(theta_i), ior);
  return {std::sin(leaves) + (wall_x - std::cos(leaves)) * std::tan(slope), through * through};
}

// Irradiance around the axis, past the focus of a sphere, where it is smooth: what a lamp of radiant intensity I cos^2
// (angle; lamp and wall face each other) sends into d(angle) falls on the ring that the ray map says.
TEST(LightPaths, BrightenTheAxisBehindASphereAsTheRayMapSays) {
  constexpr double lamp_x = -4, wall_x = 3, edge = 2e-3, ior = 1.5;
  Scene scene;
  scene.materials = {lambertian("wall", dvec3{0.5}), glass("glass", ior), light("lamp", dvec3{1 / (edge * edge)})};
  scene.spheres = {{"ball", "glass", {0, 0, 0}, 1}};
  scene.polygons = {{"wall", "wall", {{wall_x, -3, -3}, {wall_x, -3, 3}, {wall_x, 3, 3}, {wall_x, 3, -3}}}};
  const double h = edge / 2;
  scene.polygons.push_back({"lamp", "lamp", {{lamp_x, -h, -h}, {lamp_x, h, -h}, {lamp_x, h, h}, {lamp_x, -h, h}}});
  const dvec3 eye{wall_x - 1.5, 0, 3};
  scene.camera = {eye, {wall_x, 0, 0}, {0, 1, 0}, 4};
  scene.image = {48, 48};
  // What the lamp sends is not reflected twice: the wall is flat, and the ball sends light back to it by reflection
  // alone, which depth 4 (ball, ball, wall, lamp) leaves out with all else.
  scene.render.max_depth = 4;

  struct Ring {
    double radius, irradiance;
  };
  std::vector<Ring> rings;
  constexpr double step = 1e-5;
  for (double angle = step / 2; angle < 0.15; angle += step) {
    const double inner = through_sphere(angle - step / 2, lamp_x, ior, wall_x).height;
    const double outer = through_sphere(angle + step / 2, lamp_x, ior, wall_x).height;
    const double area = pi * std::abs(outer * outer - inner * inner);
    const double flux = std::cos(angle) * 2 * pi * std::sin(angle) * step;
    rings.push_back({std::abs(through_sphere(angle, lamp_x, ior, wall_x).height),
                     flux * through_sphere(angle, lamp_x, ior, wall_x).through / area});
  }
  ASSERT_TRUE(std::ranges::is_sorted(rings, {}, &Ring::radius));
  const auto radiance = [&](double radius) {
    const auto next = std::ranges::lower_bound(rings, radius, {}, &Ring::radius);
    return next == rings.end() ? NAN : next->irradiance * 0.5 / pi;
  };

  double wanted = 0;
  constexpr int fine = 480;
  const dvec3 forward = normalize(dvec3{wall_x, 0, 0} - eye), right = normalize(cross(forward, scene.camera.up));
  const double size = 2 * std::tan(2 * pi / 180) / fine;
  for (int y = 0; y < fine; ++y)
    for (int x = 0; x < fine; ++x) {
      const dvec3 way =
          forward + right * ((x + 0.5 - fine / 2) * size) + dvec3{0, 1, 0} * ((y + 0.5 - fine / 2) * size);
      const dvec3 point = eye + way * ((wall_x - eye.x) / way.x);
      wanted += radiance(std::hypot(point.y, point.z)) / (fine * fine);
    }

  std::vector<double> means;
  for (int seed = 1; seed <= 16; ++seed) {
    scene.render.seed = seed;
    means.push_back(mean(render(compile(scene), 64 * effort).mean()));
  }
  const Estimate measured = estimate(means);
  EXPECT_GT(likelihood(measured, wanted), alpha) << measured.mean << " +- " << measured.error << ", exactly " << wanted;
  EXPECT_LT(measured.error, 0.01 * wanted);
}

}  // namespace
