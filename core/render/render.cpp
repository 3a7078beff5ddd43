#include "render/render.h"

#include <omp.h>

#include <algorithm>
#include <exception>
#include <mutex>
#include <vector>

namespace glimt {

namespace {

constexpr int tile_size = 32;  ///< side of a square tile, pixels
constexpr int block_paths =
    4096;  ///< paths that a thread traces before it checks `cancel`; their radiance fits the cache
constexpr int light_block_paths = 1024;

/// Tiles that cover the film. One thread works on a tile at a time, so no two threads add to the same pixel.
std::vector<PathBlock> tiles_of(const Film& film) {
  std::vector<PathBlock> tiles;
  for (int y = 0; y < film.height(); y += tile_size)
    for (int x = 0; x < film.width(); x += tile_size)
      tiles.push_back({x, y, std::min(tile_size, film.width() - x), std::min(tile_size, film.height() - y), 0, 0});
  return tiles;
}

void add_to_film(Film& film, const PathBlock& block, const float* rgb) {
  for (int sample = 0; sample < block.samples; ++sample) {
    const int half = static_cast<int>((block.first_sample + static_cast<std::uint32_t>(sample)) & 1u);
    const auto row = 3 * static_cast<std::size_t>(block.width);
    for (int y = block.y0; y < block.y0 + block.height; ++y, rgb += row)
      film.add(y * film.width() + block.x0, half, {rgb, row});
  }
}

}  // namespace

int hardware_threads() { return omp_get_num_procs(); }

Film make_film(const CompiledScene& scene) {
  return Film(scene.width, scene.height, scene.max_radiance, scene.emitters);
}

bool render_pass(const CompiledScene& scene, Film& film, int count, const Execution& execution,
                 const std::atomic<bool>* cancel, PassProgress* progress) {
  const std::vector<PathBlock> tiles = tiles_of(film);
  const auto tile_count = static_cast<std::ptrdiff_t>(tiles.size());
  const std::ptrdiff_t light_count = (scene.light_paths + light_block_paths - 1) / light_block_paths;
  const int threads = execution.threads > 0 ? execution.threads : hardware_threads();
  std::atomic<bool> stop{false};
  PassProgress done(static_cast<std::size_t>(tile_count + light_count), 0);
  if (progress && progress->size() == done.size()) done.swap(*progress);
  std::exception_ptr failure;
  std::mutex failure_mutex;

  // trace(first sample) returns how many samples of its part it has traced. Exceptions must not leave a parallel loop.
  const auto all_samples = [&](std::ptrdiff_t part, auto trace) {
    try {
      for (int& first = done[static_cast<std::size_t>(part)]; first < count;) {
        if (cancel && cancel->load(std::memory_order_relaxed)) stop = true;
        if (stop.load(std::memory_order_relaxed)) break;
        first += trace(first);
      }
    } catch (...) {
      const std::lock_guard lock(failure_mutex);
      failure = std::current_exception();
      stop = true;
    }
  };
  const auto sample_number = [first = film.missing().first](int sample) {
    return static_cast<std::uint32_t>(first + sample);
  };

#pragma omp parallel num_threads(threads)
  {
    std::vector<float> rgb;
    std::vector<std::uint64_t> by_chance;
    std::vector<Splat> splats;
#pragma omp for schedule(dynamic)
    for (std::ptrdiff_t i = 0; i < tile_count; ++i) {
      all_samples(i, [&](int first) {
        rgb.resize(3 * block_paths);
        PathBlock block = tiles[static_cast<std::size_t>(i)];
        block.first_sample = sample_number(first);
        block.samples = std::min(block_paths / (block.width * block.height), count - first);
        by_chance.assign(film.by_chance().size(), 0);
        trace(scene, block, execution.lanes, rgb.data(), by_chance);
        add_to_film(film, block, rgb.data());
        film.add_by_chance(by_chance);
        return block.samples;
      });
    }
    // Splats go to any pixel, so from here on threads share all pixels.
#pragma omp for schedule(dynamic)
    for (std::ptrdiff_t i = 0; i < light_count; ++i) {
      all_samples(tile_count + i, [&](int sample) {
        const int first = static_cast<int>(i) * light_block_paths;
        const LightBlock block{first, std::min(light_block_paths, scene.light_paths - first), sample_number(sample)};
        splats.clear();
        trace_light(scene, block, execution.lanes, splats);
        film.add(static_cast<int>(block.sample & 1u), splats);
        return 1;
      });
    }
  }
  if (failure) std::rethrow_exception(failure);
  if (progress) progress->clear();
  if (stop) {
    if (progress) progress->swap(done);
    return false;
  }
  film.finish_pass(count);
  return true;
}

}  // namespace glimt
