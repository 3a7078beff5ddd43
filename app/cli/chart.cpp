#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>

#include "chart/reference.h"
#include "chart/runs.h"
#include "chart/words.h"
#include "cli/ablate.h"
#include "cli/commands.h"
#include "cli/progress_bar.h"
#include "cli/render_options.h"
#include "film/file_bytes.h"
#include "import/import.h"
#include "scene/file/scene_file.h"

namespace glimt {
namespace fs = std::filesystem;
namespace {

struct ChartOptions : SceneOptions {
  fs::path out, csv, reference;
  std::vector<std::string> methods{"report", "naive", "path"};
  Plan plan;
  bool ablate = false, quiet = false;
};

/// The variant that a name such as "path:sampler=sobol" stands for.
Variant make_variant(const std::string& name, const SceneOptions& options) {
  std::vector<std::string> overrides = options.overrides;
  std::string label;
  for (std::size_t begin = 0, end = 0; begin <= name.size(); begin = end + 1) {
    end = std::min(name.find(':', begin), name.size());
    std::string part = name.substr(begin, end - begin);
    overrides.push_back((begin == 0 ? "render.method=" : "render.") + part);
    std::ranges::replace(part, '=', ' ');
    label += (label.empty() ? "" : ", ") + words(part);
  }
  try {
    return {name, label, compile(read_or_import(options.scene, overrides).scene)};
  } catch (const SceneError& error) {
    throw BadInput("--methods " + name + ": " + error.what());
  }
}

std::vector<Variant> make_variants(const ChartOptions& options) {
  std::vector<Variant> variants;
  for (const auto& name : options.methods) {
    variants.push_back(make_variant(name, options));
    for (const auto& warning : variants.back().scene.warnings)
      std::fprintf(stderr, "warning: %s: %s\n", name.c_str(), warning.c_str());
  }
  return variants;
}

void print_outcomes(const std::vector<Variant>& variants, const std::vector<Measurement>& measurements) {
  std::size_t widest = 6;
  for (const auto& variant : variants) widest = std::max(widest, variant.label.size());
  const int column = static_cast<int>(widest);
  std::printf("%-*s %8s %9s %10s %11s\n", column, "method", "spp", "seconds",
              measurements.front().error ? "relmse999" : "estimate", "efficiency");
  for (std::size_t i = 0; i < variants.size(); ++i) {
    const Outcome o = outcome(measurements, i);
    std::printf("%-*s %8d %9.3f %10.3g %11.3g\n", column, variants[i].label.c_str(), o.spp, o.seconds, o.error,
                o.efficiency);
  }
}

void draw_chart(const ChartOptions& options, const Scene& scene, bool show) {
  Image reference;
  try {
    if (!options.reference.empty()) reference = read_reference(options.reference, scene);
  } catch (const std::runtime_error& error) {
    throw BadInput(error.what());
  }
  std::vector<Variant> variants = make_variants(options);
  std::vector<Measurement> measurements;
  {
    ProgressBar bar;
    measurements = measure(variants, options.plan, options.reference.empty() ? nullptr : &reference,
                           [&bar, show](double done) { show ? bar.show(done) : void(); });
  }
  Chart chart = error_chart(variants, measurements);
  chart.title = scene.name;
  chart.made_of = "glimt " GLIMT_VERSION "\n" + write_scene(scene);
  replace_file(options.out, svg_chart(chart));
  if (!options.csv.empty()) replace_file(options.csv, measurements_csv(variants, measurements));
  if (!options.quiet) print_outcomes(variants, measurements);
}

int run_chart(ChartOptions& options) {
  if (options.out.empty() && !options.ablate) throw BadInput("--output is required: the chart to write, .svg");
  if (options.out.empty() && !(options.csv.empty() && options.reference.empty()))
    throw BadInput("--csv and --reference are of the chart, which --output names");
  options.plan.execution = options.execution;
  const Scene scene = read_input(options.scene, options.overrides);
  const bool show = !options.quiet && isatty(STDERR_FILENO) != 0;
  if (!options.out.empty()) draw_chart(options, scene, show);
  if (options.ablate) {
    Plan plan = options.plan;
    if (std::isfinite(plan.seconds)) plan.spp = scene.render.spp;
    plan.spp = std::max(plan.spp, 2);
    print_ablation(scene, plan, show);
  }
  return 0;
}

}  // namespace

void add_chart_command(CLI::App& app, Run& run) {
  CLI::App* command = app.add_subcommand("chart", "Chart the error of methods against the time they take");
  const auto options = std::make_shared<ChartOptions>();
  add_scene_options(*command, *options);
  add_file_option(*command, "-o,--output", options->out, "Chart to write, .svg")
      ->check([](const std::string& file) {
        return fs::path(file).extension() == ".svg" ? "" : file + ": a chart's file ends in .svg";
      })
      ->type_name("OUT.svg");
  add_file_option(*command, "--csv", options->csv, "Write every point as CSV")->type_name("FILE.csv");
  command
      ->add_option("--methods", options->methods,
                   "What to compare: methods, each with settings of its own if wanted (path:sampler=sobol)")
      ->delimiter(',')
      ->allow_extra_args(false)
      ->type_name("NAME[:KEY=VALUE]...,...")
      ->capture_default_str();
  CLI::Option* seconds =
      command->add_option("--seconds", options->plan.seconds, "Rendering time of each method with each seed")
          ->capture_default_str();
  seconds->check(check_positive)->type_name("S");
  command
      ->add_option_function<int>(
          "--spp",
          [options](int spp) {
            options->plan.spp = spp;
            options->plan.seconds = std::numeric_limits<double>::infinity();
          },
          "Samples per pixel to stop at, instead of a time")
      ->check(CLI::Range(1, options->plan.spp))
      ->type_name("N")
      ->excludes(seconds);
  command->add_option("--seeds", options->plan.seeds, "Renderings of each method, for the median and the band")
      ->check(CLI::Range(1, 1000))
      ->type_name("N")
      ->capture_default_str();
  command
      ->add_option("--reference", options->reference,
                   "Picture to measure against, .exr or .pfm; else the error is estimated")
      ->type_name("REF.exr");
  command->add_flag("--ablate", options->ablate,
                    "Print what each piece of the model costs and buys on this scene, at --spp or the scene's spp");
  command->add_flag("--quiet", options->quiet, "No progress and no table of efficiencies");
  command->callback([&run, options] { run = [options] { return run_chart(*options); }; });
}

}  // namespace glimt
