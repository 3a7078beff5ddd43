#include <gtest/gtest.h>

#include <algorithm>

#include "chart/ablation.h"
#include "scene/file/scene_file.h"

using namespace glimt;

namespace {

Scene small(const std::string& name) {
  const std::vector<std::string> size{"image.width=32", "image.height=32"};
  return read_scene(GLIMT_SCENES "/" + name, size);
}

bool has(const std::vector<Piece>& pieces, const std::string& name) {
  return std::ranges::find(pieces, name, &Piece::name) != pieces.end();
}

TEST(Ablation, TriesWhatTheSceneHasAndNothingElse) {
  const auto report = pieces_of(small("report.toml")), empty = pieces_of(small("hexagon_empty.toml"));
  for (const char* name : {"roughness 0", "formula report", "fresnel schlick", "caustics off", "light paths 0",
                           "light paths 0.1", "light paths 1", "sphere connections off"}) {
    EXPECT_TRUE(has(report, name)) << name;
    EXPECT_FALSE(has(empty, name)) << name;
  }
  for (const auto& pieces : {report, empty}) {
    for (const char* name : {"max depth 1", "max depth 8", "shadow rays 30", "sampler sobol", "light sampling none",
                             "roulette constant", "mis on", "path sharing off"})
      EXPECT_TRUE(has(pieces, name)) << name;
    for (const char* name :
         {"shadow rays 1", "sampler lattice", "caustics on", "light paths 0.3", "sphere connections on"})
      EXPECT_FALSE(has(pieces, name)) << name << " is what the scene has";
  }
}

// Lamps alone glow in the furnace's first surface: with one surface a path sees E, without limit E / (1 - rho), so the
// images differ by known amounts in every pixel: (0.2, 1, 3.2) of (1, 2, 4). The mean of all is
// M = 7/3, and relmse_scaled the mean of d^2/(m^2+0.034 M^2).
TEST(Ablation, DifferenceIsExactInAFurnace) {
  const Scene scene = small("furnace.toml");
  std::vector<Piece> pieces{{"max depth 1", true, scene}, {"the same", true, scene}, {"sampler", false, scene}};
  pieces[0].scene.render.max_depth = 1;
  pieces[2].scene.render.sampler = Sampler::independent;
  const auto found = ablate(scene, pieces, {.seeds = 4, .spp = 64}, {});
  const double dark = 0.034 * 49 / 9, exact = (0.04 / (1 + dark) + 1 / (4 + dark) + 3.2 * 3.2 / (16 + dark)) / 3;
  EXPECT_NEAR(found[0].difference, exact, 0.01 * exact) << "noise of the block means";
  EXPECT_EQ(verdict(pieces[0], found[0]), "needed: the image changes");
  EXPECT_EQ(found[1].difference, 0) << "equal seeds give equal images";
  EXPECT_EQ(found[1].noise, 1);
  EXPECT_EQ(verdict(pieces[1], found[1]), "not needed here");
  // Four independent means of products of independent halves: 8 standard errors with 3 degrees of freedom are passed
  // by chance in 0.4 %.
  EXPECT_LT(std::abs(found[2].difference), 8 * found[2].difference_error + 1e-12);
}

TEST(Ablation, VerdictsFollowFromTheFigures) {
  const Piece model{"", true, {}}, way{"", false, {}};
  Ablation a;
  a.difference = 1e-3, a.difference_error = 1e-3;
  EXPECT_EQ(verdict(model, a), "more samples would tell");
  a.difference_error = 1e-5;
  EXPECT_EQ(verdict(model, a), "needed: the image changes");
  EXPECT_EQ(verdict(way, a), "changes the image");
  a.difference = 1e-6, a.difference_error = 1e-6;
  EXPECT_EQ(verdict(model, a), "not needed here");
  EXPECT_EQ(verdict(way, a), "no matter here");
  a.efficiency_low = 1.2, a.efficiency_high = 1.3;
  EXPECT_EQ(verdict(way, a), "better");
  a.efficiency_low = 0.5, a.efficiency_high = 0.6;
  EXPECT_EQ(verdict(way, a), "worse");
}

}  // namespace
