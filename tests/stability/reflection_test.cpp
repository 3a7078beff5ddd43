// Matt surfaces at grazing angles and at the ends of their parameters.
#include <gtest/gtest.h>

#include "pictures.h"
#include "samples.h"

using namespace glimt;

namespace {

constexpr double alpha = 1e-4;  ///< of a false alarm, for each test
constexpr double pi = std::numbers::pi;

Material rough(const std::string& type, double roughness, OrenNayarFormula formula = OrenNayarFormula::published) {
  Material m = oren_nayar("rough", roughness, dvec3{1}, formula).with(Eon::roughness, roughness);
  m.type = type;
  return m;
}

/// A rough floor of reflectance 1 under walls that glow with 1 and reflect nothing: along a ray that meets the floor,
/// the floor's directional albedo is seen.
CompiledScene floor_in_the_glow(const Material& material) {
  Scene scene;
  scene.materials = {material, lambertian("glow", dvec3{0}, dvec3{1})};
  scene.polygons = box({-2, 0, -2}, {2, 3, 2}, "glow");
  scene.polygons[0].material = "rough";
  scene.camera = {{0, 1, 1.9}, {0, 0, 0}, {0, 1, 0}, 60};
  scene.image = {32, 32};
  scene.render.sampler = Sampler::independent;
  return compile(scene);
}

/// Oren and Nayar's directional albedo of reflectance 1 towards a direction at that cosine: the integral of A + B
/// max(0, cos phi) sin(alpha) tan(beta) or sin(beta) over the cosine-weighted hemisphere, / pi. Over phi, max(0, cos)
/// gives 2.
double oren_nayar_albedo(const Material& m, double cos_o) {
  const double s2 = m.get(OrenNayar::roughness) * m.get(OrenNayar::roughness), a = 1 - s2 / (2 * (s2 + 0.33)),
               b = 0.45 * s2 / (s2 + 0.09);
  const double sin_o = std::sqrt(1 - cos_o * cos_o);
  double sum = 0;
  constexpr int steps = 200000;
  for (int i = 0; i < steps; ++i) {
    // cos = x^2 puts points where the integrand is steep.
    const double x = (i + 0.5) / steps, cos = x * x, sin = std::sqrt(1 - cos * cos);
    const double tan = m.get(OrenNayar::formula) == OrenNayarFormula::report ? 1 : 1 / std::max(cos, cos_o);
    sum += sin * sin_o * tan * cos * 2 * x / steps;
  }
  return a + b * 2 / pi * sum;
}

const std::vector<double> angles{0, 45, 80, 89, 89.9, 89.99};  ///< degrees

Samples at_angle(const CompiledScene& scene, double degrees, int paths) {
  const double c = std::cos(degrees * pi / 180), s = std::sqrt(1 - c * c);
  return samples_along(scene, {-s * 0.5, c * 0.5, 0.1}, {s, -c, 0}, paths);
}

// Failure: tan(beta) grows without bound where both directions graze: infinities, or a floor brighter than its lamps.
// The published model does exceed 1, by A + B/2 - 1 <= 0.0152 at grazing (sigma 0.2); the estimator must not by more.
TEST(OrenNayar, HasItsAlbedoAtGrazingAngles) {
  for (const OrenNayarFormula formula : {OrenNayarFormula::published, OrenNayarFormula::report})
    for (const double roughness : {1e-3, 0.2, 1.0, pi / 2}) {
      const Material material = rough("oren-nayar", roughness, formula);
      const CompiledScene scene = floor_in_the_glow(material);
      for (const double angle : angles) {
        const double exact = oren_nayar_albedo(material, std::cos(angle * pi / 180));
        const Samples s = at_angle(scene, angle, 1000 * effort);
        EXPECT_GT(likelihood(s.mean, exact), sidak(alpha, 48))
            << "sigma " << roughness << ", " << angle << " degrees: " << s.mean.mean << " +- " << s.mean.error
            << ", exactly " << exact;
        EXPECT_LT(exact, 1.0152) << "sigma " << roughness << ", " << angle << " degrees";
      }
    }
}

// Failure: light is lost or made by roughness. EON of reflectance 1 reflects all, at every angle and roughness.
TEST(Eon, KeepsAllLightAtGrazingAngles) {
  for (const double roughness : {0.0, 1e-3, 0.5, 1.0}) {
    const CompiledScene scene = floor_in_the_glow(rough("eon", roughness));
    for (const double angle : angles) {
      const Samples s = at_angle(scene, angle, 1000 * effort);
      EXPECT_GT(likelihood(s.mean, 1), sidak(alpha, 24))
          << "roughness " << roughness << ", " << angle << " degrees: " << s.mean.mean << " +- " << s.mean.error;
    }
  }
}

// Failure: a step in the picture where a slider reaches its end.
TEST(Roughness, ZeroIsLambertianBitForBit) {
  const auto lambert = trace_all(floor_in_the_glow(rough("lambertian", 0)), 4, Lanes::native);
  for (const char* type : {"oren-nayar", "eon"})
    EXPECT_EQ(first_difference(trace_all(floor_in_the_glow(rough(type, 0)), 4, Lanes::native), lambert), -1);
}

/// A closed box of that reflectance whose whole ceiling is a lamp of radiance 3.
Scene under_a_bright_ceiling(double reflectance) {
  Scene scene;
  scene.materials = {lambertian("wall", dvec3{reflectance}), light("lamp", dvec3{3})};
  scene.polygons = box({-1, 0, -1}, {1, 1, 1}, "wall");
  scene.polygons[1].material = "lamp";
  scene.camera = {{0, 0.5, 0.9}, {0, 0.3, 0}, {0, 1, 0}, 80};
  scene.image = {32, 32};
  scene.render.sampler = Sampler::independent;
  return scene;
}

// Failure: energy made or lost by a bounce, which only a room that keeps all light shows in full. Followed backwards,
// every path from a wall of reflectance 1 goes on unweakened until it meets the ceiling, so L = 3 is seen everywhere.
// The ceiling touches the walls: by area the variance is infinite (NearLamp), so that is not among the estimators.
TEST(Reflectance, OneUnderALampThatIsTheWholeCeilingShowsItsRadianceEverywhere) {
  struct Case {
    LightSampling sampling;
    Mis mis;
    int samples;
  };
  const std::vector<Case> cases{{LightSampling::none, Mis::off, 8 * effort},
                                {LightSampling::solid_angle, Mis::off, 8 * effort},
                                {LightSampling::solid_angle, Mis::on, 8 * effort},
                                {LightSampling::area, Mis::on, 8 * effort}};
  for (const Case& c : cases) {
    Scene scene = under_a_bright_ceiling(1);
    scene.render.light_sampling = c.sampling;
    scene.render.mis = c.mis;
    const Series series = render_series(scene, 8, c.samples, 8);
    const double level = sidak(alpha, static_cast<double>(cases.size() * (series.size() + 1)));
    EXPECT_GT(likelihood(series.overall(), 3), level) << series.overall().mean << " +- " << series.overall().error;
    EXPECT_LT(series.overall().error, effort > 1 ? 0.005 : 0.02);
    for (std::size_t i = 0; i < series.size(); ++i)
      EXPECT_GT(likelihood(series.block(i), 3), level)
          << "block " << i / 3 << ": " << series.block(i).mean << " +- " << series.block(i).error;
  }
}

// Failure: what reflects nothing is not quite black. Only the ceiling is seen.
TEST(Reflectance, ZeroIsBlack) {
  for (const LightSampling sampling : {LightSampling::none, LightSampling::area, LightSampling::solid_angle}) {
    Scene scene = under_a_bright_ceiling(0);
    scene.render.light_sampling = sampling;
    CompiledScene compiled = compile(scene);
    compiled.lamp_edges.clear();  // where a sample sees some of both
    for (const float v : trace_all(compiled, 8, Lanes::native)) ASSERT_TRUE(v == 0 || v == 3) << v;
  }
}

// Failure: bright rooms are too dark, because long paths are cut off, or never get quiet. Walls that glow with 1 and
// reflect 0.99 show 1 / (1 - 0.99) = 100 everywhere (furnace.toml derives it). Roulette by throughput from
// the first hit on keeps every path's weight at 1, so the number of hits is geometric: relative variance 0.99.
TEST(Reflectance, NinetyNineHundredthsShowAHundredfold) {
  Scene scene = under_a_bright_ceiling(0);
  for (Polygon& wall : scene.polygons) wall.material = "wall";
  scene.materials[0] = lambertian("wall", dvec3{0.99}, dvec3{1});
  scene.render.roulette_depth = 0;
  scene.render.roulette_below = 1;
  const Series series = render_series(scene, 8, 8 * effort, 8);
  const double level = sidak(alpha, static_cast<double>(series.size() + 1));
  EXPECT_GT(likelihood(series.overall(), 100), level) << series.overall().mean << " +- " << series.overall().error;
  for (std::size_t i = 0; i < series.size(); ++i) EXPECT_GT(likelihood(series.block(i), 100), level) << i / 3;
  const Samples s = samples_along(compile(scene), scene.camera.eye, {0, -1, 0}, 500 * effort);
  EXPECT_NEAR(s.relative_variance(), 0.99, effort > 1 ? 0.25 : 0.6);
}

// Failure: constant roulette on bright walls. Of reflectance rho a path's weight grows by rho / 0.75 at each hit and
// its mean square by rho^2 / 0.75: from 0.866 on the variance is infinite. Below, in a box that glows with 1, a path of
// radiance X = 1 + S (rho / s) X', S = 1 with probability s, has E[X^2] = (1 + 2 rho E[X]) / (1 - rho^2 / s).
TEST(Reflectance, ConstantRouletteHasTheVarianceThatItsLimitSays) {
  Scene scene = under_a_bright_ceiling(0);
  for (Polygon& wall : scene.polygons) wall.material = "wall";
  scene.render.roulette = Roulette::constant;
  for (const double rho : {0.3, 0.5, 0.6}) {
    scene.materials[0] = lambertian("wall", dvec3{rho}, dvec3{1});
    const double mean = 1 / (1 - rho), square = (1 + 2 * rho * mean) / (1 - rho * rho / 0.75);
    const Samples s = samples_along(compile(scene), scene.camera.eye, {0, -1, 0}, 5000 * effort);
    EXPECT_NEAR(s.second / square, 1, effort > 1 ? 0.1 : 0.4) << rho;
    EXPECT_GT(likelihood(s.mean, mean), sidak(alpha, 3)) << rho;
  }
  // Beyond the limit no number of samples is enough: the largest of them holds much of the sum of squares.
  scene.materials[0] = lambertian("wall", dvec3{0.95}, dvec3{1});
  const int paths = 5000 * effort;
  const Samples s = samples_along(compile(scene), scene.camera.eye, {0, -1, 0}, paths);
  EXPECT_GT(s.largest * s.largest / (s.second * paths), 0.1);
  EXPECT_GT(s.relative_variance(), 20) << "by throughput it is below 1";
}

}  // namespace
