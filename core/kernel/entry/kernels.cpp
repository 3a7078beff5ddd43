#include "kernel/entry/kernels.h"

#include "kernel/transport/trace.h"

namespace glimt {

int native_lane_count() { return lane_count<KernelLanes>; }

void trace(const CompiledScene& scene, const PathBlock& block, Lanes lanes, float* rgb,
           std::span<std::uint64_t> by_chance) {
  if (lanes == Lanes::scalar) {
    trace_block<float>(scene, block, rgb, by_chance);
  } else {
    trace_block<KernelLanes>(scene, block, rgb, by_chance);
  }
}

void trace_light(const CompiledScene& scene, const LightBlock& block, Lanes lanes, std::vector<Splat>& splats) {
  if (lanes == Lanes::scalar) {
    trace_light_block<float>(scene, block, splats);
  } else {
    trace_light_block<KernelLanes>(scene, block, splats);
  }
}

Rgb trace_ray(const CompiledScene& scene, const GivenPath& path, Lanes lanes) {
  return lanes == Lanes::scalar ? trace_given_ray<float>(scene, path) : trace_given_ray<KernelLanes>(scene, path);
}

}  // namespace glimt
