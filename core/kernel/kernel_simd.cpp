#include "kernel/path.h"

namespace glimt {

template void trace_block<KernelLanes>(const CompiledScene&, const PathBlock&, float*);
template Rgb trace_given_ray<KernelLanes>(const CompiledScene&, const GivenPath&);

}  // namespace glimt
