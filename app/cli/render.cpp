#include <unistd.h>

#include <csignal>
#include <cstdio>

#include "cli/commands.h"
#include "cli/progress_bar.h"
#include "cli/render_loop.h"
#include "cli/render_options.h"
#include "cli/stats_file.h"
#include "film/file_bytes.h"
#include "film/metadata.h"
#include "film/statistics.h"
#include "scene/file/scene_file.h"

namespace glimt {
namespace {

std::atomic<bool> interrupted{false};
static_assert(std::atomic<bool>::is_always_lock_free);

/// The first Ctrl-C asks for an end after the running pass; a second one ends the program.
void stop_on_interrupt() {
  struct sigaction action {};
  action.sa_handler = [](int) { interrupted = true; };
  action.sa_flags = static_cast<int>(SA_RESETHAND);
  sigaction(SIGINT, &action, nullptr);
}

Goal goal_of(const RenderOptions& options, const Settings& settings) {
  if (options.seconds) return {.spp = max_spp, .seconds = *options.seconds};
  if (settings.target_error > 0) return {.spp = max_spp, .relmse_scaled = settings.target_error};
  return {.spp = settings.spp};
}

/// On standard output, or beside it where the picture goes there.
void print_summary(const RenderOptions& options, const Film& film, double seconds, const ErrorEstimate& estimate) {
  const double paths = static_cast<double>(film.width()) * film.height() * film.samples();
  std::FILE* const stream = options.out == "-" ? stderr : stdout;
  const std::string name = options.out == "-" ? "standard output" : options.out.string();
  std::fprintf(stream, "%s: %d spp in %.2f s, %.1f Mpaths/s, %s\n", name.c_str(), film.samples(), seconds,
               paths / seconds / 1e6, trust_text(estimate).c_str());
}

void warn_of_counters(const Film& film) {
  if (film.invalid() + film.saturated() == 0) return;
  std::fprintf(stderr,
               "warning: %llu values were not finite or negative and were left out, %llu were too large and were cut\n",
               static_cast<unsigned long long>(film.invalid()), static_cast<unsigned long long>(film.saturated()));
}

int run_render(const RenderOptions& options) {
  Scene scene = read_scene(options.scene, options.overrides);
  const CompiledScene compiled = compile(scene);
  for (const auto& warning : compiled.warnings) std::fprintf(stderr, "warning: %s\n", warning.c_str());
  const Goal goal = goal_of(options, scene.render);
  Film film = make_film(compiled);

  stop_on_interrupt();
  const bool show = !options.quiet && isatty(STDERR_FILENO);
  Rendering rendering;
  {
    ProgressBar bar;
    rendering = render_to(
        goal, compiled, film, options.execution, interrupted,
        show ? [&bar](const Progress& progress) { bar.show(progress); } : std::function<void(const Progress&)>());
  }

  const Display display{.dither = options.no_dither ? Dither::off : Dither::on};
  write_image(options.out, film, display, render_metadata(scene, film.samples(), rendering.seconds));
  if (!options.stats.empty())
    replace_file(options.stats, stats_json(scene, film, options.execution, rendering.seconds));
  const ErrorEstimate estimate = estimate_error(film);
  if (!options.quiet) print_summary(options, film, rendering.seconds, estimate);
  warn_of_counters(film);
  if (!rendering.reached) {
    std::fprintf(stderr, "interrupted: %s holds the %d samples per pixel there are\n", options.out.c_str(),
                 film.samples());
    return 1;
  }
  if (goal.relmse_scaled > 0 && film.samples() >= goal.spp && estimate.relmse_scaled > goal.relmse_scaled) {
    std::fprintf(stderr, "the error asked for is not reached with %d samples per pixel, the most there can be\n",
                 goal.spp);
    return 1;
  }
  return 0;
}

}  // namespace

int render_scene(const std::filesystem::path& scene, const std::filesystem::path& out) {
  RenderOptions options;
  options.scene = scene;
  options.out = out;
  try {
    check_writable(out);
  } catch (const ImageFileError& error) {
    throw BadInput(error.what());
  }
  return run_render(options);
}

void add_render_command(CLI::App& app, Run& run) {
  CLI::App* command = app.add_subcommand("render", "Render a scene to an image file");
  const auto options = std::make_shared<RenderOptions>();
  add_render_options(*command, *options);
  command->callback([&run, options] { run = [options] { return run_render(*options); }; });
}

}  // namespace glimt
