#include "kernel/transport/light_path.h"
#include "kernel/transport/path.h"

namespace glimt {

template void trace_block<KernelLanes>(const CompiledScene&, const PathBlock&, float*, std::span<std::uint64_t>);
template void trace_light_block<KernelLanes>(const CompiledScene&, const LightBlock&, std::vector<Splat>&);
template Rgb trace_given_ray<KernelLanes>(const CompiledScene&, const GivenPath&);

}  // namespace glimt
