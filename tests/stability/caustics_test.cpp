// Caustics where their estimators come to an end.
#include <gtest/gtest.h>

#include "film/statistics.h"
#include "pictures.h"
#include "scene_parts.h"

using namespace glimt;

namespace {

/// The floor under a glass ball and a lamp of that edge, of the same power whatever its size. Caustics alone, the ball
/// out of sight.
Scene ball_on_floor(double edge) {
  Scene scene;
  scene.materials = {lambertian("white", dvec3{0.7}), light("lamp", dvec3{4 / (edge * edge)}), glass("glass", 1.5)};
  scene.polygons = box({-2, -1, -2}, {2, 1, 2}, "white");
  scene.polygons.push_back(square_lamp(edge, 0.95));
  scene.spheres = {{"ball", "glass", {0, 0.3, 0}, 0.4}};
  scene.camera = {{0, -0.2, 1.9}, {0, -1, 0.2}, {0, 1, 0}, 40};
  scene.image = {48, 48};
  scene.render.caustics = Caustics::only;
  return scene;
}

/// The same, seen from inside a bubble of nothing: the first surface is glass, so all that light paths could do is left
/// to connections. Chains that connections cannot make, longer ones, are cut off.
Scene ball_from_bubble(double edge) {
  Scene scene = ball_on_floor(edge);
  scene.materials.push_back(glass("air", 1));
  scene.spheres.push_back({"bubble", "air", scene.camera.eye, 0.05});
  scene.render.max_depth = 5;
  return scene;
}

/// Variance of a sample of a pixel over the square of the picture's mean, as the halves of the film tell it: its mean
/// over pixels, and what 99 of 100 pixels stay below; and the picture's mean.
struct Noise {
  double variance = 0, usual = 0;
  Estimate mean;
};

Noise noise(Scene scene, int samples = 4 * effort) {
  constexpr int seeds = 32;
  Noise noise;
  std::vector<double> means;
  for (int seed = 1; seed <= seeds; ++seed) {
    ++scene.render.seed;
    const Film film = render(compile(scene), samples);
    means.push_back(mean(film.mean()));
    std::vector<double> variances;
    for (const float e : film.standard_error().rgb)
      variances.push_back(static_cast<double>(e) * static_cast<double>(e) * samples);
    std::ranges::sort(variances);
    for (const double v : variances) noise.variance += v / static_cast<double>(variances.size());
    noise.usual += variances[variances.size() * 99 / 100];
  }
  noise.mean = estimate(means);
  for (double* v : {&noise.variance, &noise.usual}) *v /= seeds * noise.mean.mean * noise.mean.mean;
  return noise;
}

// Failure: chance finds a lamp of a millimetre once in 10^7 paths, if ever. Light paths do not look for it.
TEST(CausticsOfALamp, HaveNoMoreNoiseHoweverSmallItIs) {
  const Noise large = noise(ball_on_floor(1));
  for (const double edge : {0.3, 0.1, 0.01, 1e-3}) {
    const Noise small = noise(ball_on_floor(edge));
    EXPECT_GT(small.mean.mean, 0.3 * large.mean.mean) << edge;
    EXPECT_LT(small.variance, 4 * large.variance) << edge << " m";
  }
  Scene scene = ball_on_floor(1e-3);
  scene.render.light_paths = 0;
  EXPECT_LT(noise(scene).mean.mean, 0.3 * large.mean.mean) << "chance loses the caustic";
}

// Failure: where a ball touches the floor the light is squeezed into nothing. Both estimators go on agreeing
// (probability of a false alarm 1e-4).
TEST(CausticsOfALampLong, AreRightWhereTheBallTouchesTheFloor) {
  for (const double gap : {1e-2, 1e-4, 0.0, -1e-3}) {
    Scene scene = ball_on_floor(1);
    scene.spheres[0].center.y = -0.6 + gap;
    scene.render.light_paths = 0.2;
    const Noise traced = noise(scene, 4 * effort);
    scene.render.light_paths = 0;
    scene.render.seed = 1000;
    const Noise chance = noise(scene, 16 * effort);
    EXPECT_GT(likelihood(traced.mean, chance.mean), sidak(1e-4, 4))
        << gap << " m: " << traced.mean.mean << " +- " << traced.mean.error << " against " << chance.mean.mean << " +- "
        << chance.mean.error;
  }
}

// Failure: what a light path sends through the pinhole grows as 1 / distance^2. Its share falls as fast and chance
// takes over, so near the eye the picture has the noise of chance and no more.
TEST(CausticsOfALamp, AreNoWorseThanByChanceCloseToTheEye) {
  for (const double height : {0.1, 1e-2, 1e-3, 1e-5}) {
    Scene scene = ball_on_floor(1);
    scene.camera = {{0.3, -1 + height, 0.3}, {0.3, -1, 0.3}, {1, 0, 0}, 60};
    const Noise shared = noise(scene, 4 * effort);
    scene.render.light_paths = 0;
    const Noise chance = noise(scene, 4 * effort);
    EXPECT_LT(shared.variance, 2 * chance.variance) << height << " m";
    EXPECT_GT(likelihood(shared.mean, chance.mean), sidak(1e-4, 4)) << height << " m";
  }
}

// Failure: as above. Connections meet every lamp. What they bring grows as 1 / sqrt(distance) towards a fold, the edge
// of a caustic, up to what chance would bring: its variance grows with the logarithm of the lamp's size, by samples so
// rare that 99 of 100 pixels do not know of them.
TEST(CausticsThroughGlassLong, HaveHardlyMoreNoiseHoweverSmallTheLampIs) {
  const Noise large = noise(ball_from_bubble(0.1));
  for (const double edge : {0.03, 0.01, 1e-3, 1e-4}) {
    const Noise small = noise(ball_from_bubble(edge));
    EXPECT_NEAR(small.mean.mean / large.mean.mean, 1, 0.2) << edge << " m";
    EXPECT_LT(small.usual, 2 * large.usual) << edge << " m";
  }
  Scene scene = ball_from_bubble(1e-3);
  scene.render.sphere_connections = SphereConnections::off;
  EXPECT_LT(noise(scene).mean.mean, 0.3 * large.mean.mean) << "chance loses the caustic";
}

// Failure: connections to points that nearly touch the sphere lose their digits, and the tubes of rays there are next
// to nothing. Both estimators go on agreeing (probability of a false alarm 1e-4), and connections have no more noise.
TEST(CausticsThroughGlassLong, AreRightWhereTheBallTouchesTheFloor) {
  for (const double gap : {1e-2, 1e-4, 1e-6, 0.0, -1e-3}) {
    Scene scene = ball_from_bubble(1);
    scene.spheres[0].center.y = -0.6 + gap;
    const Noise connected = noise(scene, 4 * effort);
    scene.render.sphere_connections = SphereConnections::off;
    scene.render.seed = 1000;
    const Noise chance = noise(scene, 16 * effort);
    EXPECT_GT(likelihood(connected.mean, chance.mean), sidak(1e-4, 5))
        << gap << " m: " << connected.mean.mean << " +- " << connected.mean.error << " against " << chance.mean.mean
        << " +- " << chance.mean.error;
  }
}

}  // namespace
