#pragma once

#include <vector>

#include "render/render.h"

namespace glimt {

/// The processes that mpirun has started to render one picture. Where it has not, there is one, and it leads.
///
/// A round: the leader gives each rank samples of its own, all render, and their sums go to the leader. Sums are
/// integers and samples have numbers, so the picture does not depend on how many ranks there are.
class Ranks {
 public:
  /// Joins the others. Throws BadInput where mpirun has started several and this glimt is built without MPI.
  Ranks();
  /// The leader's sends the others home.
  ~Ranks();
  Ranks(const Ranks&) = delete;
  Ranks& operator=(const Ranks&) = delete;

  bool lead() const { return number_ == 0; }
  int number() const { return number_; }
  int count() const { return count_; }

  /// Tells those who wait that the scene is good and that rounds will come; for the leader.
  void begin();
  /// Adds the next `count` samples of every pixel to the leader's film. Returns how many seconds of it went into adding
  /// up, however many samples there are.
  double render(const CompiledScene& scene, Film& film, int count, const Execution& execution);

  /// Whether the leader has begun; false where it has given up. For the others, as what follows.
  bool wait_for_begin();
  /// Takes part in rounds until the leader has ended.
  void help(const CompiledScene& scene, const Execution& execution);
  /// Ends all ranks at once, for one that cannot go on.
  [[noreturn]] static void abort();

 private:
  int number_ = 0, count_ = 1;
  bool joined_ = false, begun_ = false;
  std::vector<double> speeds_;  ///< of each rank when it last had samples, samples a second
};

}  // namespace glimt
