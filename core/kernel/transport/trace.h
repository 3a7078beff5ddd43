#pragma once

#include "kernel/entry/kernels.h"
#include "math/twice.h"

/// The kernel's entry points for one lane type. Defined in path.h and light_path.h; instantiated once in
/// kernel_scalar.cpp and once in kernel_simd.cpp.
namespace glimt {

template <class F>
void trace_block(const CompiledScene& scene, const PathBlock& block, float* rgb, std::span<std::uint64_t> by_chance);

template <class F>
void trace_light_block(const CompiledScene& scene, const LightBlock& block, std::vector<Splat>& splats);

template <class F>
Rgb trace_given_ray(const CompiledScene& scene, const GivenPath& path);

extern template void trace_block<float>(const CompiledScene&, const PathBlock&, float*, std::span<std::uint64_t>);
extern template void trace_block<KernelLanes>(const CompiledScene&, const PathBlock&, float*, std::span<std::uint64_t>);
extern template void trace_light_block<float>(const CompiledScene&, const LightBlock&, std::vector<Splat>&);
extern template void trace_light_block<KernelLanes>(const CompiledScene&, const LightBlock&, std::vector<Splat>&);
extern template Rgb trace_given_ray<float>(const CompiledScene&, const GivenPath&);
extern template Rgb trace_given_ray<KernelLanes>(const CompiledScene&, const GivenPath&);

}  // namespace glimt
