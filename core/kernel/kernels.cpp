#include "kernel/kernels.h"

#include "kernel/trace.h"

namespace glimt {

int native_lane_count() { return lane_count<KernelLanes>; }

void trace(const CompiledScene& scene, const PathBlock& block, Lanes lanes, float* rgb) {
  if (lanes == Lanes::scalar) {
    trace_block<float>(scene, block, rgb);
  } else {
    trace_block<KernelLanes>(scene, block, rgb);
  }
}

Rgb trace_ray(const CompiledScene& scene, const GivenPath& path, Lanes lanes) {
  return lanes == Lanes::scalar ? trace_given_ray<float>(scene, path) : trace_given_ray<KernelLanes>(scene, path);
}

}  // namespace glimt
