#include "cli/ablate.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "chart/ablation.h"
#include "cli/progress_bar.h"

namespace glimt {
namespace {

std::string difference_text(const Ablation& a) {
  char text[48];
  std::snprintf(text, sizeof text, "%.1e +- %.0e", std::max(a.difference, 0.0), a.difference_error);
  return text;
}

}  // namespace

void print_ablation(const Scene& scene, const Plan& plan, bool show) {
  const std::vector<Piece> pieces = pieces_of(scene);
  std::vector<Ablation> results;
  {
    ProgressBar bar;
    results = ablate(scene, pieces, plan, [&bar, show](double done) { show ? bar.show(done) : void(); });
  }
  std::size_t widest = 6;
  for (const Piece& piece : pieces) widest = std::max(widest, piece.name.size());
  const int column = static_cast<int>(widest);
  std::printf(
      "One piece of \"%s\" changed at a time, %d spp, %d seeds; all but the difference in %% of the scene's own.\n",
      scene.name.c_str(), plan.spp, plan.seeds);
  std::printf(
      "Difference: relmse between the images without their noise; below %.0e they are taken to be the same.\n\n",
      visible_difference);
  std::printf("%-*s %7s %8s %11s  %-18s  %s\n", column, "change", "time", "relmse", "efficiency", "difference",
              "verdict");
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    const Ablation& a = results[i];
    std::printf("%-*s %6.0f%% %7.0f%% %10.0f%%  %-18s  %s\n", column, pieces[i].name.c_str(), 100 * a.time,
                100 * a.noise, 100 * a.efficiency, difference_text(a).c_str(), verdict(pieces[i], a).c_str());
  }
}

}  // namespace glimt
