#include <cstdlib>

#include "cli/commands.h"
#include "cli/ranks.h"

/// Ranks without MPI: one process.
namespace glimt {

Ranks::Ranks() {
  for (const char* const name : {"OMPI_COMM_WORLD_SIZE", "PMI_SIZE"})
    if (const char* const size = std::getenv(name); size && std::atoi(size) > 1)
      throw BadInput("mpirun has started several processes, and this glimt is built without MPI; see docs/clusters.md");
}

Ranks::~Ranks() = default;

void Ranks::begin() {}

double Ranks::render(const CompiledScene& scene, Film& film, int count, const Execution& execution) {
  render_pass(scene, film, count, execution);
  return 0;
}

bool Ranks::wait_for_begin() { return false; }

void Ranks::help(const CompiledScene& /*scene*/, const Execution& /*execution*/) {}

void Ranks::abort() { std::exit(1); }

}  // namespace glimt
