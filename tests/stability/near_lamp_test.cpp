// Points that a lamp almost touches. Sampled by area, a sample is worth A cos cos / d^2, which nothing bounds; sampled
// by solid angle it is worth omega cos, at most 2 pi.
#include <gtest/gtest.h>

#include "compile/compiled_scene.h"
#include "film/statistics.h"
#include "pictures.h"
#include "samples.h"

using namespace glimt;

namespace {

constexpr double alpha = 1e-4;  ///< of a false alarm, for each test
constexpr double pi = std::numbers::pi;

/// Where a floor of reflectance 1 in y = 0 is lit by a lamp of 1 m^2 and radiance 1. `distances` are from the lamp;
/// coordinates of point and lamp are exact floats, so that only the estimator is at work.
struct Place {
  const char* name;
  std::vector<dvec3> (*lamp)(double distance);
  dvec3 (*point)(double distance);
  double solid_angle;  ///< of the lamp from a point that touches it
  /// E[X^2] of X = A cos cos / (pi r^2) by area, as the distance d goes to 0, times d^2 / A.
  double area_second_moment;
};

// Over a lamp that fills the half space around the nearest point, in polar coordinates about that point:
// facing: integral of (d^2/r^4)^2 2 pi s ds / pi^2 = 1 / (3 pi d^2), half of that under the lamp's edge;
// corner: integral of (y d / r^4)^2 over y > 0, / pi^2, is (pi/2) / (12 d^2) / pi^2 = 1 / (24 pi d^2).
const Place places[]{{"below its middle",
                      [](double d) {
                        return std::vector<dvec3>{{-0.5, d, -0.5}, {0.5, d, -0.5}, {0.5, d, 0.5}, {-0.5, d, 0.5}};
                      },
                      [](double) {
                        return dvec3{0, 0, 0};
                      },
                      2 * pi, 1 / (3 * pi)},
                     {"below its edge",
                      [](double d) {
                        return std::vector<dvec3>{{0, d, -0.5}, {1, d, -0.5}, {1, d, 0.5}, {0, d, 0.5}};
                      },
                      [](double) {
                        return dvec3{0, 0, 0};
                      },
                      pi, 1 / (6 * pi)},
                     {"in a corner it touches",
                      [](double) {
                        return std::vector<dvec3>{{0, 0, -0.5}, {0, 1, -0.5}, {0, 1, 0.5}, {0, 0, 0.5}};
                      },
                      [](double d) {
                        return dvec3{d, 0, 0};
                      },
                      pi, 1 / (24 * pi)}};

CompiledScene floor_and_lamp(const Place& place, double distance, LightSampling sampling, Mis mis = Mis::off) {
  Scene scene;
  scene.materials = {lambertian("floor", dvec3{1}), light("lamp", dvec3{1})};
  scene.polygons = {{"floor", "floor", {{-2, 0, -2}, {-2, 0, 2}, {2, 0, 2}, {2, 0, -2}}},
                    {"lamp", "lamp", place.lamp(distance)}};
  scene.camera = {{0.1, 3, 0}, {0, 0, 0}, {1, 0, 0}, 50};
  scene.render.sampler = Sampler::independent;
  scene.render.max_depth = 2;  // camera, floor, lamp: direct light alone
  scene.render.light_sampling = sampling;
  scene.render.mis = mis;
  return compile(scene);
}

/// From just above the point, below the lamp.
Samples samples_at(const CompiledScene& scene, const Place& place, double distance, int paths) {
  return samples_along(scene, place.point(distance) + dvec3{0, 0.25 * distance, 0}, {0, -1, 0}, paths);
}

double exact(const Place& place, double distance) {
  return lambert_irradiance(place.lamp(distance), place.point(distance), {0, 1, 0}) / pi;
}

const std::vector<double> distances{0x1p-3, 0x1p-7, 0x1p-10, 0x1p-13, 0x1p-17, 0x1p-20};  // 0.1 m to 1e-6 m

// Failure: noise and bright dots along every edge that a lamp touches. By solid angle there is none: X <= omega / pi,
// and X = (omega / pi) cos with cos uniform leaves a relative variance of 1/3 in the limit. MIS bounds X as well.
TEST(NearLamp, BySolidAngleVarianceIsBounded) {
  const double level = sidak(alpha, 2.0 * std::size(places) * static_cast<double>(distances.size()));
  for (const Place& place : places)
    for (const double d : distances) {
      const Samples s = samples_at(floor_and_lamp(place, d, LightSampling::solid_angle), place, d, 2500 * effort);
      EXPECT_GT(likelihood(s.mean, exact(place, d)), level)
          << place.name << ", " << d << " m: " << s.mean.mean << " +- " << s.mean.error << ", exactly "
          << exact(place, d);
      EXPECT_LE(s.largest, place.solid_angle / pi * 1.001) << place.name << ", " << d << " m";
      EXPECT_LT(s.relative_variance(), 0.5) << place.name << ", " << d << " m";

      const Samples m = samples_at(floor_and_lamp(place, d, LightSampling::area, Mis::on), place, d, 2500 * effort);
      EXPECT_GT(likelihood(m.mean, exact(place, d)), level)
          << "MIS, " << place.name << ", " << d << " m: " << m.mean.mean << " +- " << m.mean.error;
      EXPECT_LE(m.largest, 2.001) << "MIS, " << place.name << ", " << d << " m";
    }
}

// Failure: the same, shown. By area the variance grows a hundredfold for a tenth of the distance; the picture of a
// corner, which holds all distances down to 0, has no finite one.
TEST(NearLamp, ByAreaVarianceGrowsWithTheInverseSquareOfTheDistance) {
  for (const Place& place : places)
    for (const double d : {0x1p-4, 0x1p-5, 0x1p-6}) {
      const Samples s = samples_at(floor_and_lamp(place, d, LightSampling::area), place, d, 50000 * effort);
      const double expected = place.area_second_moment / (d * d);
      // The lamp is not a half space, and the mean square has noise of its own.
      EXPECT_NEAR(s.second / expected, 1, effort > 1 ? 0.2 : 0.5) << place.name << ", " << d << " m: " << s.second;
      EXPECT_GT(likelihood(s.mean, exact(place, d)), sidak(alpha, 9))
          << place.name << ", " << d << " m: " << s.mean.mean << " +- " << s.mean.error << ", exactly "
          << exact(place, d);
    }
}

// Failure: at 1e-6 m a picture by area is not noisy but dark, since the few points of the lamp that matter are not
// found at all, and its error estimate is content. One of n = 20000 points lies within 100 d of the nearest with
// probability n pi 1e4 d^2 = 6e-4; the others bring a ten-thousandth of the light.
TEST(NearLamp, ByAreaLightIsMissedAtAMicrometre) {
  const Place& place = places[0];
  const double d = 0x1p-20;
  const Samples area = samples_at(floor_and_lamp(place, d, LightSampling::area), place, d, 2500 * effort);
  EXPECT_LT(area.mean.mean, 0.01 * exact(place, d));
  const Samples solid = samples_at(floor_and_lamp(place, d, LightSampling::solid_angle), place, d, 2500 * effort);
  EXPECT_NEAR(solid.mean.mean, exact(place, d), 0.05);
}

// Failure: an image of the floor under a touching lamp with values that are no numbers, where point and lamp coincide.
TEST(NearLamp, AtTheTouchingEdgeItselfSamplesAreFinite) {
  for (const LightSampling sampling : {LightSampling::area, LightSampling::solid_angle})
    for (const Mis mis : {Mis::off, Mis::on})
      for (const Place& place : places) {
        const CompiledScene scene = floor_and_lamp(place, 0x1p-30, sampling, mis);
        for (const double x : {0.0, 0x1p-24, 0x1p-30, -0x1p-24}) {
          const Samples s = samples_along(scene, {x, 0x1p-32, 0}, {0, -1, 0}, 500);
          EXPECT_TRUE(s.smallest >= 0 && std::isfinite(s.second)) << place.name << ", x = " << x;
        }
      }
}

// Failure: the default has several times the error of settings that nobody knows to choose. A ball 1 cm below a lamp,
// which is a rectangle, a rhomboid, a triangle, five corners or a mesh of two triangles. Errors are means over 4 seeds.
TEST(NearLamp, TheDefaultIsAsGoodAsTheBestChoice) {
  const auto raised = [](std::vector<dvec3> v) {
    for (dvec3& p : v) p.y = 2.9;
    return v;
  };
  const std::vector<dvec3> square = square_lamp(1, 2.9).vertices,
                           rhomboid = raised({{-0.8, 0, -0.5}, {0.3, 0, -0.5}, {0.8, 0, 0.5}, {-0.3, 0, 0.5}}),
                           triangle = raised({{-0.6, 0, -0.5}, {0.7, 0, -0.4}, {0, 0, 0.7}}),
                           corners =
                               raised({{-0.6, 0, -0.5}, {0.7, 0, -0.4}, {0.6, 0, 0.4}, {0, 0, 0.7}, {-0.6, 0, 0.3}});
  for (const auto& [name, outline] : {std::pair{"square", square},
                                      {"rhomboid", rhomboid},
                                      {"triangle", triangle},
                                      {"corners", corners},
                                      {"mesh", square}}) {
    Scene scene;
    scene.materials = {lambertian("white", dvec3{0.7}), light("lamp", dvec3{5})};
    scene.polygons = box({-2, 0, -2}, {2, 3, 2}, "white");
    if (std::string_view(name) == "mesh") {
      scene.meshes = {{.name = "lamp", .material = "lamp", .vertices = outline, .triangles = {{0, 1, 2}, {0, 2, 3}}}};
    } else {
      scene.polygons.push_back({"lamp", "lamp", outline});
    }
    scene.spheres = {{"ball", "white", {0, 2.59, 0}, 0.3}};
    scene.camera = {{0, 1.5, 1.9}, {0, 2.2, 0}, {0, 1, 0}, 70};
    scene.image = {32, 32};
    const auto error = [&](LightSampling sampling, Mis mis) {
      double sum = 0;
      for (int seed = 1; seed <= 4; ++seed) {
        scene.render.seed = seed, scene.render.light_sampling = sampling, scene.render.mis = mis;
        sum += relmse_estimate(render(compile(scene), 4 * effort));
      }
      return sum;
    };
    const double chosen = error(LightSampling::automatic, Mis::off), by_area = error(LightSampling::area, Mis::off);
    for (const Mis mis : {Mis::off, Mis::on})
      for (const LightSampling sampling : {LightSampling::area, LightSampling::solid_angle})
        EXPECT_LT(chosen, 1.3 * error(sampling, mis))
            << name << ", light_sampling " << static_cast<int>(sampling) << ", mis " << static_cast<int>(mis);
    EXPECT_LT(chosen, 0.5 * by_area) << name << ": the scene is too easy to tell";
  }
}

}  // namespace
