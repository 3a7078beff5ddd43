#include "material/lobes.h"

#include <gtest/gtest.h>

#include <random>
#include <vector>

#include "kernel/entry/kernels.h"
#include "material/oren_nayar.h"
#include "scene/file/scene_file.h"

using namespace glimt;

namespace {

using V = Vec3<float>;

double to_double(float x) { return static_cast<double>(x); }

/// Unit vector at polar angle theta to the z axis.
V polar(double theta, double phi) {
  return {static_cast<float>(std::sin(theta) * std::cos(phi)), static_cast<float>(std::sin(theta) * std::sin(phi)),
          static_cast<float>(std::cos(theta))};
}

/// Oren and Nayar 1994, eq. 30, as printed, times pi / rho; the report's eq. 7 has sin(beta) for tan(beta).
double oren_nayar_transcribed(double sigma, double theta_r, double phi_r, double theta_i, double phi_i, bool report) {
  const double a = 1.0 - 0.5 * sigma * sigma / (sigma * sigma + 0.33);
  const double b = 0.45 * sigma * sigma / (sigma * sigma + 0.09);
  const double alpha = std::max(theta_r, theta_i), beta = std::min(theta_r, theta_i);
  return a + b * std::max(0.0, std::cos(phi_r - phi_i)) * std::sin(alpha) * (report ? std::sin(beta) : std::tan(beta));
}

/// The scene's compiled A and B.
OrenNayarFactors<float> compiled_model(double sigma, bool report) {
  Scene scene;
  scene.materials = {Material{.name = "clay", .type = "oren-nayar"}
                         .with(OrenNayar::roughness, sigma)
                         .with(OrenNayar::formula, report ? OrenNayarFormula::report : OrenNayarFormula::published)};
  scene.spheres = {{"", "clay", {0, 0, 0}, 1}};
  const CompiledScene compiled = compile(scene);
  if (compiled.lobes == lobe_bit<LambertianLobe>) return {1, 0, false};
  const auto value = [&](int c) { return compiled.surfaces[lobe_column(first_column<OrenNayarLobe>() + c)][0]; };
  return {value(OrenNayarLobe::a), value(OrenNayarLobe::b), value(OrenNayarLobe::report) > 0.5f};
}

// The kernel computes no angle; the error of s = wi.wo - cos cos is a few 2^-24, over the larger cosine.
TEST(OrenNayar, IsTheFormulaInAngles) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> angle(0, std::numbers::pi / 2 - 1e-3), turn(0, 2 * std::numbers::pi);
  for (const bool report : {false, true})
    for (const double sigma : {0.0, 0.1, 0.3, 0.6, 0.8, 1.0, std::numbers::pi / 2}) {
      const OrenNayarFactors<float> model = compiled_model(sigma, report);
      for (int i = 0; i < 20000; ++i) {
        const double theta_i = angle(random), theta_o = angle(random), phi_i = turn(random), phi_o = turn(random);
        const V wi = polar(theta_i, phi_i), wo = polar(theta_o, phi_o);
        const double expected = oren_nayar_transcribed(sigma, theta_o, phi_o, theta_i, phi_i, report);
        const double bound = 1e-6 / (report ? 1 : std::cos(std::min(theta_i, theta_o)));
        ASSERT_NEAR(to_double(oren_nayar_factor(model, wi, wo, wi.z, wo.z)), expected, bound + 2e-7)
            << "sigma " << sigma << ", theta_i " << theta_i << ", theta_o " << theta_o << ", phi " << phi_i - phi_o
            << (report ? ", report" : ", published");
        // Helmholtz: light may run both ways.
        ASSERT_EQ(oren_nayar_factor(model, wi, wo, wi.z, wo.z), oren_nayar_factor(model, wo, wi, wo.z, wi.z));
      }
    }
}

// Both directions at 60 degrees on the same side, sigma^2 = 0.33: A = 3/4, B = 0.45 * 0.33 / 0.42; sin(60) tan(60) =
// 3/2 and sin^2(60) = 3/4.
TEST(OrenNayar, ValuesByHand) {
  const V w = polar(std::numbers::pi / 3, 1);
  const double b = 0.45 * 0.33 / 0.42;
  const double sigma = std::sqrt(0.33);
  EXPECT_NEAR(to_double(oren_nayar_factor(compiled_model(sigma, false), w, w, w.z, w.z)), 0.75 + b * 1.5, 2e-6);
  EXPECT_NEAR(to_double(oren_nayar_factor(compiled_model(sigma, true), w, w, w.z, w.z)), 0.75 + b * 0.75, 2e-6);
}

TEST(OrenNayar, GrazingDirectionsStayFinite) {
  const OrenNayarFactors<float> model = compiled_model(std::numbers::pi / 2, false);
  for (const float cos : {0.0f, 1e-30f, 1e-8f, 1e-6f, 1e-3f}) {
    const V w{1, 0, cos};
    const float factor = oren_nayar_factor(model, w, w, cos, cos);
    EXPECT_TRUE(std::isfinite(factor)) << cos;
    EXPECT_GE(factor, 0) << cos;
  }
}

std::vector<float> picture(Scene scene) {
  scene.image = {40, 30};
  const CompiledScene compiled = compile(scene);
  const PathBlock block{0, 0, 40, 30, 0, 4};
  std::vector<float> rgb(3 * static_cast<std::size_t>(block.paths()));
  trace(compiled, block, Lanes::native, rgb.data());
  return rgb;
}

TEST(OrenNayar, WithoutRoughnessIsLambertianBitForBit) {
  Scene scene = read_scene(GLIMT_SCENES "/report.toml");
  Material& clay = *std::ranges::find(scene.materials, "clay", &Material::name);
  clay.set(OrenNayar::roughness, 0.6);
  const std::vector<float> rough = picture(scene);
  clay.set(OrenNayar::roughness, 0);
  const std::vector<float> flat = picture(scene);
  clay.type = "lambertian";
  EXPECT_EQ(flat, picture(scene));
  EXPECT_NE(rough, flat);
  // Beside another rough material, the factors of this one are computed, and are 1.
  scene.materials.push_back(Material{.name = "other", .type = "oren-nayar"}.with(OrenNayar::roughness, 0.5));
  scene.spheres.push_back({"other", "other", {3, -4.5, 0}, 0.5});
  const std::vector<float> lambertian_beside = picture(scene);
  std::ranges::find(scene.materials, "clay", &Material::name)->type = "oren-nayar";
  EXPECT_EQ(picture(scene), lambertian_beside);
}

Dielectric<float> fresnel_at(float cos, float eta, bool schlick) { return fresnel(cos, eta, 1 / eta, schlick); }

Dielectric<float> exact(double cos, double eta) {
  return fresnel_at(static_cast<float>(cos), static_cast<float>(eta), false);
}

const std::vector<double> indices{0.4, 1 / 1.5, 0.9, 1.0, 1.1, 1.33, 1.5, 2.4, 10.0};

// At normal incidence both polarisations reflect ((n - 1) / (n + 1))^2; for n = 1.5 that is 0.04.
TEST(FresnelShare, NormalIncidence) {
  for (const double n : indices) {
    EXPECT_NEAR(to_double(exact(1, n).reflected), std::pow((n - 1) / (n + 1), 2), 3e-7) << n;
    EXPECT_NEAR(to_double(fresnel_at(1.0f, static_cast<float>(n), true).reflected), std::pow((n - 1) / (n + 1), 2),
                3e-7)
        << n;
    EXPECT_NEAR(to_double(exact(1, n).cos_t), 1, 1e-7) << n;
  }
}

TEST(FresnelShare, GrazingIncidenceReflectsAll) {
  for (const double n : indices) {
    if (n == 1.0) continue;  // no surface, but in the limit
    for (const bool schlick : {false, true}) {
      EXPECT_NEAR(to_double(fresnel_at(1e-7f, static_cast<float>(n), schlick).reflected), 1, 2e-5) << n;
      EXPECT_NEAR(to_double(fresnel_at(0.0f, static_cast<float>(n), schlick).reflected), 1, 1e-6) << n;
    }
  }
}

// Past sin(theta) = eta nothing is refracted; just before it, something is.
TEST(FresnelShare, TotalReflectionBeginsAtTheCriticalAngle) {
  for (const double n : {0.4, 1 / 1.5, 0.9}) {
    const double critical = std::asin(n);
    for (const bool schlick : {false, true}) {
      const auto at = [&](double theta) {
        return fresnel_at(static_cast<float>(std::cos(theta)), static_cast<float>(n), schlick);
      };
      EXPECT_EQ(at(critical + 1e-3).reflected, 1.0f) << n;
      EXPECT_EQ(at(critical + 1e-3).cos_t, 0.0f) << n;
      EXPECT_LT(at(critical - 1e-3).reflected, 1.0f) << n;
      EXPECT_GT(at(critical - 1e-3).cos_t, 0.0f) << n;
      EXPECT_EQ(at(std::numbers::pi / 2 - 1e-3).reflected, 1.0f) << n;
    }
  }
}

// Fresnel's equations in angles: Rs = (sin(i - t) / sin(i + t))^2, Rp = (tan(i - t) / tan(i + t))^2.
TEST(FresnelShare, IsFresnelInAngles) {
  for (const double n : indices) {
    if (n == 1.0) continue;
    for (double i = 0.01; i < 1.56; i += 0.01) {
      if (std::sin(i) / n >= 0.999) continue;  // near the critical angle the root of a difference loses digits
      const double t = std::asin(std::sin(i) / n);
      const double s = std::sin(i - t) / std::sin(i + t), p = std::tan(i - t) / std::tan(i + t);
      EXPECT_NEAR(to_double(exact(std::cos(i), n).reflected), (s * s + p * p) / 2, 2e-5)
          << "n " << n << ", angle " << i;
    }
  }
}

// Stokes: a surface reflects the same share from both sides, at angles that belong together by Snell's law.
TEST(FresnelShare, IsTheSameFromBothSides) {
  for (const bool schlick : {false, true})
    for (const double n : {1.1, 1.33, 1.5, 2.4})
      for (double cos = 0.02; cos <= 1; cos += 0.01) {
        const auto outside = fresnel_at(static_cast<float>(cos), static_cast<float>(n), schlick);
        const auto inside = fresnel_at(outside.cos_t, static_cast<float>(1 / n), schlick);
        EXPECT_NEAR(to_double(inside.reflected), to_double(outside.reflected), 3e-5) << "n " << n << ", cos " << cos;
        EXPECT_NEAR(to_double(inside.cos_t), cos, 3e-5);
      }
}

// Schlick 1994: R0 + (1 - R0) (1 - cos)^5, the cosine on the thinner side. n = 1.5 at 60 degrees: 0.04 + 0.96 / 32 =
// 0.07. At the same surface from inside, the angle that belongs to it is asin(sin(60) / 1.5).
TEST(FresnelShare, SchlickByHand) {
  EXPECT_NEAR(to_double(fresnel_at(0.5f, 1.5f, true).reflected), 0.07, 1e-6);
  const double cos_inside = std::sqrt(1 - 0.75 / 2.25);
  EXPECT_NEAR(to_double(fresnel_at(static_cast<float>(cos_inside), 1 / 1.5f, true).reflected), 0.07, 1e-6);
}

// The tangential part of a direction is kept by reflection and divided by the relative index by refraction (Snell).
TEST(Directions, MirrorAndSnell) {
  std::mt19937 random(2);
  std::normal_distribution<float> gauss;
  for (int i = 0; i < 20000; ++i) {
    const V n = normalize(V{gauss(random), gauss(random), gauss(random)});
    V d = normalize(V{gauss(random), gauss(random), gauss(random)});
    if (dot(d, n) > 0) d = d * -1.0f;
    const float cos = -dot(d, n);
    const auto tangent = [&](const V& w) { return w - n * dot(w, n); };
    const auto distance = [](const V& a, const V& b) { return std::sqrt(to_double(dot(a - b, a - b))); };
    const V mirrored = glimt::mirrored(d * -1.0f, n, cos);
    EXPECT_NEAR(to_double(dot(mirrored, mirrored)), 1, 2e-6);
    EXPECT_NEAR(to_double(dot(mirrored, n)), to_double(cos), 1e-6);
    EXPECT_LT(distance(tangent(mirrored), tangent(d)), 1e-6);
    const float eta = static_cast<float>(indices[static_cast<std::size_t>(i) % indices.size()]);
    const Dielectric<float> interface = fresnel_at(cos, eta, false);
    if (interface.reflected == 1.0f) continue;
    const V refracted = refract(d, n, cos, interface.cos_t, 1 / eta);
    // Near the critical angle and for thin media, rounding of the normal's length grows with 1 / eta.
    EXPECT_NEAR(to_double(dot(refracted, refracted)), 1, 4e-6) << "eta " << eta << ", cos " << cos;
    EXPECT_LT(distance(tangent(refracted) * eta, tangent(d)), 2e-6 * std::max(1.0, to_double(eta)));
    EXPECT_LT(dot(refracted, n), 0.0f);
  }
}

}  // namespace
