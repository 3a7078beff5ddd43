#include "kernel/path.h"

namespace glimt {

template void trace_block<NativeLanes>(const CompiledScene&, const PathBlock&, float*);
template Rgb trace_given_ray<NativeLanes>(const CompiledScene&, const GivenPath&);

}  // namespace glimt
