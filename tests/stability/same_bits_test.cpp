// One picture, however the work is spread.
#include <gtest/gtest.h>

#include "pictures.h"
#include "random_scene.h"

using namespace glimt;

namespace {

constexpr std::array light_samplings{LightSampling::none, LightSampling::area, LightSampling::solid_angle,
                                     LightSampling::automatic};
constexpr std::array samplers{Sampler::independent, Sampler::stratified, Sampler::lattice, Sampler::sobol,
                              Sampler::centres};

std::vector<std::array<double, 3>> sums(const Film& film) {
  std::vector<std::array<double, 3>> result;
  for (int pixel = 0; pixel < film.width() * film.height(); ++pixel)
    for (const int half : {0, 1}) result.push_back(film.half_sum(pixel, half));
  return result;
}

// Failure: a picture that cannot be made again on another machine, or a bug that goes away when it is looked at in one
// lane. Every combination of settings, in scenes that between them use every feature of the kernel; several tiles.
TEST(SameBits, ForAllSettingsThreadsAndLanes) {
  unsigned number = 0;
  for (const LightSampling light_sampling : light_samplings)
    for (const Mis mis : {Mis::off, Mis::on})
      for (const Sampler sampler : samplers)
        for (const Roulette roulette : {Roulette::throughput, Roulette::constant})
          for (const Caustics caustics : {Caustics::off, Caustics::on})
            for (const int max_depth : {0, 4}) {
              if (++number % 8 != 0 && effort == 1) continue;
              Scene scene = RandomScene(number % 25).scene;
              scene.image = {34, 33};
              scene.render.light_sampling = light_sampling;
              scene.render.mis = mis;
              scene.render.sampler = sampler;
              scene.render.roulette = roulette;
              scene.render.caustics = caustics;
              scene.render.max_depth = max_depth;
              const CompiledScene compiled = compile(scene);
              const auto one = sums(render(compiled, 2, {.threads = 1}));
              const std::string what = scene.name + ", combination " + std::to_string(number);
              ASSERT_EQ(sums(render(compiled, 2, {.threads = 4})), one) << what << ", four threads";
              ASSERT_EQ(sums(render(compiled, 2, {.threads = 2, .lanes = Lanes::scalar})), one)
                  << what << ", two threads, one lane";
            }
  EXPECT_EQ(number, 320u);
}

}  // namespace
