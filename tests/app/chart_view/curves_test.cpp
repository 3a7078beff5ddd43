#include "viewer/state/curves.h"

#include <gtest/gtest.h>

#include <memory>
#include <string>
#include <vector>

#include "material/oren_nayar.h"
#include "scene/file/scene_file.h"
#include "viewer/chart_view/chart_export.h"
#include "viewer/state/scene_difference.h"

/// The chart's curves, without a window.
namespace glimt {
namespace {

Scene room() { return read_scene(GLIMT_SCENES "/report.toml"); }

std::shared_ptr<const Scene> share(Scene scene) { return std::make_shared<const Scene>(std::move(scene)); }

/// error = factor / seconds, at 1000 samples a second.
RunPoint on_power_law(double factor, int samples) { return {samples, samples / 1e3, factor * 1e3 / samples, {}}; }

Curve power_law(double factor) {
  Curve curve;
  for (int samples = 8; samples <= 8192; samples *= 2) curve.points.push_back(on_power_law(factor, samples));
  return curve;
}

std::vector<std::string> labels(const Curves& curves) {
  std::vector<std::string> all;
  for (const Curve& curve : curves.all()) all.push_back(curve.label);
  return all;
}

std::vector<std::string> told(const Scene& from, const Scene& to) {
  std::vector<std::string> all;
  for (const Difference& d : differences(from, to)) all.push_back(d.to);
  return all;
}

// On logarithmic axes a power law is a line, on which interpolation is exact.
TEST(Curves, InterpolationIsExactOnAPowerLaw) {
  const Curve curve = power_law(0.02);
  EXPECT_NEAR(error_at(curve, ErrorKind::estimate, Across::seconds, 1.7).value(), 0.02 / 1.7, 1e-12);
  EXPECT_NEAR(error_at(curve, ErrorKind::estimate, Across::samples, 1700).value(), 0.02 / 1.7, 1e-12);
  EXPECT_NEAR(place_of(curve, ErrorKind::estimate, Across::seconds, 0.3).value(), 0.02 / 0.3, 1e-12);
  EXPECT_NEAR(place_of(curve, ErrorKind::estimate, Across::samples, 0.3).value(), 20 / 0.3, 1e-9);
  EXPECT_FALSE(error_at(curve, ErrorKind::estimate, Across::seconds, 10)) << "nothing is told beyond what was measured";
  EXPECT_FALSE(place_of(curve, ErrorKind::estimate, Across::seconds, 1e-4));
  EXPECT_FALSE(error_at(curve, ErrorKind::reference, Across::seconds, 1)) << "there is no reference";
}

// Efficiency is 1 / (error * time): that of factor / time is 1 / factor at any time.
TEST(Curves, EfficiencyIsARatioToTheBase) {
  const Curve base = power_law(0.02), better = power_law(0.005);
  EXPECT_NEAR(efficiency_ratio(better, base, 1.3).value(), 4, 1e-9);
  EXPECT_NEAR(efficiency_ratio(better, base, std::nullopt).value(), 4, 1e-9);
  EXPECT_NEAR(efficiency_ratio(base, better, 1.3).value(), 0.25, 1e-9);
  EXPECT_FALSE(efficiency_ratio(better, base, 100));

  Curve compared = better;  // to the reference it is twice as far as it thinks; the base has no reference
  for (RunPoint& point : compared.points) point.error = Comparison{.relmse_scaled = 2 * point.estimate};
  EXPECT_EQ(error_kind(compared), ErrorKind::reference);
  EXPECT_NEAR(efficiency_ratio(compared, base, std::nullopt).value(), 4, 1e-9) << "estimate against estimate";
  EXPECT_NEAR(efficiency_ratio(compared, compared, std::nullopt).value(), 1, 1e-9);
}

// A black picture's halves do not differ, and a few lit pixels in it hardly do: that is no praise.
TEST(Curves, APictureWithoutLightHasNoErrorAndNoEfficiency) {
  const Curve base = power_law(0.02);
  for (const double nothing : {0.0, 9e-10, std::numeric_limits<double>::infinity()}) {
    Curve black = base;
    for (RunPoint& point : black.points) point.estimate = nothing;
    EXPECT_FALSE(error_of(black.points.back(), ErrorKind::estimate)) << nothing;
    EXPECT_FALSE(error_at(black, ErrorKind::estimate, Across::seconds, 1)) << nothing;
    EXPECT_FALSE(efficiency_ratio(black, base, 1)) << nothing;
    EXPECT_FALSE(efficiency_ratio(black, base, std::nullopt)) << nothing;
    EXPECT_FALSE(efficiency_ratio(base, black, std::nullopt)) << nothing;
  }
}

TEST(Curves, LabelsSayWhatDiffersFromTheFirst) {
  Curves curves;
  Scene scene = room();
  curves.add(share(scene), on_power_law(1, 8));
  EXPECT_EQ(labels(curves), (std::vector<std::string>{"first setting"}));
  for (const int rays : {4, 30}) {
    scene.render.shadow_rays = rays;
    curves.add(share(scene), on_power_law(1, 8));
  }
  scene.render.sampler = Sampler::sobol;
  curves.add(share(scene), on_power_law(1, 8));
  EXPECT_EQ(labels(curves), (std::vector<std::string>{"shadow rays 1, lattice", "shadow rays 4", "shadow rays 30",
                                                      "shadow rays 30, sobol"}));
  curves.remove(curves.all()[0].id);
  EXPECT_EQ(labels(curves),
            (std::vector<std::string>{"shadow rays 4, lattice", "shadow rays 30", "shadow rays 30, sobol"}));
}

TEST(Curves, DifferencesAreNamed) {
  const Scene from = room();
  EXPECT_TRUE(differences(from, from).empty());
  Scene to = from;
  to.render.spp = 7;
  EXPECT_TRUE(differences(from, to).empty()) << "where it stops makes no other curve";
  set_method(to.render, Method::report);
  EXPECT_EQ(told(from, to), (std::vector<std::string>{"report"})) << "with all that it brings along";
  to.render.caustics = Caustics::on;
  EXPECT_EQ(told(from, to), (std::vector<std::string>{"report", "caustics on"}));

  to = from;
  to.image = {200, 100};
  to.camera.fov_y += 1;
  to.spheres[0].radius = 0.25;
  to.spheres[1].center.x += 1;
  EXPECT_EQ(told(from, to),
            (std::vector<std::string>{"200 \u00D7 100", "camera moved", to.spheres[0].name + " radius 0.25",
                                      to.spheres[1].name + " moved"}));
  to = from;
  for (Material& material : to.materials)
    if (material.type == "oren-nayar") material.set(OrenNayar::roughness, 0.3);
  ASSERT_EQ(told(from, to).size(), 1U);
  EXPECT_TRUE(told(from, to)[0].ends_with(" roughness 0.3")) << told(from, to)[0];
}

TEST(Curves, SceneSeenBeforeGoesOnWithItsCurve) {
  Curves curves;
  Scene first = room(), second = first;
  second.render.shadow_rays = 4;
  curves.add(share(first), on_power_law(1, 8));
  curves.edited(1);
  curves.add(share(second), on_power_law(1, 8));
  curves.edited(0);
  first.render.spp = 4096;
  curves.add(share(first), on_power_law(1, 16));
  ASSERT_EQ(curves.all().size(), 2U);
  EXPECT_EQ(curves.all()[0].points.size(), 2U);
  EXPECT_EQ(curves.current(), &curves.all()[0]);
  curves.add(share(first), on_power_law(1, 2));
  EXPECT_EQ(curves.all()[0].points.size(), 1U) << "it has begun again";
}

TEST(Curves, DragLeavesOneCurve) {
  Curves curves;
  Scene scene = room();
  curves.add(share(scene), on_power_law(1, 8));
  const auto drag_to = [&](int rays, std::uint64_t gesture) {
    scene.render.shadow_rays = rays;
    curves.edited(gesture);
    curves.add(share(scene), on_power_law(1, 8));
  };
  for (const int rays : {2, 3, 4}) drag_to(rays, 7);
  EXPECT_EQ(labels(curves), (std::vector<std::string>{"shadow rays 1", "shadow rays 4"}));
  drag_to(5, 8);
  EXPECT_EQ(curves.all().size(), 3U) << "another drag, another curve";
  drag_to(1, 9);
  drag_to(6, 9);
  EXPECT_EQ(curves.all().size(), 4U) << "a drag over a setting that was there before leaves its curve";
}

TEST(Curves, KeepFourPointsToAnOctaveAndTheNewest) {
  Curves curves;
  const auto scene = share(room());
  for (int samples = 2; samples <= 4097; ++samples) curves.add(scene, on_power_law(1, samples));
  const auto& points = curves.all()[0].points;
  EXPECT_LT(points.size(), 50U) << "11 octaves";
  EXPECT_GT(points.size(), 30U);
  EXPECT_EQ(points.back().samples, 4097);
}

TEST(Curves, TheOldestIsForgottenPastTheMost) {
  Curves curves;
  Scene scene = room();
  for (int seed = 1; seed <= static_cast<int>(Curves::most) + 3; ++seed) {
    scene.render.seed = seed;
    curves.add(share(scene), on_power_law(1, 8));
  }
  EXPECT_EQ(curves.all().size(), Curves::most);
  EXPECT_EQ(curves.all().front().scene->render.seed, 4);
  EXPECT_EQ(curves.base(), &curves.all().front());
  curves.set_base(curves.all()[5].id);
  EXPECT_EQ(curves.base(), &curves.all()[5]);
  curves.clear();
  EXPECT_EQ(curves.base(), nullptr);
}

TEST(Curves, AreExported) {
  Curves curves;
  Scene scene = room();
  curves.add(share(scene), on_power_law(1, 8));
  scene.render.shadow_rays = 4;
  scene.render.sampler = Sampler::sobol;
  RunPoint compared = on_power_law(1, 16);
  compared.error = Comparison{.relmse999 = 0.25, .relmse_scaled = 0.5};
  curves.add(share(scene), compared);
  EXPECT_EQ(curves_csv(curves.all()),
            "method,seed,spp,seconds,relmse_scaled,relmse999,relmse_scaled_estimate\n"
            "\"shadow rays 1, lattice\",1,8,0.008,,,125\n"
            "\"shadow rays 4, sobol\",1,16,0.016,0.5,0.25,62.5\n");
  const auto count = [&](const std::string& part) {
    const std::string svg = curves_svg(curves.all(), Across::seconds, "room");
    std::size_t found = 0;
    for (auto at = svg.find(part); at != std::string::npos; at = svg.find(part, at + 1)) ++found;
    return found;
  };
  EXPECT_EQ(count("shadow rays 4, sobol"), 1U);
  curves.set_shown(curves.all()[1].id, false);
  EXPECT_EQ(count("shadow rays 4, sobol"), 0U);
}

}  // namespace
}  // namespace glimt
