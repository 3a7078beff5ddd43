#include <gtest/gtest.h>

#include <numbers>

#include "given_rays.h"
#include "material/lobes.h"

using namespace glimt;

// Smooth glass: how much of the light it reflects, and what refraction does to radiance. Fresnel's equations in angles,
// the critical angle and Snell's law of directions are in unit/kernel/bsdf_test.cpp.
namespace {

constexpr double alpha = 1e-4;  ///< probability of a false alarm, for each statistical test

/// Reflected share by Fresnel's equations, for unpolarised light; 1 past the critical angle.
double fresnel_share(double angle, double n) {
  const double sin_t = std::sin(angle) / n;
  if (sin_t >= 1) return 1;
  const double c = std::cos(angle), t = std::sqrt(1 - sin_t * sin_t);
  const double s = (c - n * t) / (c + n * t), p = (n * c - t) / (n * c + t);
  return (s * s + p * p) / 2;
}

/// Schlick 1994, with the angle on the thinner side.
double schlick_share(double angle, double n) {
  const double sin_t = std::sin(angle) / n;
  if (sin_t >= 1) return 1;
  const double c = n < 1 ? std::sqrt(1 - sin_t * sin_t) : std::cos(angle), r0 = std::pow((n - 1) / (n + 1), 2);
  return r0 + (1 - r0) * std::pow(1 - c, 5);
}

constexpr double glow = 3;  ///< green radiance of the walls

/// A glass sphere of radius 1 in a box that glows and reflects nothing; paths meet two surfaces at most.
CompiledScene two_surfaces(double n, Fresnel fresnel, bool core) {
  Scene scene;
  scene.materials = {lambertian("wall", dvec3{0}, {1, glow, 5}), glass("glass", n, fresnel),
                     lambertian("core", dvec3{0}, {2, glow, 1})};
  scene.polygons = box({-4, -4, -4}, {4, 4, 4}, "wall");
  scene.spheres = {{"ball", "glass", {0, 0, 0}, 1}};
  if (core) {
    scene.spheres.push_back({"core", "core", {0, 0, 0}, 0.9999});
    for (Material& m : scene.materials)
      if (m.name == "wall") m.set(Matt::emission, dvec3{0});
  }
  scene.camera = {{0, 0, 3}, {0, 0, 0}, {0, 1, 0}, 50};
  scene.render.sampler = Sampler::independent;
  scene.render.max_depth = 2;
  return compile(scene);
}

/// Paths that end with light, and the one radiance that they have.
struct Lit {
  double share = 0, radiance = 0;
};

Lit trace_at(const CompiledScene& scene, const dvec3& from, const dvec3& to, int paths, Lanes lanes) {
  Lit lit;
  for (int i = 0; i < paths; ++i) {
    const double v = trace_green(scene, from, normalize(to - from), i, 0, lanes);
    if (v == 0) continue;
    if (lit.radiance == 0) lit.radiance = v;
    EXPECT_EQ(v, lit.radiance) << "path of pixel " << i;
    lit.share += 1.0 / paths;
  }
  return lit;
}

/// How likely a share of `paths` is, by the normal approximation of the binomial law; certain where it is 0 or 1.
double share_likelihood(double share, double exact, int paths) {
  const double variance = exact * (1 - exact) / paths;
  if (variance < 1e-12) return std::abs(share - exact) < 1e-6 ? 1 : 0;
  return normal_tails((share - exact) / std::sqrt(variance));
}

const std::vector<double> degrees{0, 20, 41, 43, 60, 75, 85};

// From outside, what is reflected meets a wall next, and is seen; what is refracted meets the sphere again, and ends.
// From inside it is the other way round. A binomial test for each angle and index.
TEST(Glass, ReflectsFresnelsShare) {
  const int paths = 4000 * effort;
  const std::vector<double> indices{0.75, 1.2, 1.5, 2.4};
  const double level = sidak(alpha, 4.0 * static_cast<double>(degrees.size() * indices.size()));
  for (const double n : indices)
    for (const Fresnel fresnel : {Fresnel::exact, Fresnel::schlick}) {
      const CompiledScene scene = two_surfaces(n, fresnel, false);
      const auto share = fresnel == Fresnel::exact ? fresnel_share : schlick_share;
      for (const double d : degrees) {
        const double angle = d * std::numbers::pi / 180;
        const dvec3 point{0, 0, 1};
        const Lit outside =
            trace_at(scene, point + dvec3{std::sin(angle), 0, std::cos(angle)}, point, paths, Lanes::scalar);
        EXPECT_GT(share_likelihood(outside.share, share(angle, n), paths), level)
            << "n " << n << ", " << d << " degrees outside: " << outside.share << ", not " << share(angle, n);
        // Far enough from the surface that the ray's own start is inside.
        const dvec3 start = point - 0.1 * dvec3{std::sin(angle), 0, std::cos(angle)};
        const Lit inside = trace_at(scene, start, point, paths, Lanes::scalar);
        EXPECT_GT(share_likelihood(inside.share, 1 - share(angle, 1 / n), paths), level)
            << "n " << n << ", " << d << " degrees inside: " << inside.share << ", not " << 1 - share(angle, 1 / n);
        // Radiance over n^2 is kept.
        if (outside.share > 0) {
          EXPECT_NEAR(outside.radiance, glow, 1e-5 * glow);
        }
        if (inside.share > 0) {
          EXPECT_NEAR(inside.radiance, n * n * glow, 1e-5 * n * n * glow);
        }
      }
    }
}

// Reciprocity of refraction is that of f / n^2: from outside a glowing core is seen through the surface with the share
// T and the radiance E / n^2, from inside along the same way a glowing wall with the same share and n^2 E.
TEST(Glass, RefractionIsReciprocalButForTheSquareOfTheIndex) {
  const int paths = 4000 * effort;
  const double level = sidak(alpha, 2.0 * static_cast<double>(degrees.size()));
  for (const double n : {1.3, 1.7}) {
    const CompiledScene with_core = two_surfaces(n, Fresnel::exact, true);
    const CompiledScene empty = two_surfaces(n, Fresnel::exact, false);
    for (const double d : degrees) {
      const double angle = d * std::numbers::pi / 180, behind = std::asin(std::sin(angle) / n);
      const dvec3 point{0, 0, 1};
      const Lit in =
          trace_at(with_core, point + dvec3{std::sin(angle), 0, std::cos(angle)}, point, paths, Lanes::scalar);
      const Lit out =
          trace_at(empty, point - 0.1 * dvec3{std::sin(behind), 0, std::cos(behind)}, point, paths, Lanes::scalar);
      const double both = (in.share + out.share) / 2, error = std::sqrt(2 * both * (1 - both) / paths);
      EXPECT_GT(normal_tails((in.share - out.share) / std::max(error, 1e-9)), level)
          << "n " << n << ", " << d << " degrees: " << in.share << " in, " << out.share << " out";
      EXPECT_NEAR(in.radiance * n * n, out.radiance / (n * n), 1e-5 * glow);
    }
  }
}

// Where reflected and refracted ray are at right angles, tan(angle) = n, light in the plane of incidence is not
// reflected: half of the perpendicular part is left, (cos^2 - sin^2)^2 of it (Brewster 1815).
TEST(FresnelShare, ParallelPartVanishesAtBrewstersAngle) {
  for (const double n : {0.5, 1 / 1.5, 1.1, 1.5, 2.4}) {
    const double angle = std::atan(n), c2 = std::pow(std::cos(angle), 2);
    const auto at = [&](double a) {
      const auto eta = static_cast<float>(n);
      return static_cast<double>(fresnel<float>(static_cast<float>(std::cos(a)), eta, 1 / eta, false).reflected);
    };
    EXPECT_NEAR(at(angle), std::pow(2 * c2 - 1, 2) / 2, 2e-6) << n;
    // The parallel part is the unpolarised share less half the perpendicular one, and is 0 nowhere else near.
    const auto parallel = [&](double a) {
      const double t = std::asin(std::sin(a) / n);
      return 2 * at(a) - std::pow(std::sin(a - t) / std::sin(a + t), 2);
    };
    EXPECT_NEAR(parallel(angle), 0, 4e-6) << n;
    for (const double away : {-0.1, 0.1})
      if (std::sin(angle + away) / n < 1) {
        EXPECT_GT(parallel(angle + away), 1e-5) << n << " " << away;
      }
  }
}

}  // namespace
