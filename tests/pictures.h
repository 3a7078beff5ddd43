#pragma once

#include <bit>
#include <fstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "compile/compiled_scene.h"
#include "film/film.h"
#include "kernel/entry/kernels.h"
#include "render/render.h"
#include "statistics_helpers.h"

namespace glimt {

/// The radiance of every path.
inline std::vector<float> trace_all(const CompiledScene& scene, const PathBlock& block, Lanes lanes) {
  std::vector<float> rgb(3 * static_cast<std::size_t>(block.paths()), -1.0f);
  trace(scene, block, lanes, rgb.data());
  return rgb;
}

inline std::vector<float> trace_all(const CompiledScene& scene, int samples, Lanes lanes) {
  return trace_all(scene, {0, 0, scene.width, scene.height, 0, samples}, lanes);
}

/// Number of the first value whose bits differ, or -1. NaN equals itself.
inline std::ptrdiff_t first_difference(const std::vector<float>& a, const std::vector<float>& b) {
  for (std::size_t i = 0; i < std::max(a.size(), b.size()); ++i)
    if (i >= a.size() || i >= b.size() || std::bit_cast<std::uint32_t>(a[i]) != std::bit_cast<std::uint32_t>(b[i]))
      return static_cast<std::ptrdiff_t>(i);
  return -1;
}

/// "pixel (x, y), sample s": how to replay the path that gave value number `value` of the whole picture's block.
inline std::string replay(const CompiledScene& scene, std::ptrdiff_t value) {
  const std::ptrdiff_t path = value / 3, pixels = std::ptrdiff_t{scene.width} * scene.height;
  return "pixel (" + std::to_string(path % pixels % scene.width) + ", " + std::to_string(path % pixels / scene.width) +
         "), sample " + std::to_string(path / pixels) + ", seed " + std::to_string(scene.settings.seed);
}

inline Film render(const CompiledScene& scene, int samples, const Execution& execution = {}) {
  Film film = make_film(scene);
  render_pass(scene, film, samples, execution);
  if (film.invalid() != 0 || film.saturated() != 0)
    throw std::runtime_error("invalid or saturated samples in the film");
  return film;
}

/// Means over blocks of size x size pixels, row by row, three channels each.
inline std::vector<double> block_means(const Image& image, int size) {
  const int columns = image.width / size, rows = image.height / size;
  std::vector<double> means(static_cast<std::size_t>(3 * columns * rows));
  for (int y = 0; y < rows * size; ++y)
    for (int x = 0; x < columns * size; ++x)
      for (std::size_t c = 0; c < 3; ++c)
        means[3 * static_cast<std::size_t>(y / size * columns + x / size) + c] +=
            static_cast<double>(image.pixel(x, y)[c]) / (size * size);
  return means;
}

/// Pictures of one scene with independent seeds, reduced to block means.
struct Series {
  std::vector<std::vector<double>> blocks;  ///< by seed, then block and channel

  /// Mean over all blocks and channels, from one value per seed.
  Estimate overall() const {
    std::vector<double> means;
    for (const auto& b : blocks) {
      means.push_back(0);
      for (const double v : b) means.back() += v / static_cast<double>(b.size());
    }
    return estimate(means);
  }
  Estimate block(std::size_t i) const {
    std::vector<double> values;
    for (const auto& b : blocks) values.push_back(b[i]);
    return estimate(values);
  }
  std::size_t size() const { return blocks.front().size(); }
};

inline Series render_series(Scene scene, int seeds, int samples, int block_size) {
  Series series;
  for (int seed = 1; seed <= seeds; ++seed) {
    scene.render.seed = 1000 * seed + 7;
    series.blocks.push_back(block_means(render(compile(scene), samples).mean(), block_size));
  }
  return series;
}

/// Every third scene, for the usual run of the tests; with `others`, the rest, for the long run.
inline std::vector<Scene> every_third(const std::vector<Scene>& scenes, bool others = false) {
  std::vector<Scene> some;
  for (std::size_t i = 0; i < scenes.size(); ++i)
    if ((i % 3 != 0) == others) some.push_back(scenes[i]);
  return some;
}

}  // namespace glimt
