#pragma once

namespace glimt {

/// The program `glimt`. Returns its exit status: 0, 1 for a run that failed, 2 for bad use or bad input.
int run_cli(int argc, char** argv);

}  // namespace glimt
