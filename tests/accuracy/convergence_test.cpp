#include <gtest/gtest.h>

#include <iostream>

#include "pictures.h"
#include "scene/file/scene_file.h"

using namespace glimt;

// How fast errors fall. The probability of a false alarm is alpha for each test.
namespace {

constexpr double alpha = 1e-4;

struct Convergence {
  Estimate slope;             ///< of log(error) over log(samples), by groups of seeds
  std::vector<double> error;  ///< relative standard deviation of a pixel, by number of samples
};

const std::vector<int> sample_counts{2, 8, 32, 128};

/// Pictures in pairs of seeds: half the mean square of their difference estimates a pixel's variance without a
/// reference, for correlated samples too. It is taken relative to the pixel's brightness, or the edge of the lamp would
/// be all that counts. A straight line through the logarithms of its root has a slope for each pair.
Convergence measure(Scene scene, Sampler sampler, int pairs) {
  scene.image = {40, 40};
  scene.render.sampler = sampler;
  scene.render.seed = 0;
  const Image brightness = render(compile(scene), 128).mean();
  const std::size_t counts = sample_counts.size();
  std::vector<double> slopes, variance(counts);
  double mean_x = 0;
  for (const int n : sample_counts) mean_x += std::log(n) / static_cast<double>(counts);
  for (int pair = 0; pair < pairs; ++pair) {
    double slope = 0, squares = 0;
    for (std::size_t i = 0; i < counts; ++i) {
      Image picture[2];
      for (int k = 0; k < 2; ++k) {
        scene.render.seed = 1 + 1000 * static_cast<int>(i) + 2 * pair + k;
        picture[k] = render(compile(scene), sample_counts[i]).mean();
      }
      double sum = 0;
      for (std::size_t p = 0; p < picture[0].rgb.size(); ++p)
        sum += std::pow(static_cast<double>(picture[0].rgb[p] - picture[1].rgb[p]), 2) / 2 /
               (std::pow(static_cast<double>(brightness.rgb[p]), 2) + 0.01);
      sum /= static_cast<double>(picture[0].rgb.size());
      variance[i] += sum / pairs;
      const double x = std::log(sample_counts[i]) - mean_x;
      slope += x * std::log(sum) / 2, squares += x * x;
    }
    slopes.push_back(slope / squares);
  }
  Convergence result{estimate(slopes), {}};
  for (const double v : variance) result.error.push_back(std::sqrt(v));
  return result;
}

void print(const char* name, const Convergence& c) {
  std::cout << name << ": slope " << c.slope.mean << " +- " << c.slope.error << "; relative error of a pixel";
  for (std::size_t i = 0; i < c.error.size(); ++i) std::cout << ", " << c.error[i] << " at " << sample_counts[i];
  std::cout << "\n";
}

// Independent samples: the variance of a mean of N is 1 / N that of one (a t-test of the slope). Those that fill their
// sequences evenly do better: a one-sided t-test against a slope steeper than -1/2 by 0.02.
TEST(ConvergenceLong, EvenSamplersAreFasterThanTheRootOfTheirNumber) {
  const Scene scene = read_scene(GLIMT_SCENES "/hexagon_empty.toml");
  constexpr int pairs = 20;
  const Convergence independent = measure(scene, Sampler::independent, pairs);
  print("independent", independent);
  EXPECT_GT(likelihood(independent.slope, -0.5), alpha)
      << "slope " << independent.slope.mean << " +- " << independent.slope.error;
  EXPECT_LT(independent.slope.error, 0.01) << "too few pictures to say anything";
  for (const auto& [name, sampler] : {std::pair{"Sobol", Sampler::sobol}, {"lattice", Sampler::lattice}}) {
    const Convergence even = measure(scene, sampler, pairs);
    print(name, even);
    EXPECT_LT(even.slope.mean, -0.52);
    EXPECT_LT(student_tails((even.slope.mean + 0.52) / even.slope.error, pairs - 1) / 2, alpha)
        << name << ": slope " << even.slope.mean << " +- " << even.slope.error;
    EXPECT_LT(even.error.back(), independent.error.back()) << name;
  }
  print("stratified", measure(scene, Sampler::stratified, pairs));
}

// The halves of a film are independent, so that their difference tells the error of the mean: its square, over 4, has
// the same expectation as half the square of the difference of two pictures with seeds of their own. A t-test over
// pairs.
TEST(Convergence, HalvesOfAFilmTellItsError) {
  Scene scene = read_scene(GLIMT_SCENES "/hexagon_empty.toml");
  scene.image = {40, 40};
  constexpr int pairs = 16, samples = 4 * effort;
  const std::vector<Sampler> samplers{Sampler::independent, Sampler::stratified, Sampler::lattice, Sampler::sobol};
  const double level = sidak(alpha, static_cast<double>(samplers.size()));
  scene.render.seed = 0;
  const Image brightness = render(compile(scene), 128).mean();
  for (const Sampler sampler : samplers) {
    scene.render.sampler = sampler;
    std::vector<double> too_large;
    double by_halves = 0, by_pairs = 0;
    for (int pair = 0; pair < pairs; ++pair) {
      Image picture[2], error[2];
      for (int k = 0; k < 2; ++k) {
        scene.render.seed = 1 + 2 * pair + k;
        const Film film = render(compile(scene), samples);
        picture[k] = film.mean(), error[k] = film.standard_error();
      }
      double halves = 0, difference = 0;
      for (std::size_t p = 0; p < brightness.rgb.size(); ++p) {
        const auto of = [&](const Image& image) { return static_cast<double>(image.rgb[p]); };
        const double weight = 1 / (of(brightness) * of(brightness) + 0.01);
        halves += weight * (std::pow(of(error[0]), 2) + std::pow(of(error[1]), 2)) / 2;
        difference += weight * std::pow(of(picture[0]) - of(picture[1]), 2) / 2;
      }
      too_large.push_back(halves - difference);
      by_halves += halves, by_pairs += difference;
    }
    std::cout << "sampler " << static_cast<int>(sampler) << ": variance by halves over variance by seeds "
              << by_halves / by_pairs << " +- " << estimate(too_large).error * pairs / by_pairs << "\n";
    EXPECT_GT(likelihood(estimate(too_large), 0), level) << "sampler " << static_cast<int>(sampler);
  }
}

}  // namespace
