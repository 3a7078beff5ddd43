#pragma once

namespace glimt {

/// Runs the program `glimt`. Returns its exit status: 0 for success, 1 for a failed run, 2 for bad use or bad input.
int run_cli(int argc, char** argv);

}  // namespace glimt
