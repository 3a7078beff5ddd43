#include "chart/runs.h"

#include <gtest/gtest.h>

#include <limits>

#include "chart/ablation.h"
#include "chart/families.h"
#include "material/light.h"
#include "pictures.h"
#include "scene/file/scene_file.h"

using namespace glimt;

namespace {

/// The room with every radiance that many times as large.
Scene lit(double factor) {
  const std::vector<std::string> size{"image.width=24", "image.height=24"};
  Scene scene = read_scene(GLIMT_SCENES "/hexagon.toml", size);
  for (Material& material : scene.materials)
    if (material.type == Light::name) material.set(Light::radiance, factor * material.get(Light::radiance));
  return scene;
}

const Plan plan{.seeds = 2, .spp = 8, .seconds = std::numeric_limits<double>::infinity()};

std::vector<Measurement> measurements_of(double factor, bool compared) {
  Scene scene = lit(factor);
  scene.render.seed = 77;
  const Image reference = render(compile(scene), 64).mean();
  scene.render.seed = 1;
  std::vector<Variant> variants;
  variants.push_back({"path", "path", compile(scene)});
  scene.render.method = Method::naive;
  variants.push_back({"naive", "naive", compile(scene)});
  auto measurements = measure(variants, plan, compared ? &reference : nullptr, {});
  for (Measurement& m : measurements) m.seconds = m.spp;  // clocks do not repeat themselves
  return measurements;
}

// A power of two times every radiance is exact, so that no sample differs but by it, and nor does any relative error.
constexpr double dim = 1.0 / 1024;

TEST(Runs, TheBrightnessOfTheSceneMovesNoCurve) {
  for (const bool compared : {false, true}) {
    const auto bright = measurements_of(1, compared), dark = measurements_of(dim, compared);
    ASSERT_EQ(bright.size(), dark.size());
    for (std::size_t i = 0; i < bright.size(); ++i) {
      EXPECT_EQ(dark[i].estimate, bright[i].estimate) << "measurement " << i;
      EXPECT_EQ(dark[i].error.has_value(), compared);
      EXPECT_EQ(dark[i].error.value_or(Comparison{}).relmse_scaled,
                bright[i].error.value_or(Comparison{}).relmse_scaled)
          << "measurement " << i;
    }
    std::vector<Variant> variants(2);
    EXPECT_EQ(svg_chart(error_chart(variants, dark)), svg_chart(error_chart(variants, bright)));
    EXPECT_GT(bright.back().estimate, 0) << "there is noise to tell";
  }
}

TEST(Runs, TheBrightnessOfTheSceneChangesNoTable) {
  const Scene bright = lit(1), dark = lit(dim);
  const auto pieces = [](Scene scene) {
    scene.render.caustics = Caustics::off;
    return std::vector<Piece>{{"caustics off", true, scene}};
  };
  const Ablation a = ablate(bright, pieces(bright), plan, {}).front(), b = ablate(dark, pieces(dark), plan, {}).front();
  EXPECT_EQ(b.noise, a.noise);
  EXPECT_EQ(b.difference, a.difference);
  EXPECT_NE(a.difference, 0);
  const Families c = measure_families(bright, plan, {}), d = measure_families(dark, plan, {});
  for (std::size_t i = 0; i < c.all.size(); ++i)
    EXPECT_NEAR(d.all.at(i).error, c.all.at(i).error, 1e-6 * c.all.at(i).error);
}

TEST(Runs, ABoundHasAnOpenMarker) {
  Scene scene = read_scene(GLIMT_TESTS_DIR "/data/rare/tiny_lamp.toml",
                           std::vector<std::string>{"image.width=16", "image.height=16"});
  std::vector<Variant> variants;
  variants.push_back({"path", "path", compile(scene)});
  scene.render.light_sampling = LightSampling::none;
  variants.push_back({"naive", "naive", compile(scene)});
  std::vector<Measurement> measurements = measure(variants, plan, nullptr, {});
  for (Measurement& m : measurements) {
    EXPECT_TRUE(m.at_least == (m.variant == 1) || m.spp < 2) << m.variant << ", " << m.spp << " spp";
    m.estimate = 0.01;  // that of a black picture has no place
  }
  const std::string svg = svg_chart(error_chart(variants, measurements));
  EXPECT_NE(svg.find("' fill='#fff' stroke="), std::string::npos);
  EXPECT_NE(svg.find("at least"), std::string::npos);
  std::erase_if(measurements, [](const Measurement& m) { return m.variant == 1; });
  EXPECT_EQ(svg_chart(error_chart(std::span(variants).first(1), measurements)).find("at least"), std::string::npos);
}

}  // namespace
