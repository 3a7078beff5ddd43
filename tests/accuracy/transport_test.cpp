#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>

#include "pictures.h"
#include "scene/scene_file.h"
#include "scene_parts.h"

using namespace glimt;

// Answers in closed form, and estimators that must agree. The probability of a false alarm is alpha for each test.
namespace {

constexpr double alpha = 1e-4;

/// Radiance along the ray from `eye` to `point`, over independent paths in 16 groups.
Estimate radiance_at(const CompiledScene& scene, const dvec3& eye, const dvec3& point, int paths) {
  const dvec3 d = normalize(point - eye);
  std::vector<double> groups(16);
  for (int i = 0; i < paths; ++i) {
    const GivenPath path{{eye.x, eye.y, eye.z},
                         {d.x, d.y, d.z},
                         static_cast<std::uint32_t>(i % 997),
                         static_cast<std::uint32_t>(i / 997)};
    groups[static_cast<std::size_t>(i) % 16] +=
        static_cast<double>(trace_ray(scene, path, Lanes::scalar).g) * 16 / paths;
  }
  return estimate(groups);
}

/// Irradiance by a polygon of radiance 1 at `point` with that normal, the polygon wholly above its horizon: half the
/// sum over the edges of the angle they are seen under times the component of the edge's plane's normal (Lambert 1760).
double lambert_irradiance(const std::vector<dvec3>& polygon, const dvec3& point, const dvec3& normal) {
  double sum = 0;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const dvec3 a = normalize(polygon[i] - point), b = normalize(polygon[(i + 1) % polygon.size()] - point);
    sum += std::acos(dot(a, b)) * dot(normalize(cross(a, b)), normal);
  }
  return std::abs(sum) / 2;
}

/// A floor of reflectance (0.2, 0.5, 0.8) in the dark, with the camera above it.
Scene dark_floor() {
  Scene scene;
  scene.materials = {lambertian("floor", {0.2, 0.5, 0.8}), light("lamp", {3, 7, 1})};
  scene.polygons = {{"floor", "floor", {{-9, 0, -9}, {-9, 0, 9}, {9, 0, 9}, {9, 0, -9}}}};
  scene.camera = {{0, 2, 5}, {0, 0, 0}, {0, 1, 0}, 50};
  scene.image = {16, 16};
  return scene;
}

const std::vector<dvec3> floor_points{{0, 0, 0}, {1, 0, 0.5}, {-2, 0, 1}, {0.3, 0, -1.5}, {3, 0, 0}};

/// A point of the floor shows rho / pi times its irradiance, since nothing else is there to reflect light: both
/// estimators, one and four shadow rays.
void expect_irradiance(Scene scene, const std::function<double(const dvec3&)>& irradiance) {
  struct Case {
    Method method;
    int shadow_rays, paths;
  };
  const std::vector<Case> cases{
      {Method::path, 1, 2000 * effort}, {Method::path, 4, 500 * effort}, {Method::naive, 1, 5000 * effort}};
  const double level = sidak(alpha, static_cast<double>(cases.size() * floor_points.size()));
  for (const Case& c : cases) {
    set_method(scene.render, c.method);
    scene.render.shadow_rays = c.shadow_rays;
    const CompiledScene compiled = compile(scene);
    for (const dvec3& p : floor_points) {
      const double exact = 0.5 / std::numbers::pi * 7 * irradiance(p);
      const Estimate e = radiance_at(compiled, scene.camera.eye, p, c.paths);
      EXPECT_GT(likelihood(e, exact), level) << scene.name << (c.method == Method::path ? ", path, " : ", naive, ")
                                             << c.shadow_rays << " shadow rays, at (" << p.x << ", " << p.z
                                             << "): " << e.mean << " +- " << e.error << ", exactly " << exact;
      EXPECT_LT(e.error, 0.05 * exact + 1e-3) << "too few paths to say anything";
    }
  }
}

TEST(ClosedForm, RectangleLamp) {
  Scene scene = dark_floor();
  scene.name = "rectangle";
  const std::vector<dvec3> lamp{{-1, 2, -1}, {1, 2, -1}, {1, 2.5, 0.5}, {-1, 2.5, 0.5}};
  scene.polygons.push_back({"lamp", "lamp", lamp});
  expect_irradiance(scene, [&](const dvec3& p) { return lambert_irradiance(lamp, p, {0, 1, 0}); });
}

TEST(ClosedForm, HexagonLamp) {
  Scene scene = dark_floor();
  scene.name = "hexagon";
  scene.polygons.push_back(disk("lamp", "lamp", {0.5, 2, 0}, {0.2, -1, 0.1}, 1, 6));
  const std::vector<dvec3> lamp = scene.polygons.back().vertices;
  expect_irradiance(scene, [&](const dvec3& p) { return lambert_irradiance(lamp, p, {0, 1, 0}); });
}

// Open meshes of one triangle each.
TEST(ClosedForm, TriangleMeshLamps) {
  Scene scene = dark_floor();
  scene.name = "triangles";
  const std::vector<dvec3> lamp{{-1, 2, -1}, {1, 2, -1}, {0, 2, 1}};
  scene.meshes = {{"lamp", "lamp", lamp, {{0, 1, 2}}}};
  expect_irradiance(scene, [&](const dvec3& p) { return lambert_irradiance(lamp, p, {0, 1, 0}); });
  const std::vector<dvec3> second{{2, 1, -1}, {3, 1, -1}, {3, 1, 1}};
  scene.meshes.push_back({"second", "lamp", second, {{0, 1, 2}}});
  expect_irradiance(scene, [&](const dvec3& p) {
    return lambert_irradiance(lamp, p, {0, 1, 0}) + lambert_irradiance(second, p, {0, 1, 0});
  });
}

// A sphere of radius r at distance d, wholly above the horizon, gives the irradiance pi L (r / d)^2 cos(theta) of a
// disk seen under the same angle.
TEST(ClosedForm, SphereLamp) {
  Scene scene = dark_floor();
  scene.name = "sphere";
  const dvec3 centre{0.5, 1.5, 0};
  scene.spheres = {{"lamp", "lamp", centre, 0.7}};
  expect_irradiance(scene, [&](const dvec3& p) {
    const double d2 = dot(centre - p, centre - p);
    return std::numbers::pi * 0.49 / d2 * (centre.y / std::sqrt(d2));
  });
}

// A closed convex lamp is seen by the sides that face the point.
TEST(ClosedForm, SolidLamp) {
  Scene scene = dark_floor();
  scene.name = "tetrahedron";
  scene.meshes = {tetrahedron("lamp", "lamp", {0, 1.5, 0}, 0.8)};
  const Mesh& mesh = scene.meshes[0];
  expect_irradiance(scene, [&](const dvec3& p) {
    double sum = 0;
    for (const auto& t : mesh.triangles) {
      std::vector<dvec3> v;
      for (const int i : t) v.push_back(mesh.vertices[static_cast<std::size_t>(i)]);
      if (dot(cross(v[1] - v[0], v[2] - v[0]), p - v[0]) > 0) sum += lambert_irradiance(v, p, {0, 1, 0});
    }
    return sum;
  });
}

// Lamps shine to their front only.
TEST(ClosedForm, BackOfALampIsDark) {
  Scene scene = dark_floor();
  scene.polygons.push_back({"lamp", "lamp", {{-1, 2, 0.5}, {1, 2, 0.5}, {1, 2, -1}, {-1, 2, -1}}});
  for (const Method method : {Method::path, Method::naive}) {
    set_method(scene.render, method);
    for (const float v : trace_all(compile(scene), 16, Lanes::native)) ASSERT_EQ(v, 0);
  }
}

/// Overall mean and blocks of 8x8 pixels of two series of pictures of the same thing.
void expect_same(const Series& a, const Series& b, const std::string& what) {
  const double level = sidak(alpha, static_cast<double>(a.size()) + 1);
  EXPECT_GT(likelihood(a.overall(), b.overall()), level)
      << what << ": " << a.overall().mean << " +- " << a.overall().error << " and " << b.overall().mean << " +- "
      << b.overall().error;
  for (std::size_t i = 0; i < a.size(); ++i)
    EXPECT_GT(likelihood(a.block(i), b.block(i)), level)
        << what << ", block " << i / 3 << ", channel " << i % 3 << ": " << a.block(i).mean << " +- " << a.block(i).error
        << " and " << b.block(i).mean << " +- " << b.block(i).error;
}

/// A box with large lamps of every shape, so that chance finds them too, and things that stand in the light.
Scene lamps_of_all_shapes() {
  Scene scene;
  scene.materials = {
      lambertian("white", {0.7, 0.7, 0.6}),
      lambertian("red", {0.7, 0.2, 0.1}),
      light("ceiling lamp", {2, 3, 4}),
      light("bulb", {5, 3, 1}),
      light("crystal", {1, 6, 2}),
      {.name = "clay", .type = MaterialType::oren_nayar, .reflectance = {0.6, 0.6, 0.7}, .roughness = 0.8}};
  scene.polygons = box({-2, -1, -2}, {2, 1, 2}, "white");
  scene.polygons[4].material = "red";
  scene.polygons.push_back(
      {"ceiling lamp", "ceiling lamp", {{-1, 0.9, -1}, {0.5, 0.9, -1.2}, {1, 0.9, 0}, {0, 0.9, 1}, {-1, 0.9, 0.5}}});
  scene.spheres = {{"bulb", "bulb", {1.2, -0.2, -0.8}, 0.4}, {"ball", "clay", {0, -0.5, 0}, 0.5}};
  scene.meshes = {tetrahedron("crystal", "crystal", {-1.2, -0.3, -0.5}, 0.5),
                  tetrahedron("block", "white", {0.9, -0.6, 0.6}, 0.4)};
  scene.camera = {{0, 0, 1.9}, {0, -0.1, 0}, {0, 1, 0}, 75};
  scene.image = {48, 48};
  return scene;
}

TEST(Estimators, NaiveIsPath) {
  Scene scene = lamps_of_all_shapes();
  const Series path = render_series(scene, 12, 8 * effort, 8);
  set_method(scene.render, Method::naive);
  expect_same(path, render_series(scene, 12, 32 * effort, 8), "path and naive");
}

TEST(Estimators, ShadowRaysAndRouletteDoNotChangeTheMean) {
  Scene scene = lamps_of_all_shapes();
  const Series one = render_series(scene, 12, 8 * effort, 8);
  scene.render.shadow_rays = 4;
  scene.render.seed = 5;
  expect_same(one, render_series(scene, 12, 4 * effort, 8), "one and four shadow rays");
  scene.render.shadow_rays = 1;
  scene.render.roulette = Roulette::constant;
  expect_same(one, render_series(scene, 12, 16 * effort, 8), "roulette by throughput and constant");
  scene.render.roulette = Roulette::throughput;
  for (const int depth : {0, 20}) {
    scene.render.roulette_depth = depth;
    expect_same(one, render_series(scene, 12, 8 * effort, 8), "roulette from depth 4 and " + std::to_string(depth));
  }
}

// Lamps through a mirror and through glass are found by chance in both.
TEST(Estimators, NaiveIsPathWithMirrorAndGlass) {
  Scene scene = lamps_of_all_shapes();
  scene.materials.push_back(mirror("mirror", {0.9, 0.8, 0.9}));
  scene.materials.push_back(glass("glass", 1.5));
  scene.spheres[1].material = "glass";
  scene.meshes[1].material = "mirror";
  const Series path = render_series(scene, 12, 16 * effort, 8);
  set_method(scene.render, Method::naive);
  expect_same(path, render_series(scene, 12, 32 * effort, 8), "path and naive");
}

// A lamp that is half behind the wall lights the room with its other half only, whatever it is made of.
TEST(Estimators, NaiveIsPathWhereWallsHideLamps) {
  for (const bool as_mesh : {false, true}) {
    Scene scene = lamps_of_all_shapes();
    scene.polygons.pop_back();
    scene.spheres[0].center = {2, 0, 0};
    const std::vector<dvec3> pane{{-1, 0.3, 1}, {-1, 0.3, -1}, {-1, 1.8, -1}, {-1, 1.8, 1}};
    if (as_mesh) {
      scene.meshes.push_back({"pane", "ceiling lamp", pane, {{0, 1, 2}, {0, 2, 3}}});
    } else {
      scene.polygons.push_back({"pane", "ceiling lamp", pane});
    }
    const Series path = render_series(scene, 12, 8 * effort, 8);
    set_method(scene.render, Method::naive);
    expect_same(path, render_series(scene, 12, 32 * effort, 8),
                as_mesh ? "path and naive, a mesh" : "path and naive, a polygon");
  }
}

}  // namespace
