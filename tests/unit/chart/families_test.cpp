#include "chart/families.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <numeric>

#include "pictures.h"
#include "scene/file/scene_file.h"
#include "scene_parts.h"

using namespace glimt;

namespace {

const Plan short_plan{.seeds = 2, .spp = 16, .seconds = std::numeric_limits<double>::infinity()};

double sum(const Families& families) {
  return std::accumulate(families.all.begin(), families.all.end(), 0.0,
                         [](double total, const Family& f) { return total + f.error; });
}

/// A square of that half edge in the plane of x and y, front towards +z.
Polygon facing(const char* material, double x0, double x1, double y0, double y1, double z) {
  return {material, material, {{x0, y0, z}, {x1, y0, z}, {x1, y1, z}, {x0, y1, z}}};
}

/// A horizontal square around the y axis.
Polygon level(const char* material, double edge, double y, double x = 0) {
  const double h = edge / 2;
  return {material, material, {{x - h, y, h}, {x + h, y, h}, {x + h, y, -h}, {x - h, y, -h}}};
}

Scene empty(const Camera& camera) {
  Scene scene;
  scene.camera = camera;
  scene.image = {16, 16};
  scene.materials = {lambertian("floor", dvec3{0.5}), mirror("mirror", dvec3{0.9}), light("lamp", dvec3{10}),
                     mirror("black mirror", dvec3{0})};
  return scene;
}

// With 90 degrees the image is [-1, 1]^2 at distance 1, and a pixel of 16 is 1/8 of it. The mirror at distance 2 takes
// columns 4 to 9 and rows 4 to 11, all but columns 6 and 7 of rows 6 to 9, which a floor hides. A black mirror is no
// mirror.
TEST(Families, TellsPixelsThatSeeAMirrorFirst) {
  Scene scene = empty({.eye = {0, 0, 0}, .look_at = {0, 0, -1}, .fov_y = 90});
  scene.polygons = {facing("mirror", -1, 0.5, -1, 1, -2), facing("floor", -0.25, 0, -0.25, 0.25, -1),
                    facing("black mirror", 0.5, 2, -2, 2, -2)};
  const std::vector<bool> sees = sees_specular(scene);
  for (int y = 0; y < 16; ++y)
    for (int x = 0; x < 16; ++x) {
      const bool wall = x >= 4 && x < 10 && y >= 4 && y < 12, hidden = x >= 6 && x < 8 && y >= 6 && y < 10;
      EXPECT_EQ(sees[static_cast<std::size_t>(16 * y + x)], wall && !hidden) << "pixel (" << x << ", " << y << ")";
    }
}

/// A scene whose error is all of one family, for the reason in its name.
struct Alone {
  const char* why;
  std::size_t family;
  Scene scene;
};

std::vector<Alone> each_alone() {
  std::vector<Alone> all;
  // A lamp at x = 3 shines up into a mirror above: what the floor gets has come by way of the mirror.
  const auto lit_by_mirror = [](const Camera& camera) {
    Scene scene = empty(camera);
    scene.polygons = {level("floor", 40, 0), level("lamp", 1, 0.5, 3), level("mirror", 40, 2)};
    std::ranges::reverse(scene.polygons[2].vertices);
    return scene;
  };
  all.push_back({"FloorLitByAMirror", 0, lit_by_mirror({.eye = {0, 1.5, 0}, .look_at = {-2, 0, 0}, .fov_y = 20})});
  all.push_back({"ItsImageInTheMirror", 1, lit_by_mirror({.eye = {0, 0.5, 0}, .look_at = {-2, 2, 0}, .fov_y = 20})});
  // The mirror is below the floor, where no light comes.
  Scene lit = empty({.eye = {0, 2, 5}, .look_at = {0, 0, 0}, .fov_y = 30});
  lit.polygons = {level("floor", 40, 0), square_lamp(1, 3), level("mirror", 4, -1)};
  all.push_back({"FloorLitByALamp", 2, lit});
  // Nothing but a lamp, seen in a mirror; the noise is that of its edges.
  Scene reflected = empty({.eye = {0, 0, 0}, .look_at = {0, 0, -1}, .fov_y = 90});
  reflected.polygons = {facing("mirror", -9, 9, -9, 9, -2), facing("lamp", -1.1, 1.2, -1.3, 1.4, 1)};
  std::ranges::reverse(reflected.polygons[1].vertices);
  all.push_back({"LampInAMirror", 3, reflected});
  return all;
}

class FamilyAlone : public testing::TestWithParam<Alone> {};

TEST_P(FamilyAlone, HasAllOfTheError) {
  const auto& [why, family, scene] = GetParam();
  const Families found = measure_families(scene, short_plan, {});
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_EQ(found.all[i].share, i == family ? 1 : 0) << family_texts[i].name;
    EXPECT_EQ(found.all[i].low, found.all[i].share);
    EXPECT_EQ(found.all[i].high, found.all[i].share);
    EXPECT_EQ(found.all[i].pixels, i % 2 == family % 2 ? 1 : 0);
  }
  // The other half of the light is black, so that this half's samples are those of the whole picture.
  Scene whole = scene;
  double error = 0;
  for (int run = 0; run < 2; ++run) {
    whole.render.seed = scene.render.seed + 2 * run + (family < 2 ? 1 : 0);
    error += estimate_error(render(compile(whole), 16)).relmse_scaled / 2;
  }
  EXPECT_GT(error, 0);
  EXPECT_NEAR(found.all[family].error, error, 1e-5 * error);
}

INSTANTIATE_TEST_SUITE_P(Scenes, FamilyAlone, testing::ValuesIn(each_alone()),
                         [](const auto& test) { return std::string(test.param.why); });

Scene small_report(int edge) {
  const std::vector<std::string> size{"image.width=" + std::to_string(edge), "image.height=" + std::to_string(edge)};
  return read_scene(GLIMT_SCENES "/report.toml", size);
}

// One film alone: the same samples as that of the picture, so the same estimate but for the rounding of floats.
TEST(Families, AddUpToTheEstimateOfOnePicture) {
  for (const Caustics shown : {Caustics::off, Caustics::only}) {
    Scene scene = small_report(43);
    scene.render.caustics = shown;
    const Families found = measure_families(scene, {.seeds = 1, .spp = 5, .seconds = short_plan.seconds}, {});
    EXPECT_EQ(found.samples, 5);
    const double estimate = estimate_error(render(compile(scene), 5)).relmse_scaled;
    EXPECT_NEAR(sum(found), estimate, 1e-5 * estimate);
    const std::size_t absent = shown == Caustics::off ? 0 : 2;
    EXPECT_EQ(found.all[absent].error + found.all[absent + 1].error, 0);
  }
}

// Light paths share no random numbers with those of the camera, so that where no mirror and no glass is seen the
// variances of both lights add up to that of the picture. Means over 64 seeds each: a difference of 5 standard errors
// comes by chance in 1e-5 (Student's t with 63 degrees of freedom or more; over 8 seeds in 2e-3).
TEST(Families, AddUpToTheErrorOfTheWhole) {
  Scene scene = small_report(32);
  scene.camera = {.eye = {6, 0, 0}, .look_at = {6, -5, 0.1}, .up = {0, 0, 1}, .fov_y = 30};
  std::vector<double> sums, wholes, caustics;
  for (int run = 0; run < 8 * effort; ++run) {
    scene.render.seed = 100 * run + 1;
    const Families found = measure_families(scene, {.seeds = 1, .spp = 16, .seconds = short_plan.seconds}, {});
    ASSERT_EQ(found.all[1].pixels, 0) << "no mirror is in sight";
    sums.push_back(sum(found));
    caustics.push_back(found.all[0].error);
    scene.render.seed += 50;
    wholes.push_back(estimate_error(render(compile(scene), 16)).relmse_scaled);
  }
  const Estimate a = estimate(sums), b = estimate(wholes);
  EXPECT_LT(std::abs(a.mean - b.mean), 5 * std::hypot(a.error, b.error)) << a.mean << " against " << b.mean;
  EXPECT_GT(estimate(caustics).mean, 0.02 * b.mean) << "there are some of both";
  EXPECT_LT(estimate(caustics).mean, 0.98 * b.mean);
}

TEST(Families, SaysHowFarItIsAndCanBeEnded) {
  const Scene scene = small_report(16);
  double last = 0;
  const Families found = measure_families(scene, short_plan, [&](double share) {
    EXPECT_GE(share, last);
    last = share;
  });
  EXPECT_EQ(last, 1);
  EXPECT_EQ(found.samples, 16);
  EXPECT_NEAR(found.all[0].pixels + found.all[1].pixels, 1, 1e-12);
  EXPECT_THROW(measure_families(scene, short_plan, [](double) { throw std::out_of_range("enough"); }),
               std::out_of_range);
}

TEST(Families, AreOneWithoutMirrorsAndGlass) {
  EXPECT_THROW(measure_families(read_scene(GLIMT_SCENES "/hexagon_diffuse.toml"), short_plan, {}), std::runtime_error);
}

}  // namespace
