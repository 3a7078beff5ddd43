#include <gtest/gtest.h>

#include <iostream>
#include <nlohmann/json.hpp>

#include "film/image_file.h"
#include "mesh_scenes.h"
#include "pictures.h"
#include "scene/file/scene_file.h"

using namespace glimt;

// Against Mitsuba 3's pictures of the same scenes; what the files hold is said in tests/data/README.md.
namespace {

constexpr double alpha = 1e-4;  ///< of a false alarm, for each scene
constexpr int block_size = 8;

struct ReferencePicture {
  std::vector<double> blocks;  ///< of 8x8 pixels, three channels each
  double mean = 0;
  double mean_error = 0;  ///< standard error of the mean over pixels and channels
  int samples = 0;        ///< per pixel
};

ReferencePicture read_reference(const std::string& name) {
  const std::string base = GLIMT_TESTS_DIR "/data/" + name;
  const Image image = read_image(base + ".pfm");
  const auto facts = nlohmann::json::parse(std::ifstream(base + ".json"));
  ReferencePicture r{{image.rgb.begin(), image.rgb.end()}, facts.at("mean"), 0, facts.at("spp")};
  // Its pixels' errors are independent; channels of one pixel are not, so they count as one.
  r.mean_error =
      facts.at("rmse_of_reference").get<double>() / (block_size * std::sqrt(static_cast<double>(r.blocks.size()) / 3));
  return r;
}

struct Case {
  std::string name;
  int samples;  ///< per pixel and seed
};

class Mitsuba : public testing::TestWithParam<Case> {};

/// Pictures made as the reference was: a path tracer's, with independent samples, each path and each ray for itself.
Series as_mitsuba(Scene scene, int seeds, int samples) {
  scene.render.sampler = Sampler::independent;
  scene.render.path_sharing = PathSharing::off;
  scene.render.sphere_connections = SphereConnections::off;
  scene.render.light_paths = 0;
  Series series;
  for (int seed = 1; seed <= seeds; ++seed) {
    scene.render.seed = 1000 * seed + 8;
    CompiledScene compiled = compile(scene);
    compiled.lamp_edges.clear(), compiled.lamp_images.clear();
    series.blocks.push_back(block_means(render(compiled, samples).mean(), block_size));
  }
  return series;
}

// Overall mean to 0.1 % with three standard errors of the difference added; these are small enough for a true mean to
// pass but for a probability of alpha (3.9 of them). Every block by t-tests, in which the
// reference's variance is that of pictures made in the same way, per sample, over its samples. A caustic path may be so
// rare that a block has none in all of them and its variance is seen too small; its neighbours tell, so the mean
// variance of the 5x5 blocks around holds where it is larger.
TEST_P(Mitsuba, PictureIsTheSame) {
  const ReferencePicture reference = read_reference(GetParam().name);
  const Scene scene = reference_scene(GetParam().name);
  constexpr int seeds = 16;
  const int samples = GetParam().samples * effort / 8;
  const Series ours = render_series(scene, seeds, samples, block_size);
  ASSERT_EQ(ours.size(), reference.blocks.size());

  const Estimate mean = ours.overall();
  const double error = std::hypot(mean.error, reference.mean_error);
  std::cout << scene.name << ": overall mean " << 100 * (mean.mean / reference.mean - 1) << " % off, standard error "
            << 100 * mean.error / reference.mean << " % here and " << 100 * reference.mean_error / reference.mean
            << " % there\n";
  EXPECT_TRUE(effort == 1 || 6.9 * error < 0.001 * reference.mean) << "too few samples to say anything";
  EXPECT_LT(std::abs(mean.mean - reference.mean), effort > 1 ? 0.001 * reference.mean - 3 * error : 4 * error)
      << mean.mean << " +- " << mean.error << ", reference " << reference.mean << " +- " << reference.mean_error;

  const double level = sidak(alpha, static_cast<double>(ours.size()));
  const Series alike = as_mitsuba(scene, seeds, samples);
  const double more_samples = static_cast<double>(seeds * samples) / reference.samples;
  const std::size_t columns = static_cast<std::size_t>(scene.image.width / block_size),
                    rows = ours.size() / 3 / columns;
  std::vector<double> variances;
  for (std::size_t i = 0; i < ours.size(); ++i) variances.push_back(std::pow(alike.block(i).error, 2) * more_samples);
  for (std::size_t i = 0; i < ours.size(); ++i) {
    const std::size_t k = i / 3, row = k / columns, column = k % columns;
    double variance = 0, count = 0;
    for (std::size_t y = row - std::min<std::size_t>(row, 2); y < std::min(row + 3, rows); ++y)
      for (std::size_t x = column - std::min<std::size_t>(column, 2); x < std::min(column + 3, columns); ++x, ++count)
        variance += variances[3 * (y * columns + x) + i % 3];
    Estimate block = ours.block(i);
    block.error = std::hypot(block.error, std::sqrt(std::max(variances[i], variance / count)));
    EXPECT_GT(likelihood(block, reference.blocks[i]), level)
        << "block (" << column << ", " << row << "), channel " << i % 3 << ": " << block.mean << " +- " << block.error
        << ", reference " << reference.blocks[i];
  }
}

INSTANTIATE_TEST_SUITE_P(Scenes, Mitsuba,
                         testing::Values(Case{"hexagon", 16}, Case{"hexagon_diffuse", 16}, Case{"hexagon_empty", 16},
                                         Case{"glossy", 16}),
                         [](const auto& scene) { return scene.param.name; });
INSTANTIATE_TEST_SUITE_P(ScenesLong, Mitsuba, testing::Values(Case{"cornell", 64}, Case{"meshes", 16}),
                         [](const auto& scene) { return scene.param.name; });

}  // namespace
