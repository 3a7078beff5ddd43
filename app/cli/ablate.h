#pragma once

#include "chart/runs.h"
#include "scene/scene.h"

namespace glimt {

/// Measures what each piece of the scene's model costs and buys, and prints it as a table on stdout. `show` asks for
/// progress on stderr.
void print_ablation(const Scene& scene, const Plan& plan, bool show);

}  // namespace glimt
