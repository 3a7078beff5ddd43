// Lamps of extreme sizes, radiances and places.
#include <gtest/gtest.h>

#include "pictures.h"
#include "samples.h"
#include "scene/file/scene_file.h"

using namespace glimt;

namespace {

constexpr double alpha = 1e-4;  ///< of a false alarm, for each test
constexpr double pi = std::numbers::pi;

/// A dark box 4 m wide and 3 m high with a floor of reflectance 0.5 and a square lamp of that edge under its ceiling,
/// which is the lamp where the edge is 4. Direct light alone.
Scene box_with_lamp(double edge) {
  Scene scene;
  scene.materials = {lambertian("floor", dvec3{0.5}), lambertian("black", dvec3{0}), light("lamp", dvec3{2})};
  scene.polygons = box({-2, 0, -2}, {2, 3, 2}, "black");
  scene.polygons[0].material = "floor";
  scene.polygons.push_back(square_lamp(edge, edge < 4 ? 2.5 : 3));
  if (edge == 4) scene.polygons.erase(scene.polygons.begin() + 1);
  scene.camera = {{0.5, 1, 0.25}, {0.5, 0, 0.25}, {1, 0, 0}, 50};
  scene.render.sampler = Sampler::independent;
  scene.render.max_depth = 2;
  return scene;
}

double exact(const Scene& scene) {
  return 0.5 / pi * 2 * lambert_irradiance(scene.polygons.back().vertices, {0.5, 0, 0.25}, {0, 1, 0});
}

const std::vector<double> edges{1e-3, 1e-2, 0.1, 0.3, 0.35, 1, 4};  // around 0.33 the rectangle stops counting as small

// Failure: solid angles as differences of angles lose all digits for small lamps; areas overflow for none.
TEST(LampSize, FromAMillimetreToTheWholeCeilingLightIsExact) {
  const double level = sidak(alpha, 6.0 * static_cast<double>(edges.size()));
  for (const double edge : edges)
    for (const LightSampling sampling : {LightSampling::area, LightSampling::solid_angle, LightSampling::automatic})
      for (const Mis mis : {Mis::off, Mis::on}) {
        Scene scene = box_with_lamp(edge);
        scene.render.light_sampling = sampling;
        scene.render.mis = mis;
        const Samples s = samples_along(compile(scene), scene.camera.eye, {0, -1, 0}, 1000 * effort);
        EXPECT_GT(likelihood(s.mean, exact(scene)), level)
            << edge << " m, light sampling " << static_cast<int>(sampling) << ", MIS " << static_cast<int>(mis) << ": "
            << s.mean.mean << " +- " << s.mean.error << ", exactly " << exact(scene);
        EXPECT_LT(s.relative_variance(), edge < 1 ? 0.05 : 1) << edge;
      }
}

// Failure: naive sampling of a tiny lamp. A path brings rho L with the probability F = E / (pi L) that a direction
// meets the lamp, so its relative variance is 1 / F - 1: 1.6 for the ceiling, 5e7 for 1 mm, where 8000 paths find
// nothing (probability 1.5e-4 to find any) and the picture is black.
TEST(TinyLamp, FoundByChanceAloneIsLost) {
  for (const double edge : {1.0, 4.0}) {
    Scene scene = box_with_lamp(edge);
    set_method(scene.render, Method::naive);
    scene.render.max_depth = 2;
    scene.render.sampler = Sampler::independent;
    const double f = exact(scene) / (0.5 * 2);
    const Samples s = samples_along(compile(scene), scene.camera.eye, {0, -1, 0}, 5000 * effort);
    EXPECT_GT(likelihood(s.mean, exact(scene)), sidak(alpha, 2)) << edge << " m";
    EXPECT_NEAR(s.relative_variance() * f / (1 - f), 1, effort > 1 ? 0.2 : 0.6) << edge << " m";
  }
  Scene scene = box_with_lamp(1e-3);
  set_method(scene.render, Method::naive);
  scene.render.max_depth = 2;
  EXPECT_LT(exact(scene), 1e-7);
  EXPECT_EQ(samples_along(compile(scene), scene.camera.eye, {0, -1, 0}, 1000 * effort).lit, 0);
}

// Failure: fixed thresholds on radiance, film units that are too coarse or too small. Powers of two scale every float
// of the picture exactly; 1e-6 and 1e6 up to the rounding of a path's products.
TEST(LampRadiance, ScalesThePictureExactly) {
  Scene scene = read_scene(GLIMT_SCENES "/report.toml");
  scene.image = {64, 48};
  Material& lamp = *std::ranges::find(scene.materials, "light", &Material::type);
  const auto brightness = lamp.get(Light::radiance);
  const Image image = render(compile(scene), 2 * effort).mean();
  for (const double factor : {0x1p-20, 0x1p20, 1e-6, 1e6}) {
    lamp.set(Light::radiance, brightness * factor);
    const CompiledScene compiled = compile(scene);
    Film film = make_film(compiled);
    render_pass(compiled, film, 2 * effort, {});
    EXPECT_EQ(film.invalid(), 0u) << factor;
    EXPECT_EQ(film.saturated(), 0u) << factor;
    const Image scaled = film.mean();
    const double allowed = std::log2(factor) == std::round(std::log2(factor)) ? 0 : 2e-6;
    for (std::size_t i = 0; i < image.rgb.size(); ++i) {
      const double wanted = static_cast<double>(image.rgb[i]) * factor;
      // A unit of the film is 2^-38 of the lamp's radiance, at most doubled.
      ASSERT_NEAR(scaled.rgb[i], wanted, allowed * wanted + (allowed > 0 ? 0x1p-37 * 20 * factor : 0)) << factor;
    }
  }
}

// Failure: a lamp seen edge-on has neither area nor direction: quotients of 0 by 0, light on its back.
TEST(LampEdgeOn, ShinesByTheSineOfTheAngle) {
  Scene scene;
  scene.materials = {lambertian("floor", dvec3{1}), light("lamp", dvec3{1})};
  scene.polygons = {{"floor", "floor", {{-2, 0, -2}, {-2, 0, 2}, {2, 0, 2}, {2, 0, -2}}},
                    {"lamp", "lamp", {{0, 0.5, -0.5}, {0, 1.5, -0.5}, {0, 1.5, 0.5}, {0, 0.5, 0.5}}}};
  scene.camera = {{0, 1, 3}, {0, 1, 0}, {0, 1, 0}, 50};
  scene.image = {31, 31};
  scene.render.sampler = Sampler::independent;
  scene.render.max_depth = 2;
  for (const LightSampling sampling : {LightSampling::area, LightSampling::solid_angle})
    for (const Mis mis : {Mis::off, Mis::on}) {
      scene.render.light_sampling = sampling;
      scene.render.mis = mis;
      const CompiledScene compiled = compile(scene);
      for (const double x : {0x1p-3, 0x1p-7, 0x1p-10, 0x1p-13, 0x1p-17, 0x1p-20}) {
        const double wanted = lambert_irradiance(scene.polygons[1].vertices, {x, 0, 0}, {0, 1, 0}) / pi;
        const Samples s = samples_along(compiled, {x, 0.25, 0}, {0, -1, 0}, 1000 * effort);
        EXPECT_GT(likelihood(s.mean, wanted), sidak(alpha, 24))
            << x << " m off its plane: " << s.mean.mean << " +- " << s.mean.error << ", exactly " << wanted;
        EXPECT_EQ(samples_along(compiled, {-x, 0.25, 0}, {0, -1, 0}, 200).largest, 0) << "on its back, " << x << " m";
      }
      EXPECT_EQ(samples_along(compiled, {0, 0.25, 0}, {0, -1, 0}, 200).largest, 0) << "in its plane";
      for (const float v : trace_all(compiled, 8, Lanes::native)) ASSERT_TRUE(v >= 0 && std::isfinite(v));
    }
}

// Failure: light through a pane is lost or doubled by the reflections within it. With R at each side, (1 - R)^2 (1 +
// R^2
// + R^4 + ...) = (1 - R) / (1 + R) of the lamp is seen.
TEST(LampBehindGlass, IsSeenThroughAPane) {
  const std::vector<double> indices{1 + 1e-6, 1.01, 1.5, 3}, angles{0, 30, 60, 80, 89};
  for (const double n : indices)
    for (const double angle : angles) {
      Scene scene;
      scene.materials = {glass("glass", n), light("lamp", dvec3{1})};
      scene.meshes = {box_mesh({-200, 0, -200}, {200, 0.01, 200}, "glass", false)};
      scene.polygons = {{"lamp", "lamp", {{-200, 1, -200}, {200, 1, -200}, {200, 1, 200}, {-200, 1, 200}}}};
      scene.camera = {{0, -1, 0}, {0, 1, 0}, {1, 0, 0}, 50};
      scene.render.sampler = Sampler::independent;
      const double c = std::cos(angle * pi / 180), r = fresnel_exact(c, n), wanted = (1 - r) / (1 + r);
      constexpr int paths = 1000 * effort;
      Samples s = samples_along(compile(scene), scene.camera.eye, {std::sqrt(1 - c * c), c, 0}, paths);
      // A path brings 1 or 0, which may be too rare to show in the measured error.
      s.mean.error = std::max(s.mean.error, std::sqrt(wanted * (1 - wanted) / paths));
      EXPECT_GT(likelihood(s.mean, wanted), sidak(alpha, 20))
          << "index " << n << ", " << angle << " degrees: " << s.mean.mean << " +- " << s.mean.error << ", exactly "
          << wanted;
    }
}

// Failure: a lamp in glass lights nothing (no shadow ray reaches it), as in the report. A lamp of radius a > R / n in a
// glass sphere of radius R fills all of it: from outside it is a ball of radiance L (1 - R(theta)) / n^2 at the place
// where sin(theta) = s, so the floor below its centre at distance D gets pi (R/D)^2 L / n^2 times the integral of
// (1 - R) d(s^2).
TEST(LampBehindGlass, LightsTheFloorAsACaustic) {
  Scene scene;
  scene.materials = {lambertian("floor", dvec3{1}), glass("glass", 1.5), light("lamp", dvec3{1})};
  scene.polygons = {{"floor", "floor", {{-2, 0, -2}, {-2, 0, 2}, {2, 0, 2}, {2, 0, -2}}}};
  scene.spheres = {{"bulb", "glass", {0, 1.5, 0}, 1}, {"filament", "lamp", {0, 1.5, 0}, 0.8}};
  scene.camera = {{1, 3, 0}, {0, 0, 0}, {0, 1, 0}, 50};
  scene.render.sampler = Sampler::independent;
  scene.render.max_depth = 3;
  double integral = 0;
  constexpr int steps = 100000;
  for (int i = 0; i < steps; ++i) integral += (1 - fresnel_exact(std::sqrt(1 - (i + 0.5) / steps), 1.5)) / steps;
  const double wanted = integral / (1.5 * 1.5) * (1 / (1.5 * 1.5));
  for (const Method method : {Method::path, Method::naive}) {
    set_method(scene.render, method);
    scene.render.max_depth = 3;
    const Samples s = samples_along(compile(scene), {0, 0.25, 0}, {0, -1, 0}, 5000 * effort);
    EXPECT_GT(likelihood(s.mean, wanted), sidak(alpha, 2))
        << s.mean.mean << " +- " << s.mean.error << ", exactly " << wanted;
    EXPECT_LT(s.mean.error, 0.05 * wanted);
  }
  set_method(scene.render, Method::path);
  scene.render.caustics = Caustics::off;
  for (const Mis mis : {Mis::off, Mis::on}) {
    scene.render.mis = mis;
    const Samples dark = samples_along(compile(scene), {0, 0.25, 0}, {0, -1, 0}, 100 * effort);
    EXPECT_TRUE(dark.smallest == 0 && dark.largest == 0) << "without caustics it is dark";
  }
}

}  // namespace
