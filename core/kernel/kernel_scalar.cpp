#include "kernel/path.h"

namespace glimt {

template void trace_block<float>(const CompiledScene&, const PathBlock&, float*);
template Rgb trace_given_ray<float>(const CompiledScene&, const GivenPath&);

}  // namespace glimt
