#include "cli/ablate.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>

#include "chart/ablation.h"
#include "chart/families.h"
#include "chart/materials.h"
#include "cli/progress_bar.h"

namespace glimt {
namespace {

std::string difference_text(const Ablation& a) {
  char text[48];
  std::snprintf(text, sizeof text, "%.1e +- %.0e", std::max(a.difference, 0.0), a.difference_error);
  return text;
}

void print_families(const Scene& scene, Plan plan, bool show) {
  plan.seconds = std::numeric_limits<double>::infinity();
  Families families;
  {
    ProgressBar bar;
    families = measure_families(scene, plan, [&bar, show](double done) { show ? bar.show(done) : void(); });
  }
  std::printf(
      "\nThe error of \"%s\" by the light that it is of and by what the pixel sees first; quartiles over seeds.\n\n",
      scene.name.c_str());
  std::printf("%-32s %8s %6s  %-9s %6s\n", "family", "error", "share", "quartiles", "pixels");
  for (std::size_t i = 0; i < families.all.size(); ++i) {
    const Family& f = families.all.at(i);
    std::printf("%-32s %8.1e %5.0f%%  %3.0f..%3.0f%% %5.1f%%\n", family_texts.at(i).name.data(), f.error, 100 * f.share,
                100 * f.low, 100 * f.high, 100 * f.pixels);
  }
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
      "Errors are relmse_scaled. The difference is that between the images without noise; below %.0e they are the "
      "same.\n\n",
      visible_difference);
  std::printf("%-*s %7s %8s %11s  %-18s  %s\n", column, "change", "time", "error", "efficiency", "difference",
              "verdict");
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    const Ablation& a = results[i];
    std::printf("%-*s %6.0f%% %7.0f%% %10.0f%%  %-18s  %s\n", column, pieces[i].name.c_str(), 100 * a.time,
                100 * a.noise, 100 * a.efficiency, difference_text(a).c_str(), verdict(pieces[i], a).c_str());
  }
  if (has_specular(scene)) print_families(scene, plan, show);
}

}  // namespace glimt
