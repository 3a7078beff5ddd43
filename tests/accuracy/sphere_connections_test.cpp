// Caustics that are seen in mirrors and through glass are one picture by connections over spheres and by chance. The
// probability of a false alarm is alpha for each test.
#include <gtest/gtest.h>

#include "same_picture.h"
#include "scene_parts.h"

using namespace glimt;

namespace {

constexpr double alpha = 1e-4;

/// A box, 4 m wide and 2 m high, with a square lamp of that edge 5 cm under its ceiling. The wall that the camera looks
/// at is a mirror.
Scene mirror_room(const std::string& name, double edge = 1) {
  Scene scene;
  scene.name = name;
  scene.materials = {lambertian("white", {0.7, 0.6, 0.5}), light("lamp", dvec3{4 / (edge * edge)}), glass("glass", 1.5),
                     mirror("mirror", {0.9, 0.8, 0.9})};
  scene.polygons = box({-2, -1, -2}, {2, 1, 2}, "white");
  scene.polygons[2].material = "mirror";
  scene.polygons.push_back(square_lamp(edge, 0.95));
  scene.camera = {{0, 0.2, -1}, {0, -0.3, -2}, {0, 1, 0}, 80};
  scene.image = {32, 32};
  return scene;
}

Scene with_ball(const std::string& name, const std::string& material, const dvec3& center = {0.1, -0.4, 0.2}) {
  Scene scene = mirror_room(name);
  scene.spheres = {{"ball", material, center, 0.5}};
  return scene;
}

std::vector<Scene> scenes() {
  std::vector<Scene> all{with_ball("mirror", "mirror"), with_ball("glass", "glass")};
  all.push_back(with_ball("thin glass by Schlick", "thin"));
  all.back().materials.push_back(glass("thin", 1.05, Fresnel::schlick));
  all.push_back(with_ball("a bubble", "bubble"));
  all.back().materials.push_back(glass("bubble", 0.7));
  all.push_back(with_ball("nothing", "air"));
  all.back().materials.push_back(glass("air", 1));

  all.push_back(mirror_room("three balls in a row", 0.7));
  for (const auto& [ior, x] : {std::pair{1.05, -1.2}, {1.5, 0.0}, {2.4, 1.2}}) {
    const std::string material = "glass " + std::to_string(ior);
    all.back().materials.push_back(glass(material, ior));
    all.back().spheres.push_back({material, material, {x, -0.5, 0}, 0.45});
  }

  all.push_back(with_ball("through a glass block", "glass"));
  all.back().polygons[2].material = "white";
  all.back().meshes = {box_mesh({-1.5, -0.9, -1.4}, {1.5, 0.9, -1.2}, "glass", false)};
  all.back().camera = {{0, 0.2, -1.8}, {0, -0.4, 0}, {0, 1, 0}, 70};

  all.push_back(with_ball("a core that lets nothing through", "glass"));
  all.back().spheres.push_back({"core", "white", {0.1, -0.4, 0.2}, 0.3});

  // All of it in a medium of its own, at an index of 1.5 / 1.2.
  all.push_back(mirror_room("under water", 0.4));
  all.back().materials.push_back(glass("water", 1.2));
  all.back().polygons.back().vertices = {{-0.3, 0.5, -0.3}, {0.3, 0.5, -0.3}, {0.3, 0.5, 0.3}, {-0.3, 0.5, 0.3}};
  all.back().polygons.push_back(
      {"bottom", "white", {{-0.5, -0.6, 0.5}, {0.5, -0.6, 0.5}, {0.5, -0.6, -0.5}, {-0.5, -0.6, -0.5}}});
  all.back().spheres = {{"water", "water", {0, 0, 0}, 0.99},
                        {"ball", "glass", {0.1, -0.2, 0}, 0.25},
                        {"mirror", "mirror", {-0.4, -0.3, 0.1}, 0.2}};
  all.back().camera = {{0, 0, 0.8}, {0, -0.3, 0}, {0, 1, 0}, 70};

  all.push_back(with_ball("lamps of all shapes", "glass"));
  all.back().materials.push_back(light("bulb", {8, 6, 4}));
  all.back().materials.push_back(light("panel", {3, 1, 2}));
  all.back().spheres.push_back({"bulb", "bulb", {-1.2, 0.2, 0.6}, 0.25});
  all.back().spheres.push_back({"second", "mirror", {1, -0.7, -0.5}, 0.3});
  all.back().polygons.push_back({"panel", "panel", {{-1, 0, 1.9}, {0, 0.8, 1.9}, {0.9, 0.1, 1.9}}});
  all.back().render.light_sampling = LightSampling::solid_angle;

  all.push_back(with_ball("things in the way", "glass"));
  all.back().meshes = {box_mesh({-0.3, -0.1, 0.9}, {0.5, 0.3, 1.3}, "white", false)};
  all.back().polygons.push_back({"slice", "white", {{-1, -0.5, -0.6}, {1, -0.5, -0.6}, {1, -0.2, 0}, {-1, -0.2, 0}}});
  all.back().spheres.push_back({"cut", "glass", {1.2, -0.5, 0.6}, 0.4});
  all.back().spheres.push_back({"beside", "mirror", {1.2, -0.5, -0.9}, 0.4});

  all.push_back(with_ball("in touch with walls and beyond", "glass", {0, -0.5, 0}));
  all.back().spheres.push_back({"sunk", "glass", {-1.2, -0.9, 0.3}, 0.4});
  all.back().spheres.push_back({"in the wall", "mirror", {1.8, -0.2, 0.3}, 0.5});

  all.push_back(with_ball("rough and EON floors", "glass"));
  all.back().polygons[0].material = "clay";
  all.back().polygons[3].material = "eon";
  all.back().materials.push_back(oren_nayar("clay", 0.8, {0.6, 0.6, 0.7}));
  all.back().materials.push_back(eon("eon", 1, {0.8, 0.6, 0.5}));

  all.push_back(mirror_room("more balls than are connected"));
  for (int i = 0; i < 10; ++i)
    all.back().spheres.push_back({"ball " + std::to_string(i),
                                  i % 3 == 0 ? "mirror" : "glass",
                                  {-1.6 + 0.35 * i, -0.6 + 0.1 * (i % 4), 0.3 * (i % 2)},
                                  0.14 + 0.003 * i});

  // Far from a square metre, so that a density per area is not one per lamp.
  all.push_back(mirror_room("a small lamp by solid angle", 0.3));
  all.back().spheres = {{"ball", "mirror", {0.1, -0.4, 0.2}, 0.5}};
  all.back().render.light_sampling = LightSampling::solid_angle;
  return all;
}

class SphereConnected : public testing::TestWithParam<Scene> {};

TEST_P(SphereConnected, AndChanceMakeOnePicture) {
  const int samples = 8 * effort;
  int first_seed = 0;
  const auto pictures = [&](Settings settings, bool connected) {
    Series series;
    Scene scene = GetParam();
    scene.render = settings;
    scene.render.sphere_connections = connected ? SphereConnections::on : SphereConnections::off;
    for (int i = 0; i < 16; ++i) {
      scene.render.seed = ++first_seed;
      const CompiledScene compiled = compile(scene);
      if (connected && compiled.chain_spheres.empty()) throw std::runtime_error("nothing is connected");
      series.blocks.push_back(block_means(render(compiled, samples).mean(), 8));
    }
    return series;
  };
  Settings settings = GetParam().render;
  settings.caustics = Caustics::only;
  settings.light_paths = 0;
  settings.sampler = Sampler::independent;
  Settings many = settings;
  many.shadow_rays = 3;
  many.sampler = Sampler::lattice;
  Settings shallow = settings, shallower = settings;
  shallow.max_depth = 5;
  shallower.max_depth = 4;
  Settings whole = settings;
  whole.caustics = Caustics::on;
  whole.mis = Mis::on;
  const std::vector<std::vector<Named>> groups{
      {{"chance", pictures(settings, false)},
       {"connections", pictures(settings, true)},
       {"three connections", pictures(many, true)}},
      {{"chance, depth 5", pictures(shallow, false)}, {"connections, depth 5", pictures(shallow, true)}},
      {{"chance, depth 4", pictures(shallower, false)}, {"connections, depth 4", pictures(shallower, true)}},
      {{"chance, all light", pictures(whole, false)}, {"connections, all light", pictures(whole, true)}}};

  const double level = sidak(alpha, 6 * comparisons(groups[0][0].series));
  for (const auto& group : groups)
    for (std::size_t i = 0; i < group.size(); ++i)
      for (std::size_t k = 0; k < i; ++k) expect_same(group[i], group[k], level, GetParam().name);
}

INSTANTIATE_TEST_SUITE_P(Scenes, SphereConnected, testing::ValuesIn(every_third(scenes())),
                         [](const auto& scene) { return case_name(scene.param); });
INSTANTIATE_TEST_SUITE_P(MoreScenesLong, SphereConnected, testing::ValuesIn(every_third(scenes(), true)),
                         [](const auto& scene) { return case_name(scene.param); });

// A scene without specular spheres has nothing to connect over: not a bit of its picture depends on the setting.
TEST(SphereConnections, AreNoneWithoutSpecularSpheres) {
  Scene scene = mirror_room("mirror wall");
  const CompiledScene with = compile(scene);
  EXPECT_TRUE(with.chain_spheres.empty());
  scene.render.sphere_connections = SphereConnections::off;
  EXPECT_EQ(render(with, 2).mean().rgb, render(compile(scene), 2).mean().rgb);
}

// A mirror ball in a cup that is open to the lamp. The mirror on the wall shows the floor outside, which does not see
// the ball: no chain of the wall, the floor, the ball and the lamp brings any light. What is left is light by way of
// the wall twice, which connections leave as it is, bit for bit.
TEST(SphereConnections, DoNotShineThroughTheWallsOfACup) {
  Scene scene = with_ball("cup", "mirror");
  scene.camera.fov_y = 15;
  scene.render.max_depth = 4;
  scene.render.caustics = Caustics::only;
  scene.render.light_paths = 0;
  const auto picture = [](Scene shown, SphereConnections connections) {
    shown.render.sphere_connections = connections;
    return render(compile(shown), 16).mean().rgb;
  };
  EXPECT_NE(picture(scene, SphereConnections::on), picture(scene, SphereConnections::off)) << "without the cup";
  for (Polygon wall : box({-0.6, -1, -0.5}, {0.8, 0.3, 0.9}, "white")) {
    if (wall.name == "floor" || wall.name == "ceiling") continue;
    wall.name.insert(0, "cup ");
    scene.polygons.push_back(wall);
  }
  ASSERT_EQ(compile(scene).chain_spheres.size(), 1U);
  EXPECT_EQ(picture(scene, SphereConnections::on), picture(scene, SphereConnections::off));
}

}  // namespace
