#include <algorithm>
#include <chrono>
#include <cmath>
#include <numbers>
#include <numeric>

#include "chart/ablation.h"
#include "chart/runs.h"
#include "cli/report_parts.h"
#include "compile/compiled_scene.h"
#include "material/glass.h"
#include "material/oren_nayar.h"

namespace glimt {
namespace {

constexpr int report_cores = 4;

/// Seconds that each tile of the picture takes on one core. The least of five runs leaves out other load on the
/// machine.
std::vector<double> tile_seconds(const CompiledScene& scene, int tile, int spp) {
  std::vector<double> least;
  std::vector<float> rgb(3 * static_cast<std::size_t>(tile * tile * spp));
  for (int repeat = 0; repeat < 5; ++repeat) {
    std::size_t i = 0;
    for (int y = 0; y < scene.height; y += tile)
      for (int x = 0; x < scene.width; x += tile, ++i) {
        const PathBlock block{x, y, std::min(tile, scene.width - x), std::min(tile, scene.height - y), 0, spp};
        const auto start = std::chrono::steady_clock::now();
        trace(scene, block, Lanes::native, rgb.data());
        const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
        if (repeat == 0) least.push_back(seconds);
        least[i] = std::min(least[i], seconds);
      }
  }
  return least;
}

/// Share of the cores' time spent working where each core gets an equal run of adjacent tiles.
double use_in_bands(const std::vector<double>& seconds) {
  std::vector<double> loads(report_cores, 0);
  for (std::size_t i = 0; i < seconds.size(); ++i) loads[i * report_cores / seconds.size()] += seconds[i];
  return std::accumulate(loads.begin(), loads.end(), 0.0) / (report_cores * std::ranges::max(loads));
}

/// The same where a core that has finished takes the next tile.
double use_in_turn(const std::vector<double>& seconds) {
  std::vector<double> loads(report_cores, 0);
  for (const double s : seconds) *std::ranges::min_element(loads) += s;
  return std::accumulate(loads.begin(), loads.end(), 0.0) / (report_cores * std::ranges::max(loads));
}

std::string percent(double share) { return figure_text(100 * share) + " %"; }

Piece changed(const Scene& scene, const std::string& name, bool model, void (*change)(Scene&)) {
  Piece piece{name, model, scene};
  change(piece.scene);
  return piece;
}

void published_to_report(Scene& scene) {
  for (Material& m : scene.materials) m.set(OrenNayar::formula, OrenNayarFormula::report);
}
void exact_to_schlick(Scene& scene) {
  for (Material& m : scene.materials) m.set(Glass::fresnel, Fresnel::schlick);
}
void all_of_it(Scene& scene) {
  set_method(scene.render, Method::report);
  published_to_report(scene);
  exact_to_schlick(scene);
}

void add_ablation(Page& page, const ReportPlan& plan, const Scene& scene, const std::vector<Piece>& pieces,
                  const std::string& caption) {
  const Plan runs{.seeds = plan.quick ? 2 : 6, .spp = plan.spp(64), .execution = plan.execution};
  const auto found = ablate(scene, pieces, runs, {});
  std::vector<Page::Row> rows;
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    const Ablation& a = found[i];
    const double difference = std::max(a.difference, 0.0);
    rows.push_back({pieces[i].name, figure_text(difference) + " ± " + figure_text(a.difference_error),
                    percent(std::sqrt(difference)), percent(a.mean - 1), "× " + figure_text(a.time),
                    "× " + figure_text(a.efficiency), verdict(pieces[i], a)});
  }
  page.table({"", "relmse_scaled of the difference", "its root", "mean radiance", "time", "efficiency", "verdict"},
             rows,
             caption + " Against path with one shadow ray, " + std::to_string(runs.spp) + " spp, " +
                 std::to_string(runs.seeds) + " seeds; differences are without noise.");
}

}  // namespace

void add_balance(Page& page, const ReportPlan& plan) {
  plan.say("load balance");
  page.heading("Load balance: glass against diffuse");
  page.paragraph(
      "The report saw its processors idle while it rendered glass. Here is the time that each tile of the "
      "one-sphere room takes on one core, and from it the share of four cores' time that is work: with an "
      "equal band of the picture for each core, and as glimt does it, where a core that is done takes the "
      "next tile.");
  const int tile = plan.quick ? 8 : 16;
  std::vector<Page::Row> rows;
  for (const char* material : {"white", "mirror", "glass"}) {
    const Scene scene = report_scene(plan, "sphere", {std::string("sphere.sphere.material=") + material});
    const auto seconds = tile_seconds(compile(scene), tile, plan.spp(64));
    const double mean = std::accumulate(seconds.begin(), seconds.end(), 0.0) / static_cast<double>(seconds.size());
    rows.push_back({material == std::string("white") ? "Lambertian" : material, figure_text(1000 * mean) + " ms",
                    "× " + figure_text(std::ranges::max(seconds) / mean), percent(use_in_bands(seconds)),
                    percent(use_in_turn(seconds))});
  }
  page.table({"sphere", "a tile takes", "the slowest", "cores used, bands", "cores used, tiles in turn"}, rows,
             "Tiles of " + std::to_string(tile) + "x" + std::to_string(tile) + " pixels, " +
                 std::to_string(plan.spp(64)) + " spp.");
}

void add_errors(Page& page, const ReportPlan& plan) {
  plan.say("where the report errs");
  page.heading("Where the report errs, and by how much");
  const Scene room = report_scene(plan, "full");
  add_ablation(
      page, plan, room,
      {changed(room, "caustics left out (2.5.3)", true, [](Scene& s) { s.render.caustics = Caustics::off; }),
       changed(room, "sin·sin for sin·tan in Oren-Nayar (equation 7)", true, published_to_report),
       changed(room, "Schlick for Fresnel (equation 9)", true, exact_to_schlick),
       changed(room, "sub-pixel centres (2.6)", false, [](Scene& s) { s.render.sampler = Sampler::centres; }),
       changed(room, "roulette at 0.75 (2.6)", false, [](Scene& s) { s.render.roulette = Roulette::constant; }),
       changed(room, "30 shadow rays (3)", false, [](Scene& s) { s.render.shadow_rays = 30; }),
       changed(room, "all of the report's model, one shadow ray", true, all_of_it)},
      "The full room.");
  const Scene sphere = report_scene(plan, "sphere", {"material.clay.roughness=1"});
  add_ablation(page, plan, sphere,
               {changed(sphere, "sin·sin for sin·tan in Oren-Nayar (equation 7)", true, published_to_report)},
               "The sphere of Figure 3 with roughness 1.");
  const double degree = 180 / std::numbers::pi;
  page.paragraph(
      "In words: equation 11 gives the critical angle, " + figure_text(std::asin(1 / 1.5) * degree) +
      " degrees inside the glass here, beyond which all light is reflected. Brewster's angle, whose name it has "
      "there, is " +
      figure_text(std::atan(1 / 1.5) * degree) +
      " degrees, where light of one polarisation is not reflected at all. Equations 16 and 17 have the lamp's "
      "radiance where the arriving radiance belongs. The report thinks that eight shadow rays are enough for it: "
      "Table 3 and the row above show what more than one costs.");
}

void add_chart(Page& page, const ReportPlan& plan) {
  plan.say("error against time");
  page.heading("Speed against accuracy");
  const std::string side = std::to_string(plan.side() / 2);
  std::vector<Variant> variants;
  const auto scene_of = [&](const char* method) {
    Scene scene = report_scene(plan, "full", {std::string("render.method=") + method});
    scene.image = {plan.side() / 2, plan.side() / 2};
    return scene;
  };
  for (const char* method : {"report", "naive", "path"})
    variants.push_back({method, method, compile(scene_of(method))});
  Scene truth = scene_of("path");
  truth.render.seed = 1000;
  const CompiledScene compiled = compile(truth);
  Film reference = make_film(compiled);
  render_pass(compiled, reference, plan.spp(8192), plan.execution);
  const Image image = reference.mean();
  const Plan runs{.seeds = 3, .spp = plan.spp(1024), .seconds = 1e9, .execution = plan.execution};
  Chart chart = error_chart(variants, measure(variants, runs, &image, {}));
  chart.title = "The full room, " + side + "x" + side + " pixels, one shadow ray";
  page.chart(svg_chart(chart), "The reference is a picture by path of " + std::to_string(reference.samples()) +
                                   " spp with relmse_scaled " + figure_text(estimate_error(reference).relmse_scaled) +
                                   ", as it estimates.");
}

}  // namespace glimt
