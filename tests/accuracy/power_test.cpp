#include <gtest/gtest.h>

#include <iostream>
#include <random>

#include "given_rays.h"

using namespace glimt;

// What lamps emit in a closed room is absorbed in it.
namespace {

constexpr double alpha = 1e-4;  ///< probability of a false alarm

/// A piece of surface that absorbs light: points of it and the side that is meant.
struct Absorber {
  double area;
  double absorbed;                                               ///< share, 1 - reflectance, of the green channel
  std::function<std::pair<dvec3, dvec3>(double, double)> point;  ///< and normal, uniform by area, from the unit square
};

Absorber parallelogram(const dvec3& a, const dvec3& e1, const dvec3& e2, double absorbed) {
  const dvec3 n = cross(e1, e2);
  return {length(n), absorbed, [=](double u, double v) { return std::pair{a + u * e1 + v * e2, normalize(n)}; }};
}

Absorber sphere(const dvec3& centre, double radius, double absorbed) {
  return {4 * std::numbers::pi * radius * radius, absorbed, [=](double u, double v) {
            const double z = 1 - 2 * u, r = std::sqrt(1 - z * z), turn = 2 * std::numbers::pi * v;
            const dvec3 n{r * std::cos(turn), r * std::sin(turn), z};
            return std::pair{centre + radius * n, n};
          }};
}

/// A room with a rectangle and a sphere for lamps, which absorb all that meets them, a grey ball, and a mirror and a
/// glass ball, which absorb nothing.
Scene room() {
  Scene scene;
  scene.materials = {lambertian("white", dvec3{0.7}), lambertian("grey", dvec3{0.3}), light("lamp", dvec3{5}),
                     light("bulb", dvec3{2}),         mirror("mirror", dvec3{1}),     glass("glass", 1.5)};
  scene.polygons = box({-2, -1, -2}, {2, 1, 2}, "white");
  scene.polygons.push_back({"lamp", "lamp", {{-0.5, 0.8, -0.5}, {0.7, 0.8, -0.5}, {0.7, 0.8, 0.4}, {-0.5, 0.8, 0.4}}});
  scene.spheres = {{"bulb", "bulb", {1.4, -0.3, -1.2}, 0.3},
                   {"grey", "grey", {-1, -0.5, -0.8}, 0.4},
                   {"mirror", "mirror", {0.8, -0.5, 0.9}, 0.45},
                   {"glass", "glass", {-0.9, -0.4, 0.8}, 0.5}};
  scene.camera = {{0, 0, 1.9}, {0, -0.1, 0}, {0, 1, 0}, 75};
  return scene;
}

// The lamp's front is the side of its normal. Light that meets a surface is pi times the mean of the radiance from
// directions in proportion to the cosine; rays begin a hair in front of the surface.
TEST(PowerLong, EmittedIsAbsorbed) {
  Scene scene = room();
  const auto& v = scene.polygons[6].vertices;
  std::vector<Absorber> absorbers;
  for (int i = 0; i < 6; ++i) {
    const auto& w = scene.polygons[static_cast<std::size_t>(i)].vertices;
    absorbers.push_back(parallelogram(w[0], w[1] - w[0], w[3] - w[0], 0.3));
  }
  absorbers.push_back(parallelogram(v[0], v[1] - v[0], v[3] - v[0], 1));
  absorbers.push_back(parallelogram(v[0], v[3] - v[0], v[1] - v[0], 1));
  absorbers.push_back(sphere({1.4, -0.3, -1.2}, 0.3, 1));
  absorbers.push_back(sphere({-1, -0.5, -0.8}, 0.4, 0.7));
  const double emitted = std::numbers::pi * (5 * absorbers[6].area + 2 * absorbers[8].area);

  scene.render.sampler = Sampler::independent;
  for (const Mis mis : {Mis::off, Mis::on}) {
    scene.render.mis = mis;
    scene.render.light_sampling = mis == Mis::on ? LightSampling::solid_angle : LightSampling::automatic;
    const CompiledScene compiled = compile(scene);
    std::vector<double> groups(32);
    const int each = 600 * effort;
    std::mt19937_64 random(7);
    std::uniform_real_distribution<double> u(0, 1);
    int path = 0;
    for (double& absorbed : groups)
      for (const Absorber& a : absorbers)
        for (int i = 0; i < each; ++i) {
          const double s = u(random), t = u(random);
          const auto [p, n] = a.point(s, t);
          const double sin2 = u(random), turn = 2 * std::numbers::pi * u(random), sin = std::sqrt(sin2);
          const auto [x, y] = tangents(n);
          const dvec3 w = sin * std::cos(turn) * x + sin * std::sin(turn) * y + std::sqrt(1 - sin2) * n;
          absorbed += a.area * a.absorbed * std::numbers::pi / each * trace_green(compiled, p + 1e-6 * n, w, path++, 0);
        }
    const Estimate e = estimate(groups);
    std::cout << "absorbed over emitted: " << e.mean / emitted << " +- " << e.error / emitted << "\n";
    EXPECT_GT(likelihood(e, emitted), sidak(alpha, 2)) << e.mean << " +- " << e.error << ", emitted " << emitted;
    EXPECT_LT(e.error, (effort > 1 ? 0.003 : 0.02) * emitted) << "too few paths to say anything";
  }
}

}  // namespace
