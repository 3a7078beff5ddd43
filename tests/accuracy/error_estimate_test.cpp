#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "film/statistics.h"
#include "pictures.h"
#include "scene/file/scene_file.h"

using namespace glimt;

// The error that a picture's two halves estimate is the error it has.
namespace {

constexpr int seeds = 24;

struct Picture {
  Image mean;
  double estimate = 0;
};

std::vector<Picture> pictures(CompiledScene scene, Sampler sampler, int samples) {
  scene.settings.sampler = sampler;
  std::vector<Picture> result;
  for (int seed = 1; seed <= seeds; ++seed) {
    scene.settings.seed = 100 * seed + static_cast<int>(sampler);
    const Film film = render(scene, samples);
    result.push_back({film.mean(), relmse_estimate(film)});
  }
  return result;
}

/// Mean of all pictures but one.
Image mean_without(const std::vector<Picture>& all, std::size_t left_out) {
  Image image = all.front().mean;
  std::vector<double> sums(image.rgb.size());
  for (std::size_t i = 0; i < all.size(); ++i)
    if (i != left_out)
      for (std::size_t k = 0; k < sums.size(); ++k) sums[k] += static_cast<double>(all[i].mean.rgb[k]);
  const auto count = static_cast<double>(all.size() - (left_out < all.size() ? 1 : 0));
  for (std::size_t k = 0; k < sums.size(); ++k) image.rgb[k] = static_cast<float>(sums[k] / count);
  return image;
}

struct Case {
  std::string scene;
  int samples;
  int size;              ///< pixels
  glm::dvec3 direction;  ///< of the part's middle: the lamp, or the spheres
};

/// A part of the scene's picture, its pixels as large as in the whole. The estimate looks at blocks of 8x8 pixels, so a
/// small picture of the same view would not do: its blocks would mix the lamp with the ceiling.
Scene part_of_picture(const Case& part) {
  Scene scene = read_scene(GLIMT_SCENES "/" + part.scene + ".toml");
  const double degree = std::numbers::pi / 180, whole = scene.image.height;
  scene.camera.fov_y = 2 / degree * std::atan(std::tan(scene.camera.fov_y / 2 * degree) * part.size / whole);
  scene.camera.look_at = scene.camera.eye + part.direction;
  scene.image = {part.size, part.size};
  return scene;
}

class ErrorEstimate : public testing::TestWithParam<Case> {};

// The truth is the error against pictures with independent samples, whose own error is known and taken off: for these
// samples themselves against the mean of the n - 1 others, which makes it n / (n - 1) of what it is; for the lattice
// and Sobol against the mean of all n, an nth of whose error adds to it. So a fault that all pictures of a sampler
// share would be seen. `spread` is the ratio's standard error over seeds (jackknife); the bound holds at four of them,
// which chance breaks once in 16,000 where the ratio is as near to 1 as it should be.
TEST_P(ErrorEstimate, IsWithinAFifthOfTheTruth) {
  const int samples = GetParam().samples;
  const Scene scene = part_of_picture(GetParam());
  const auto independent = pictures(compile(scene), Sampler::independent, samples);
  const Image reference = mean_without(independent, seeds);
  double error_of_one = 0;
  for (std::size_t i = 0; i < seeds; ++i)
    error_of_one += compare(independent[i].mean, mean_without(independent, i)).relmse * ((seeds - 1.0) / seeds) / seeds;

  for (const Sampler sampler : {Sampler::independent, Sampler::lattice, Sampler::sobol}) {
    const bool own = sampler == Sampler::independent;
    const auto found = own ? independent : pictures(compile(scene), sampler, samples);
    std::vector<double> truths, estimates;
    double truth = 0, estimated = 0;
    for (std::size_t i = 0; i < seeds; ++i) {
      truths.push_back(own ? compare(found[i].mean, mean_without(found, i)).relmse * ((seeds - 1.0) / seeds)
                           : compare(found[i].mean, reference).relmse - error_of_one / seeds);
      estimates.push_back(found[i].estimate);
      truth += truths[i], estimated += estimates[i];
    }
    const double ratio = estimated / truth;
    double spread = 0;
    for (std::size_t i = 0; i < seeds; ++i)
      spread += std::pow((estimated - estimates[i]) / (truth - truths[i]) - ratio, 2) * (seeds - 1.0) / seeds;
    spread = std::sqrt(spread);
    EXPECT_LT(std::abs(ratio - 1) + 4 * spread, 0.2)
        << "sampler " << static_cast<int>(sampler) << ": estimate " << estimated / seeds << ", truth " << truth / seeds;
  }
}

INSTANTIATE_TEST_SUITE_P(Scenes, ErrorEstimate,
                         testing::Values(Case{"hexagon_empty", 16, 240, {7, 5, 0}},
                                         Case{"hexagon_diffuse", 16, 160, {9, -4, 1}},
                                         Case{"hexagon", 256, 48, {9, -4, 1}}),
                         [](const auto& scene) { return scene.param.scene; });

}  // namespace
