#include <unistd.h>

#include <atomic>
#include <csignal>
#include <cstdio>

#include "cli/checkpoints.h"
#include "cli/commands.h"
#include "cli/progress_bar.h"
#include "cli/ranks.h"
#include "cli/render_loop.h"
#include "cli/render_options.h"
#include "cli/stats_file.h"
#include "film/file_bytes.h"
#include "film/metadata.h"
#include "film/statistics.h"
#include "render/limits.h"

namespace glimt {
namespace {

std::atomic<bool> stopped{false};
std::atomic<int> stop_signal{0};
static_assert(std::atomic<bool>::is_always_lock_free && std::atomic<int>::is_always_lock_free);

/// The first SIGINT (Ctrl-C) or SIGTERM stops rendering after the running pass. A second signal of the same kind ends
/// the program at once.
void stop_on_signals() {
  struct sigaction action {};
  action.sa_handler = [](int number) {
    stop_signal = number;
    stopped = true;
  };
  action.sa_flags = static_cast<int>(SA_RESETHAND | static_cast<unsigned>(SA_RESTART));
  for (const int number : {SIGINT, SIGTERM}) sigaction(number, &action, nullptr);
}

Goal goal_of(const RenderOptions& options, const Settings& settings) {
  constexpr SampleRange all{0, max_spp};
  if (options.seconds) return {.samples = all, .seconds = *options.seconds};
  if (settings.target_error > 0) return {.samples = all, .relmse_scaled = settings.target_error};
  return {.samples = options.part.value_or(SampleRange{0, settings.spp})};
}

/// Prints to standard output, or to stderr where the picture goes to standard output.
void print_summary(const RenderOptions& options, const Film& film, double seconds, const ErrorEstimate& estimate) {
  const double paths = static_cast<double>(film.width()) * film.height() * film.samples();
  std::FILE* const stream = options.out == "-" ? stderr : stdout;
  const std::string name = options.out == "-" ? "standard output" : options.out.string();
  const std::string by_chance = estimate.is_bound() ? "" : light_by_chance(film.emitters());
  std::fprintf(stream, "%s: %d spp in %.2f s, %.1f Mpaths/s, %s%s%s\n", name.c_str(), film.samples(), seconds,
               paths / seconds / 1e6, trust_text(estimate).c_str(),
               by_chance.empty() ? "" : "; found by chance: ", by_chance.c_str());
}

void warn_of_counters(const Film& film) {
  if (film.invalid() + film.saturated() == 0) return;
  std::fprintf(stderr,
               "warning: %llu values were not finite or negative and were left out, %llu were too large and were cut\n",
               static_cast<unsigned long long>(film.invalid()), static_cast<unsigned long long>(film.saturated()));
}

/// Throws BadInput where the film and its picture do not fit into memory, or the threads cannot be had.
void check_limits(const RenderOptions& options, const ImageSize& image) {
  const std::string obstacle = memory_obstacle(image, bytes_to_write(options.out, image.width, image.height));
  if (!obstacle.empty()) throw BadInput(obstacle);
  const int threads = options.execution.threads > 0 ? options.execution.threads : hardware_threads();
  if (const int startable = startable_threads(threads); startable < threads) {
    char text[128];
    std::snprintf(text, sizeof text, "of %d threads only %d can be started here: give --threads a smaller number",
                  threads, startable);
    throw BadInput(text);
  }
}

/// Writes the picture and --stats. Returns false, and says why, where they cannot be written.
bool write_results(const RenderOptions& options, const Checkpoint& result, int ranks) {
  const auto& [scene, film, seconds, next_check] = result;
  try {
    const Display display{.dither = options.no_dither ? Dither::off : Dither::on};
    write_image(options.out, film, display, render_metadata(scene, film, seconds));
    if (!options.stats.empty()) replace_file(options.stats, stats_json(scene, film, options.execution, ranks, seconds));
    return true;
  } catch (const ImageFileError& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return false;
  }
}

/// What ranks other than the first do. Messages are for the leader to print, but for those of this process alone.
int help_render(const RenderOptions& options, Ranks& ranks) {
  if (!ranks.wait_for_begin()) return 0;
  try {
    const Scene scene = read_scene(options.scene, options.overrides);
    check_limits(options, scene.image);
    // The leader ends the round, and sends all home.
    for (const int number : {SIGINT, SIGTERM}) std::signal(number, SIG_IGN);
    ranks.help(compile(scene), options.execution);
    return 0;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "rank %d: %s\n", ranks.number(), error.what());
    Ranks::abort();
  }
}

int lead_render(const RenderOptions& options, Ranks& ranks) {
  const Scene scene = read_scene(options.scene, options.overrides);
  check_limits(options, scene.image);
  const CompiledScene compiled = compile(scene);
  for (const auto& warning : compiled.warnings) std::fprintf(stderr, "warning: %s\n", warning.c_str());
  const Goal goal = goal_of(options, scene.render);
  Checkpoint state = first_film(options, scene, compiled, goal);
  Film& film = state.film;

  stop_on_signals();
  CheckpointWriter writer(options);
  ranks.begin();
  const RenderSamples render = [&](Film& to, int count) {
    return ranks.render(compiled, to, count, options.execution);
  };
  const bool show = !options.quiet && isatty(STDERR_FILENO);
  Rendering rendering{.seconds = state.seconds, .next_check = state.next_check};
  {
    ProgressBar bar;
    AfterPass after{.report = {}, .save = [&](const Rendering& now) { writer.write_when_due(state, now); }};
    if (show) after.report = [&bar](const Progress& progress) { bar.show(progress); };
    rendering = render_to(goal, compiled, film, render, stopped, after, rendering);
  }
  state.seconds = rendering.seconds;

  // Each of the two is tried where the other fails.
  const bool kept = writer.write(state, rendering), written = write_results(options, state, ranks.count());
  if (!kept || !written) return 1;
  const ErrorEstimate estimate = estimate_error(film);
  if (!options.quiet) print_summary(options, film, rendering.seconds, estimate);
  warn_of_counters(film);
  if (!rendering.reached) {
    std::fprintf(stderr, "interrupted: %s holds the %d samples per pixel there are\n", options.out.c_str(),
                 film.samples());
    return 128 + stop_signal;
  }
  if (goal.relmse_scaled > 0 && film.samples() >= goal.samples.count && estimate.at_most() > goal.relmse_scaled) {
    std::fprintf(stderr, "the error asked for is not reached with %d samples per pixel, the most there can be\n",
                 goal.samples.count);
    return 1;
  }
  return 0;
}

int run_render(const RenderOptions& options) {
  Ranks ranks;
  return ranks.lead() ? lead_render(options, ranks) : help_render(options, ranks);
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
