#pragma once

#include "chart/runs.h"
#include "scene/scene.h"

namespace glimt {

/// Measures what each piece of the scene's model costs and buys, and prints a table on stdout. With `show`, progress
/// appears on stderr.
void print_ablation(const Scene& scene, const Plan& plan, bool show);

}  // namespace glimt
