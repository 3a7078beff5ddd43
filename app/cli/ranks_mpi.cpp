#include <mpi.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <span>
#include <vector>

#include "cli/ranks.h"

/// Ranks with MPI. Only the thread that makes them calls MPI.
namespace glimt {
namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

/// Whether something like mpirun has started this process.
bool started_by_mpirun() {
  constexpr std::array names{"OMPI_COMM_WORLD_SIZE", "PMI_SIZE", "PMIX_RANK"};
  return std::ranges::any_of(names, [](const char* name) { return std::getenv(name) != nullptr; });
}

/// Sums stop at the largest, as those of a film do.
void add_sums(void* in, void* in_out, int* length, MPI_Datatype* /*type*/) {
  constexpr std::uint64_t largest = INT64_MAX;
  const std::span added(static_cast<const std::uint64_t*>(in), static_cast<std::size_t>(*length));
  std::uint64_t* sum = static_cast<std::uint64_t*>(in_out);
  for (const std::uint64_t value : added) {
    *sum = std::min(*sum + value, largest);
    ++sum;
  }
}

class SumOperation {
 public:
  SumOperation() { MPI_Op_create(&add_sums, 1, &operation_); }
  ~SumOperation() { MPI_Op_free(&operation_); }
  SumOperation(const SumOperation&) = delete;
  SumOperation& operator=(const SumOperation&) = delete;

  /// The leader's values become the sums over all ranks.
  void add_up(std::span<std::uint64_t> values, bool lead) const {
    constexpr std::size_t most = 1 << 28;  // values of one call, whose count is an int
    for (std::size_t first = 0; first < values.size(); first += most) {
      const auto part = values.subspan(first, std::min(most, values.size() - first));
      MPI_Reduce(lead ? MPI_IN_PLACE : part.data(), lead ? part.data() : nullptr, static_cast<int>(part.size()),
                 MPI_UINT64_T, operation_, 0, MPI_COMM_WORLD);
    }
  }

 private:
  MPI_Op operation_{};
};

/// The leader's film gets the sums of the others, which hold the `count` samples that it misses next.
void add_up(Film& film, int count, bool lead) {
  const SumOperation sum;
  for (const int h : {0, 1}) sum.add_up(film.sums(h), lead);
  std::vector<std::uint64_t> counters(2 + film.by_chance().size());
  if (!lead) {
    counters[0] = film.invalid();
    counters[1] = film.saturated();
    std::ranges::copy(film.by_chance(), counters.begin() + 2);
  }
  sum.add_up(counters, lead);
  if (!lead) return;
  if (count > 0) film.finish_pass(count);
  film.set_contents(film.ranges(), film.invalid() + counters[0], film.saturated() + counters[1]);
  film.add_by_chance(std::span(counters).subspan(2));
}

/// Shares a round out by how many samples a second each rank has rendered before.
std::vector<SampleRange> shares_of(SampleRange round, const std::vector<double>& speeds) {
  std::vector<SampleRange> shares;
  double speed_left = 0;
  for (const double speed : speeds) speed_left += speed;
  int next = round.first;
  for (const double speed : speeds) {
    const double left = round.end() - next;
    const int count = shares.size() + 1 == speeds.size() ? round.end() - next
                                                         : static_cast<int>(std::lround(left * speed / speed_left));
    shares.push_back({next, count});
    next += count;
    speed_left -= speed;
  }
  return shares;
}

constexpr SampleRange go_home{0, -1};

/// Gives each rank its share; returns the own one.
SampleRange scatter(const std::vector<SampleRange>& shares) {
  static_assert(sizeof(SampleRange) == 2 * sizeof(int));
  SampleRange own;
  MPI_Scatter(shares.data(), 2, MPI_INT, &own, 2, MPI_INT, 0, MPI_COMM_WORLD);
  return own;
}

/// Renders the first `count` missing samples of the film; returns samples a second, 0 without samples.
double render_share(const CompiledScene& scene, Film& film, int count, const Execution& execution) {
  if (count == 0) return 0;
  const auto start = Clock::now();
  render_pass(scene, film, count, execution);
  return count / std::max(seconds_since(start), 1e-9);
}

/// The leader's vector gets the speed of every rank that had samples.
void gather_speeds(double own, std::vector<double>& speeds) {
  std::vector<double> now(speeds.size());
  MPI_Gather(&own, 1, MPI_DOUBLE, now.data(), 1, MPI_DOUBLE, 0, MPI_COMM_WORLD);
  for (std::size_t i = 0; i < now.size(); ++i)
    if (now[i] > 0) speeds[i] = now[i];
}

void share(int& value) { MPI_Bcast(&value, 1, MPI_INT, 0, MPI_COMM_WORLD); }

}  // namespace

Ranks::Ranks() {
  if (!started_by_mpirun()) return;
  int provided = 0;
  MPI_Init_thread(nullptr, nullptr, MPI_THREAD_FUNNELED, &provided);
  joined_ = true;
  MPI_Comm_rank(MPI_COMM_WORLD, &number_);
  MPI_Comm_size(MPI_COMM_WORLD, &count_);
  if (lead()) speeds_.assign(static_cast<std::size_t>(count_), 1.0);
}

Ranks::~Ranks() {
  if (!joined_) return;
  if (lead() && begun_) {
    scatter(std::vector(speeds_.size(), go_home));
  } else if (lead()) {
    int begins = 0;
    share(begins);
  }
  MPI_Finalize();
}

void Ranks::begin() {
  begun_ = true;
  int begins = 1;
  if (joined_) share(begins);
}

double Ranks::render(const CompiledScene& scene, Film& film, int count, const Execution& execution) {
  if (count_ == 1) {
    render_pass(scene, film, count, execution);
    return 0;
  }
  try {
    const SampleRange own = scatter(shares_of({film.missing().first, count}, speeds_));
    const double speed = render_share(scene, film, own.count, execution);
    gather_speeds(speed, speeds_);
    const auto start = Clock::now();
    add_up(film, count - own.count, true);
    return seconds_since(start);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    abort();
  }
}

bool Ranks::wait_for_begin() {
  int begins = 0;
  share(begins);
  return begins != 0;
}

void Ranks::help(const CompiledScene& scene, const Execution& execution) {
  std::vector<double> none;
  for (SampleRange own = scatter({}); own != go_home; own = scatter({})) {
    Film film = make_film(scene);
    film.go_on_from(own.first);
    gather_speeds(render_share(scene, film, own.count, execution), none);
    add_up(film, 0, false);
  }
}

void Ranks::abort() {
  MPI_Abort(MPI_COMM_WORLD, EXIT_FAILURE);
  std::exit(EXIT_FAILURE);
}

}  // namespace glimt
