#include "cli/cli.h"

int main(int argc, char** argv) { return glimt::run_cli(argc, argv); }
