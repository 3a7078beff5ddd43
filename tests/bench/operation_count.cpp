// operation_count SCENE: the operations of the kernel per path, as JSON: "needed" by paths one at a time, and
// "executed" in batches of all lanes. 16 samples per pixel of an image an eighth as wide and high as the scene's.
#include <cstdio>
#include <exception>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <vector>

#include "counted_lanes.h"
#include "scene/file/scene_file.h"

namespace {

using namespace glimt;

constexpr int samples = 16, tile = 16;  // pixels, as wide as the renderer's

/// Operations per path of the kernel for V. Throws where it does not render what the kernel itself renders.
template <class V>
nlohmann::json operations(const CompiledScene& scene) {
  operation_counts.fill(0);
  std::vector<std::uint64_t> by_chance(chance_counters(scene.emitters.size()));
  int paths = 0;
  for (int y = 0; y < scene.height; y += tile)
    for (int x = 0; x < scene.width; x += tile) {
      const PathBlock block{x, y, std::min(tile, scene.width - x), std::min(tile, scene.height - y), 0, samples};
      const std::size_t values = 3 * static_cast<std::size_t>(block.paths());
      std::vector<float> counted_rgb(values), rgb(values);
      trace_block<Counted<V>>(scene, block, counted_rgb.data(), by_chance);
      trace_block<V>(scene, block, rgb.data(), by_chance);
      if (rgb != counted_rgb) throw std::runtime_error("the counted kernel renders another image");
      paths += block.paths();
    }
  nlohmann::json result;
  for (std::size_t i = 0; i < operation_kinds; ++i)
    result[operation_names[i]] = static_cast<double>(operation_counts[i]) / paths;
  return result;
}

}  // namespace

int main(int argc, char** argv) try {
  if (argc != 2) throw std::runtime_error("usage: operation_count SCENE");
  Scene scene = read_scene(argv[1]);
  scene.image = {std::max(scene.image.width / 8, 1), std::max(scene.image.height / 8, 1)};
  const CompiledScene compiled = compile(scene);
  const nlohmann::json result{{"lanes", lane_count<NativeLanes>},
                              {"needed", operations<float>(compiled)},
                              {"executed", operations<NativeLanes>(compiled)}};
  std::puts(result.dump(1).c_str());
} catch (const std::exception& error) {
  std::fprintf(stderr, "operation_count: %s\n", error.what());
  return 1;
}
