#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

#include "given_rays.h"
#include "pictures.h"
#include "scene_parts.h"

using namespace glimt;

// Answers in closed form. The probability of a false alarm is alpha for each test.
namespace {

constexpr double alpha = 1e-4;

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

/// A point of the floor shows rho / pi times its irradiance, since nothing else is there to reflect light: every light
/// sampling, with MIS and without, one and four shadow rays.
void expect_irradiance(Scene scene, const std::function<double(const dvec3&)>& irradiance) {
  struct Case {
    const char* name;
    LightSampling light_sampling;
    Mis mis;
    int shadow_rays, paths;
  };
  const std::vector<Case> cases{{"by chance", LightSampling::none, Mis::off, 1, 5000 * effort},
                                {"area", LightSampling::area, Mis::off, 1, 2000 * effort},
                                {"area", LightSampling::area, Mis::off, 4, 500 * effort},
                                {"area, MIS", LightSampling::area, Mis::on, 1, 2000 * effort},
                                {"area, MIS", LightSampling::area, Mis::on, 4, 500 * effort},
                                {"solid angle", LightSampling::solid_angle, Mis::off, 1, 2000 * effort},
                                {"solid angle", LightSampling::solid_angle, Mis::off, 4, 500 * effort},
                                {"solid angle, MIS", LightSampling::solid_angle, Mis::on, 1, 2000 * effort},
                                {"solid angle, MIS", LightSampling::solid_angle, Mis::on, 4, 500 * effort},
                                {"auto", LightSampling::automatic, Mis::off, 1, 2000 * effort},
                                {"auto, MIS", LightSampling::automatic, Mis::on, 2, 1000 * effort}};
  const double level = sidak(alpha, static_cast<double>(cases.size() * floor_points.size()));
  for (const Case& c : cases) {
    scene.render.light_sampling = c.light_sampling;
    scene.render.mis = c.mis;
    scene.render.shadow_rays = c.shadow_rays;
    const CompiledScene compiled = compile(scene);
    for (const dvec3& p : floor_points) {
      const double exact = 0.5 / std::numbers::pi * 7 * irradiance(p);
      const Estimate e = radiance_at(compiled, scene.camera.eye, p, c.paths);
      EXPECT_GT(likelihood(e, exact), level)
          << scene.name << ", " << c.name << ", " << c.shadow_rays << " shadow rays, at (" << p.x << ", " << p.z
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
      std::vector<dvec3> v(3);
      std::ranges::transform(t, v.begin(), [&](int i) { return mesh.vertices[static_cast<std::size_t>(i)]; });
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

}  // namespace
