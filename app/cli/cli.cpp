#include "cli/cli.h"

#include <cstdio>
#include <new>

#include "cli/commands.h"
#include "scene/file/scene_file.h"

namespace glimt {
namespace {

constexpr int failed = 1;
constexpr int bad_use = 2;

int say(const char* message, int status) {
  std::fprintf(stderr, "%s\n", message);
  return status;
}

}  // namespace

int run_cli(int argc, char** argv) {
  CLI::App app("glimt: an interactive Monte Carlo path tracer", "glimt");
  app.set_version_flag("--version", "glimt " GLIMT_VERSION);
  app.require_subcommand(0, 1);
  Run run;
  add_window_command(app, run);
  add_render_command(app, run);
  add_merge_command(app, run);
  add_compare_command(app, run);
  add_chart_command(app, run);
  add_report_command(app, run);
  add_check_command(app, run);
  add_info_command(app, run);
  try {
    app.parse(argc, argv);
    return run();
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : bad_use;
  } catch (const SceneError& error) {
    return say(error.what(), bad_use);
  } catch (const BadInput& error) {
    return say(error.what(), bad_use);
  } catch (const std::bad_alloc&) {
    return say("not enough memory", failed);
  } catch (const std::exception& error) {
    return say(error.what(), failed);
  }
}

}  // namespace glimt
