// Small lamps in view, straight or by way of mirrors and glass. The probability of a false alarm is alpha for each
// test.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "same_picture.h"
#include "scene_parts.h"

using namespace glimt;

namespace {

constexpr double alpha = 1e-4;
constexpr double pi = std::numbers::pi;
constexpr double radius = 1e-3, radiance = 100;

/// A lamp of 1 mm in a black room, seen along -z by 8x8 pixels of 0.05 at distance 1: they have 400 times its size.
Scene speck(const dvec3& at) {
  Scene scene;
  scene.name = "speck";
  scene.materials = {lambertian("black", dvec3{0}), light("lamp", dvec3{radiance}), glass("glass", 1.5),
                     mirror("mirror", dvec3{0.8})};
  scene.polygons = box({-9, -9, -9}, {9, 9, 9}, "black");
  scene.spheres = {{"lamp", "lamp", at, radius}};
  scene.camera = {{0, 0, 0}, {0, 0, -1}, {0, 1, 0}, 2 * std::atan(4 * 0.05) * 180 / pi};
  scene.image = {8, 8};
  return scene;
}

/// Of the lamp seen at that distance along the axis, in pixels, from sin(half its angle) = radius / distance.
double seen_area(double distance) {
  const double sine = radius / distance;
  return pi * sine * sine / (1 - sine * sine) / (0.05 * 0.05);
}

// On the axis flat surfaces change the distance at which a lamp seems to be and not its size: a depth a of glass is
// a/n, and a mirror adds the way behind it. Glass passes 1 - F at each face, F = ((n-1)/(n+1))^2 = 0.04; in a pane
// light goes to and fro, each time F^2 of it and 2 t/n farther away. A lamp in glass has its radiance over n^2 outside.
TEST(LampImages, HaveTheExactBrightness) {
  constexpr double n = 1.5, f = 0.04;
  struct Case {
    const char* name;
    Scene scene;
    double expected;  ///< of the four pixels in the middle, their sum over the lamp's radiance
  };
  std::vector<Case> cases;
  cases.push_back({"straight", speck({0, 0, -3}), seen_area(3)});
  cases.push_back({"in a mirror", speck({0, 0, 1}), 0.8 * seen_area(2 + 3)});
  cases.back().scene.polygons.push_back({"mirror", "mirror", {{-1, -1, -2}, {1, -1, -2}, {1, 1, -2}, {-1, 1, -2}}});
  cases.push_back({"in a glass cube", speck({0, 0, -3}), (1 - f) / (n * n) * seen_area(2.9 + 0.1 / n)});
  cases.back().scene.meshes = {box_mesh({-0.1, -0.1, -3.1}, {0.1, 0.1, -2.9}, "glass", false)};
  double through = 0;
  for (int k = 0; k < 4; ++k)
    through += std::pow(1 - f, 2) * std::pow(f, 2 * k) * seen_area(2.8 + (2 * k + 1) * 0.2 / n);
  cases.push_back({"behind a pane", speck({0, 0, -3}), through});
  cases.back().scene.meshes = {box_mesh({-1, -1, -1.2}, {1, 1, -1}, "glass", false)};
  for (Case& c : cases) {
    std::vector<double> sums;
    for (int seed = 1; seed <= 32; ++seed) {
      c.scene.render.seed = seed;
      const CompiledScene compiled = compile(c.scene);
      ASSERT_EQ(compiled.lamp_images.size(), 1u) << c.name;
      const Image picture = render(compiled, 2 * effort).mean();
      sums.push_back(0);
      for (const int x : {3, 4})
        for (const int y : {3, 4}) sums.back() += static_cast<double>(picture.pixel(x, y)[0]) / radiance;
    }
    const Estimate sum = estimate(sums);
    EXPECT_GT(likelihood(sum, c.expected), sidak(alpha, static_cast<double>(cases.size())))
        << c.name << ": " << sum.mean << " +- " << sum.error << ", exactly " << c.expected;
    EXPECT_LT(sum.error, 0.02 * c.expected) << c.name;
  }
}

// Lamps of about a pixel in a room of all materials, for every way to sample lamps: the picture without a second look.
TEST(LampImages, KeepThePicture) {
  Scene scene = speck({0.1, 0.1, -3});
  scene.materials[0] = lambertian("black", dvec3{0.5});
  scene.polygons = box({-1, -1, -4}, {1, 1, 0.5}, "black");
  scene.polygons.push_back({"mirror", "mirror", {{-0.9, -0.9, -3.5}, {0, -0.9, -3.5}, {0, 0, -3.5}, {-0.9, 0, -3.5}}});
  scene.spheres.front().radius = 0.04;
  scene.spheres.push_back({"second", "lamp", {-0.25, -0.3, -2.5}, 0.03});
  scene.spheres.push_back({"ball", "glass", {0.25, -0.25, -2.5}, 0.15});
  scene.meshes = {box_mesh({0, 0, -3.2}, {0.2, 0.2, -2.8}, "glass", false)};
  scene.materials[1] = light("lamp", dvec3{5});
  const std::vector<std::pair<std::string, std::function<void(Settings&)>>> ways{
      {"as it is", [](Settings&) {}},
      {"MIS", [](Settings& s) { s.mis = Mis::on; }},
      {"by chance", [](Settings& s) { s.light_sampling = LightSampling::none; }},
      {"caustics by chance", [](Settings& s) { s.light_paths = 0, s.sphere_connections = SphereConnections::off; }},
      {"without caustics", [](Settings& s) { s.caustics = Caustics::off; }},
      {"three surfaces", [](Settings& s) { s.max_depth = 3; }}};
  for (const auto& [name, change] : ways) {
    scene.render = {};
    change(scene.render);
    std::vector<Named> all{{"with", {}}, {"without", {}}};
    for (int seed = 1; seed <= 16; ++seed)
      for (std::size_t k = 0; k < 2; ++k) {
        scene.render.seed = seed + 1000 * static_cast<int>(k);
        CompiledScene compiled = compile(scene);
        EXPECT_GE(compiled.lamp_images.size(), 2u) << name;
        if (k == 1) compiled.lamp_images.clear();
        all[k].series.blocks.push_back(block_means(render(compiled, 16 * effort).mean(), 2));
      }
    expect_same(all[0], all[1], sidak(alpha, static_cast<double>(ways.size()) * comparisons(all[0].series)), name);
  }
}

// Whole scenes with a lamp that nothing but a second look finds: what is outside the image, behind the eye or hidden
// has none, and large lamps need none.
TEST(LampImages, AreFoundWhereTheEyeSeesSmallLamps) {
  const auto found = [](const std::function<void(Scene&)>& edit) {
    Scene scene = speck({0, 0, -3});
    edit(scene);
    return compile(scene).lamp_images.size();
  };
  EXPECT_EQ(found([](Scene&) {}), 1u);
  EXPECT_EQ(found([](Scene& s) { s.spheres[0].center = {2, 0, -3}; }), 0u) << "beside the image";
  EXPECT_EQ(found([](Scene& s) { s.spheres[0].center = {0, 0, 3}; }), 0u) << "behind the eye";
  EXPECT_EQ(found([](Scene& s) { s.spheres[0].radius = 1; }), 0u) << "large";
  EXPECT_EQ(found([](Scene& s) { s.spheres.push_back({"ball", "black", {0, 0, -2}, 0.1}); }), 0u) << "hidden";
  EXPECT_EQ(found([](Scene& s) {
              s.spheres[0].center = {0, 0, 2};
              s.polygons.push_back({"one", "mirror", {{-1, -1, -2}, {0, -1, -2}, {0, 1, -2}, {-1, 1, -2}}});
              s.polygons.push_back({"two", "mirror", {{0, -1, -2}, {1, -1, -2}, {1, 1, -2}, {0, 1, -2}}});
              for (Polygon& p : s.polygons)
                if (p.material == "mirror")
                  for (dvec3& v : p.vertices) v.z += 0.05 * std::abs(v.x);
            }),
            2u)
      << "in two mirrors";
  EXPECT_EQ(found([](Scene& s) { s.render.caustics = Caustics::only; }), 0u);
}

}  // namespace
