#include <chrono>

#include "cli/report_parts.h"
#include "compile/compiled_scene.h"
#include "film/statistics.h"
#include "scene/file/scene_file.h"

namespace glimt {
namespace {

using Overrides = std::vector<std::string>;

/// A picture and what it cost.
struct Shot {
  Image image;
  int spp = 0;
  double seconds = 0;  ///< wall-clock time of rendering
  double noise = 0;    ///< relmse_estimate
};

Shot shoot(const ReportPlan& plan, const Scene& scene) {
  const CompiledScene compiled = compile(scene);
  Film warm = make_film(compiled), film = make_film(compiled);
  render_pass(compiled, warm, 1, plan.execution);
  const auto start = std::chrono::steady_clock::now();
  render_pass(compiled, film, scene.render.spp, plan.execution);
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return {film.mean(), film.samples(), seconds, relmse_estimate(film)};
}

/// One picture made three ways: by the report's method, the same picture by glimt's best method, and the whole picture
/// with caustics.
struct Trio {
  Shot report, same, whole;
};

Trio shoot_trio(const ReportPlan& plan, const std::string& name, Overrides overrides, int spp, int shadow_rays,
                int own_shadow_rays = 1) {
  overrides.push_back("render.spp=" + std::to_string(plan.spp(spp)));
  const auto shot = [&](const std::string& method, int rays, const Overrides& more) {
    Overrides all = overrides;
    all.push_back("render.method=" + method);
    all.push_back("render.shadow_rays=" + std::to_string(rays));
    all.insert(all.end(), more.begin(), more.end());
    return shoot(plan, report_scene(plan, name, all));
  };
  return {shot("report", shadow_rays, {}), shot("path", own_shadow_rays, {"render.caustics=off"}),
          shot("path", own_shadow_rays, {})};
}

const Page::Row header{"",      "report's machine", "report's method", "noise", "same picture, glimt's way",
                       "noise", "efficiency",       "with caustics",   "noise"};

std::string seconds_text(double seconds) { return figure_text(seconds) + " s"; }

Page::Row row_of(const std::string& what, const std::string& published, const Trio& trio) {
  const double ratio = trio.report.noise * trio.report.seconds / (trio.same.noise * trio.same.seconds);
  return {what,
          published,
          seconds_text(trio.report.seconds),
          figure_text(trio.report.noise),
          seconds_text(trio.same.seconds),
          figure_text(trio.same.noise),
          "× " + figure_text(ratio),
          seconds_text(trio.whole.seconds),
          figure_text(trio.whole.noise)};
}

std::string caption_of(const std::string& what, const Shot& shot) {
  const std::string spp = std::to_string(shot.spp) + " spp";
  return (what == spp ? "" : what + ": ") + spp + ", " + seconds_text(shot.seconds) + ", noise " +
         figure_text(shot.noise);
}

/// The report's pictures in one row and glimt's in the next.
void add_pairs(Page& page, const std::vector<std::pair<std::string, Trio>>& trios, const std::string& caption) {
  std::vector<Page::Picture> reports, best;
  for (const auto& [what, trio] : trios) {
    reports.push_back({trio.report.image, caption_of(what, trio.report)});
    best.push_back({trio.whole.image, caption_of(what, trio.whole)});
  }
  page.figure(reports, caption + " The report's method.");
  page.figure(best, caption + " glimt's best.");
}

const std::string noise_note =
    "Noise is relmse as the picture's halves estimate it. Efficiency is 1 / (noise x time), of the same picture "
    "without "
    "caustics made glimt's way with one shadow ray, over the report's.";

}  // namespace

Scene report_scene(const ReportPlan& plan, const std::string& name, Overrides overrides) {
  overrides.push_back("image.width=" + std::to_string(plan.side()));
  overrides.push_back("image.height=" + std::to_string(plan.side()));
  return read_scene(std::filesystem::path(GLIMT_SCENES_DIR) / "report" / (name + ".toml"), overrides);
}

void add_room(Page& page, const ReportPlan& plan) {
  plan.say("Figure 1: the room");
  page.heading("Figure 1: the room");
  add_pairs(page, {{"empty", shoot_trio(plan, "empty", {}, 64, 30)}, {"full", shoot_trio(plan, "full", {}, 64, 30)}},
            "The room empty and full.");
}

void add_samples(Page& page, const ReportPlan& plan) {
  page.heading("Figure 2 and Table 1: samples per pixel");
  std::vector<std::pair<std::string, Trio>> trios;
  std::vector<Page::Row> rows;
  for (const int spp : {4, 16, 64, 256}) {
    const std::string what = std::to_string(plan.spp(spp)) + " spp";
    plan.say("Figure 2: " + what);
    trios.emplace_back(what, shoot_trio(plan, "full", {}, spp, 30));
    rows.push_back(row_of(what, "–", trios.back().second));
  }
  add_pairs(page, trios, "The full room with more and more samples.");
  page.table(header, rows, "Table 1. The report's method with its 30 shadow rays. " + noise_note);
}

void add_roughness(Page& page, const ReportPlan& plan) {
  page.heading("Figure 3: roughness");
  std::vector<std::pair<std::string, Trio>> trios;
  for (const char* roughness : {"0", "0.6", "0.8", "1"}) {
    plan.say(std::string("Figure 3: roughness ") + roughness);
    trios.emplace_back(std::string("roughness ") + roughness,
                       shoot_trio(plan, "sphere", {std::string("material.clay.roughness=") + roughness}, 64, 30));
  }
  add_pairs(page, trios, "An Oren-Nayar sphere from smooth to rough.");
}

void add_materials(Page& page, const ReportPlan& plan) {
  page.heading("Figure 4 and Table 2: materials");
  std::vector<std::pair<std::string, Trio>> trios;
  std::vector<Page::Row> rows;
  for (const char* material : {"mirror", "white", "glass"}) {
    const std::string what = std::string(material) == "white" ? "Lambertian" : material;
    plan.say("Figure 4: " + what);
    trios.emplace_back(what, shoot_trio(plan, "sphere", {std::string("sphere.sphere.material=") + material}, 16, 30));
    rows.push_back(row_of(what, "–", trios.back().second));
  }
  add_pairs(page, trios, "The sphere as mirror, Lambertian and of glass.");
  page.table(header, rows, "Table 2. The report's method with its 30 shadow rays. " + noise_note);
}

void add_shadow_rays(Page& page, const ReportPlan& plan) {
  page.heading("Figure 5 and Table 3: shadow rays");
  // Table 3 of the report: 400x400 pixels, 64 samples per pixel, on an Intel Core i7-4790K.
  const std::vector<std::pair<int, std::string>> published{{1, "43 s"}, {2, "63 s"}, {4, "91 s"}, {8, "148 s"}};
  std::vector<std::pair<std::string, Trio>> trios;
  std::vector<Page::Row> rows;
  for (const auto& [count, time] : published) {
    const std::string what = std::to_string(count) + (count == 1 ? " shadow ray" : " shadow rays");
    plan.say("Figure 5: " + what);
    trios.emplace_back(what, shoot_trio(plan, "full", {}, 64, count, count));
    rows.push_back(row_of(what, time, trios.back().second));
  }
  add_pairs(page, trios, "The full room with more and more shadow rays.");
  page.table(
      header, rows,
      "Table 3. The report's times are for 400x400 pixels and 64 spp on its four cores. Here glimt's way has the "
      "row's number of shadow rays too. Noise is relmse as the halves estimate it.");
}

}  // namespace glimt
