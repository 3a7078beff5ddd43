// The picture after an edit that goes on from the one before: core/README.md, "An edit is a difference".
#include "film/continuation.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include "film/statistics.h"
#include "pictures.h"
#include "scene/file/scene_file.h"

using namespace glimt;

namespace {

constexpr int many = 64, few = 4;  // samples before and after the edit

Scene room(int size, const std::vector<std::string>& overrides = {}) {
  Scene scene = read_scene(GLIMT_SCENES "/hexagon.toml", overrides);
  scene.image = {size, size};
  return scene;
}

struct SceneEdit {
  const char* name;
  std::string override;
};

const std::vector<SceneEdit> edits{{"white_darker", "material.white.reflectance=[0.6, 0.6, 0.6]"},
                                   {"red_blue", "material.red.reflectance=[0.15, 0.15, 0.75]"},
                                   {"other_index", "material.glass.ior=1.4"},
                                   {"ball_moved", "sphere.oren-nayar.center=[7.0, -3.8, -0.8]"}};

/// A film of so many samples, and what it had after its first `few`.
struct Rendered {
  Film film;
  FirstSamples first;
};

Rendered rendered(const Scene& scene, int samples) {
  const CompiledScene compiled = compile(scene);
  Rendered result{make_film(compiled), {}};
  while (result.film.samples() < samples) {
    const int next = result.first.next(result.film);
    render_pass(compiled, result.film, (next > 0 ? std::min(next, samples) : samples) - result.film.samples(), {});
    result.first.look_at(result.film);
  }
  return result;
}

/// The picture of `after` with a few samples, gone on from many of `before`.
Film continued(const Scene& before, const Scene& after) {
  const Rendered old = rendered(before, many), now = rendered(after, few);
  return corrected(now.film, continue_from(old.film, old.first.entries().at(few), now.first.entries().at(few), few,
                                           now.film.scale()));
}

Scene seeded(Scene scene, int seed) {
  scene.render.seed = seed;
  return scene;
}

class Continuation : public testing::TestWithParam<SceneEdit> {};

// A brighter lamp makes the same paths brighter, so the few samples know all: the picture is that of the many.
TEST(ContinuationOfALamp, IsExact) {
  const Scene before = room(80), after = room(80, {"material.lamp.radiance=[25, 25, 25]"});
  const Image picture = continued(before, after).mean(), fresh = rendered(after, many).film.mean();
  const double bright = mean(fresh);
  for (std::size_t i = 0; i < picture.rgb.size(); ++i)
    ASSERT_NEAR(picture.rgb[i], fresh.rgb[i], 1e-4 * (bright + fresh.rgb[i])) << "value " << i;
}

// The same mean as fresh renders, block by block. Student's t of the difference over seeds; a false alarm in 1e-4 of
// all choices of seeds, for all blocks of an edit together.
TEST_P(Continuation, HasTheMeanOfFreshPictures) {
  const Scene before = room(48), after = room(48, {GetParam().override});
  constexpr int seeds = 8 * effort, block = 16;
  Series series, fresh;
  for (int seed = 1; seed <= seeds; ++seed) {
    series.blocks.push_back(block_means(continued(seeded(before, seed), seeded(after, seed)).mean(), block));
    fresh.blocks.push_back(block_means(rendered(seeded(after, 10'000 + seed), many / 4).film.mean(), block));
  }
  const double alpha = sidak(1e-4, static_cast<double>(series.size()));
  for (std::size_t i = 0; i < series.size(); ++i) {
    const Estimate a = series.block(i), b = fresh.block(i);
    EXPECT_GT(likelihood(a, b), alpha) << "block " << i / 3 << ", channel " << i % 3 << ": " << a.mean << " and "
                                       << b.mean;
  }
}

/// Sum of squares of `difference`, each relative to the reference.
double relative_squares(const Image& reference, const std::function<double(std::size_t)>& difference) {
  double sum = 0;
  for (std::size_t i = 0; i < reference.rgb.size(); ++i) {
    const double r = reference.rgb[i];
    sum += difference(i) * difference(i) / (r * r + 0.01);
  }
  return sum;
}

// The error that the halves tell is the true one: within a tenth over the seeds.
TEST_P(Continuation, HalvesTellItsTrueError) {
  const Scene before = room(48), after = room(48, {GetParam().override});
  const Image reference = rendered(seeded(after, 77'777), 512 * effort).film.mean();
  double stated = 0, true_error = 0;
  for (int seed = 1; seed <= 4 * effort; ++seed) {
    const Film film = continued(seeded(before, seed), seeded(after, seed));
    const Image mean = film.mean(), h0 = film.half_mean(0), h1 = film.half_mean(1);
    stated += relative_squares(reference, [&](std::size_t i) { return (h0.rgb[i] - h1.rgb[i]) / 2; });
    true_error += relative_squares(reference, [&](std::size_t i) { return mean.rgb[i] - reference.rgb[i]; });
  }
  EXPECT_NEAR(stated / true_error, 1, 0.1);
}

// It is never worse than a fresh picture of as many samples, and mostly far better.
TEST_P(Continuation, IsNoWorseThanAFreshPicture) {
  const Scene before = room(64), after = room(64, {GetParam().override});
  const Image reference = rendered(seeded(after, 77'777), 128 * effort).film.mean();
  double going_on = 0, anew = 0;
  for (int seed = 1; seed <= effort; ++seed) {
    going_on += compare(continued(seeded(before, seed), seeded(after, seed)).mean(), reference).relmse999;
    anew += compare(rendered(seeded(after, seed), few).film.mean(), reference).relmse999;
  }
  EXPECT_LT(going_on, 1.02 * anew);
  RecordProperty("share_of_error", std::to_string(going_on / anew));
}

constexpr auto name_of_edit = [](const auto& edit) { return std::string(edit.param.name); };
INSTANTIATE_TEST_SUITE_P(, Continuation, testing::ValuesIn(edits.begin(), edits.begin() + 2), name_of_edit);
INSTANTIATE_TEST_SUITE_P(MoreEditsLong, Continuation, testing::ValuesIn(edits.begin() + 2, edits.end()), name_of_edit);

}  // namespace
