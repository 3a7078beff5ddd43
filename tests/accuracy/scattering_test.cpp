#include <gtest/gtest.h>

#include <iostream>

#include "accuracy/diffuse_models.h"
#include "given_rays.h"
#include "kernel/scattering/surfaces.h"
#include "pictures.h"
#include "scene/file/scene_file.h"

using namespace glimt;

// How diffuse surfaces scatter: energy, reciprocity and the light that a sphere shows. Glass has its own file.
namespace {

constexpr double alpha = 1e-4;  ///< probability of a false alarm, for each statistical test

using V = Vec3<float>;

V direction(double angle, double phi) {
  return {static_cast<float>(std::sin(angle) * std::cos(phi)), static_cast<float>(std::sin(angle) * std::sin(phi)),
          static_cast<float>(std::cos(angle))};
}

Material diffuse(const std::string& type, double roughness, const dvec3& reflectance,
                 OrenNayarFormula formula = OrenNayarFormula::published) {
  Material m = oren_nayar("model", roughness, reflectance, formula).with(Eon::roughness, std::min(roughness, 1.0));
  m.type = type;
  return m;
}

/// The kernel's BRDF of a material, times pi, of the green channel, at the normal z.
class KernelModel {
 public:
  explicit KernelModel(const Material& m) : compiled_(compile(ball(m))), surfaces_(compiled_) {
    at_.normal = {0, 0, 1};
    at_.front = true;
    at_.surface = 0;
    surfaces_.look_up_kind(at_);
  }
  float factor(const V& wi, const V& wo) const {
    return surfaces_.colour(at_).y * surfaces_.evaluate(at_, wi, wo, wi.z, wo.z).y;
  }
  double operator()(const Angles& w) const {
    return static_cast<double>(factor(direction(w.in, w.phi), direction(w.out, 0)));
  }

 private:
  static Scene ball(const Material& m) {
    Scene scene;
    scene.materials = {m};
    scene.spheres = {{"", m.name, {0, 0, 0}, 1}};
    return scene;
  }

  CompiledScene compiled_;
  Surfaces<float, Features{}> surfaces_;
  Interaction<float> at_{};
};

const std::vector<double> angles{0, 0.3, 0.7, 1.1, 1.4, 1.55};

// Light may run both ways; bit for bit, since no operation tells the directions apart.
TEST(Diffuse, IsReciprocal) {
  for (const char* type : {"lambertian", "oren-nayar", "eon"})
    for (const OrenNayarFormula formula : {OrenNayarFormula::published, OrenNayarFormula::report})
      for (const double roughness : {0.0, 0.1, 0.5, 1.0}) {
        const KernelModel model(diffuse(type, roughness, dvec3{0.8}, formula));
        for (const double in : angles)
          for (const double out : angles)
            for (const double phi : {0.0, 1.0, 2.0, 3.1}) {
              const V wi = direction(in, phi), wo = direction(out, 0);
              ASSERT_EQ(model.factor(wi, wo), model.factor(wo, wi))
                  << type << ", roughness " << roughness << ", angles " << in << ", " << out;
              ASSERT_GE(model.factor(wi, wo), 0.0f);
            }
      }
}

// No surface sends back more than it gets; EON with reflectance 1 sends back all. The midpoint rule with 400 x 400
// steps is within 2e-5 (against 200 x 200 steps).
TEST(Diffuse, LambertianAndEonKeepTheEnergy) {
  for (const double out : angles) {
    EXPECT_NEAR(albedo(KernelModel(diffuse("lambertian", 0, dvec3{0.8})), out), 0.8, 1e-6);
    for (const double roughness : {0.0, 0.2, 0.5, 1.0}) {
      const KernelModel white(diffuse("eon", roughness, dvec3{1}));
      EXPECT_NEAR(albedo(white, out), 1, 1e-4) << "roughness " << roughness << ", angle " << out;
      const KernelModel grey(diffuse("eon", roughness, dvec3{0.8}));
      const double exact = eon_albedo_model(out, roughness, 0.8);
      EXPECT_NEAR(albedo(grey, out), exact, 1e-4) << "roughness " << roughness << ", angle " << out;
      EXPECT_LT(exact, 0.8 + 1e-4);
    }
  }
}

// The published Oren-Nayar model gains energy at grazing angles for small roughness. In the limit of 90 degrees alpha
// is 90 degrees and beta the other angle, so the albedo is A + B (2 / pi) times the integral of tan sin cos = sin^2
// from 0 to pi / 2, which is A + B / 2: at most 1.0152, at sigma = 0.2; at 89 degrees it is 1.014. The report's form
// never gains.
TEST(Diffuse, PublishedOrenNayarGainsUpTo15PerMille) {
  double most = 0, at_sigma = 0, at_angle = 0;
  const std::vector<double> degrees{0, 30, 60, 75, 80, 85, 87, 88, 89, 89.5, 89.9, 89.99};
  std::cout << "directional albedo of published Oren-Nayar with reflectance 1, percent above 1\n sigma";
  for (const double d : degrees) std::cout << "\t" << d;
  for (const double sigma : {0.05, 0.1, 0.15, 0.2, 0.25, 0.3, 0.4, 0.6, 0.8, 1.0}) {
    std::cout << "\n " << sigma;
    const KernelModel published(diffuse("oren-nayar", sigma, dvec3{1}));
    const KernelModel report(diffuse("oren-nayar", sigma, dvec3{1}, OrenNayarFormula::report));
    for (const double d : degrees) {
      const double out = d * std::numbers::pi / 180, gain = albedo(published, out) - 1;
      std::cout << "\t" << std::round(gain * 1e4) / 100;
      if (gain > most) most = gain, at_sigma = sigma, at_angle = d;
      EXPECT_NEAR(1 + gain, albedo([&](const Angles& w) { return oren_nayar_model(w, sigma, false); }, out), 2e-4);
      EXPECT_LE(albedo(report, out), 1 + 1e-5) << "sigma " << sigma << ", " << d << " degrees";
    }
  }
  std::cout << "\nmost: " << 100 * most << " % at sigma " << at_sigma << ", " << at_angle << " degrees\n";
  const double s2 = 0.04, limit = 1 - 0.5 * s2 / (s2 + 0.33) + 0.45 * s2 / (s2 + 0.09) / 2;
  EXPECT_NEAR(1 + most, limit, 1e-4);
  EXPECT_EQ(at_sigma, 0.2);
  EXPECT_EQ(at_angle, degrees.back());
}

// A convex body in a closed box that glows with E and reflects nothing sees E all around, so it shows E times its
// directional albedo.
TEST(GlowingBoxAndSphere, ShowsTheDirectionalAlbedo) {
  struct Case {
    const char* name;
    Material material;
    std::function<double(double)> exact;
  };
  std::vector<Case> cases{{"lambertian", diffuse("lambertian", 0, {0.2, 0.6, 0.9}), [](double) { return 0.6; }}};
  for (const double sigma : {0.2, 0.6, 1.0})
    for (const bool report : {false, true})
      cases.push_back({report ? "oren-nayar, report" : "oren-nayar, published",
                       diffuse("oren-nayar", sigma, {0.2, 0.7, 0.9},
                               report ? OrenNayarFormula::report : OrenNayarFormula::published),
                       [=](double out) {
                         return 0.7 * albedo([&](const Angles& w) { return oren_nayar_model(w, sigma, report); }, out);
                       }});
  for (const double roughness : {0.3, 1.0})
    for (const double reflectance : {0.5, 1.0})
      cases.push_back({"eon", diffuse("eon", roughness, {0.2, reflectance, 0.9}),
                       [=](double out) { return eon_albedo_model(out, roughness, reflectance); }});
  const std::vector<double> seen_at{0, 40, 70, 85};
  const double level = sidak(alpha, static_cast<double>(cases.size() * seen_at.size()));
  for (const Case& c : cases) {
    Scene scene;
    scene.materials = {lambertian("wall", dvec3{0}, {1, 3, 5}), c.material};
    scene.polygons = box({-2, -1.5, -3}, {2, 1.5, 3}, "wall");
    scene.spheres = {{"ball", "model", {0.1, 0.2, -0.3}, 0.7}};
    scene.camera = {{0.3, 0.1, 2.5}, {0, 0, 0}, {0, 1, 0}, 50};
    const CompiledScene compiled = compile(scene);
    for (const double degrees : seen_at) {
      const double out = degrees * std::numbers::pi / 180;
      const dvec3 normal = normalize(dvec3{1, 2, 2}), point = scene.spheres[0].center + 0.7 * normal;
      const dvec3 eye = point + 0.5 * (std::cos(out) * normal + std::sin(out) * tangents(normal)[0]);
      const double exact = 3 * c.exact(out);
      const Estimate e = radiance_at(compiled, eye, point, 4000 * effort);
      EXPECT_GT(likelihood(e, exact), level)
          << c.name << " " << c.material.get(OrenNayar::roughness) << " at " << degrees << " degrees: " << e.mean
          << " +- " << e.error << ", exactly " << exact;
      EXPECT_LT(e.error, 0.01 * exact);
    }
  }
}

// Roughness 0 is Lambertian, in every bit of a picture.
TEST(Diffuse, WithoutRoughnessIsLambertianBitForBit) {
  Scene scene = read_scene(GLIMT_SCENES "/report.toml");
  scene.image = {64, 48};
  const auto picture = [&](const char* type, double roughness) {
    *std::ranges::find(scene.materials, "clay", &Material::name) = [&] {
      Material m = diffuse(type, roughness, {0.7, 0.5, 0.3});
      m.name = "clay";
      return m;
    }();
    return trace_all(compile(scene), 4, Lanes::native);
  };
  for (const Mis mis : {Mis::off, Mis::on}) {
    scene.render.mis = mis;
    const std::vector<float> flat = picture("lambertian", 0);
    for (const char* type : {"oren-nayar", "eon"}) {
      const std::vector<float> smooth = picture(type, 0);
      EXPECT_EQ(first_difference(flat, smooth), -1)
          << type << ", " << replay(compile(scene), first_difference(flat, smooth));
      EXPECT_NE(first_difference(flat, picture(type, 0.5)), -1);
    }
  }
}

}  // namespace
