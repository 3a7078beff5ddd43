#include <cstdio>
#include <cstdlib>

#include "cli/commands.h"
#ifdef GLIMT_WINDOW
#include "viewer/viewer.h"
#endif

namespace glimt {
namespace fs = std::filesystem;
namespace {

fs::path default_scene() {
  const fs::path installed = fs::path(GLIMT_SCENES_DIR) / "report.toml";
  return fs::exists(installed) ? installed : fs::path("scenes") / "report.toml";
}

/// Why no window can be opened; null where one can.
const char* obstacle() {
#ifdef GLIMT_WINDOW
  for (const char* display : {"DISPLAY", "WAYLAND_DISPLAY"})
    if (const char* name = std::getenv(display); name && *name) return nullptr;
  return "There is no display";
#else
  return "This glimt is built without its window";
#endif
}

int open_window(const fs::path& scene) {
  if (const char* why = obstacle()) {
    const fs::path out = scene.stem().string() + ".png";
    std::printf("%s: rendering %s to %s instead.\n", why, scene.c_str(), out.c_str());
    std::fflush(stdout);
    return render_scene(scene, out);
  }
#ifdef GLIMT_WINDOW
  return run_viewer(scene);
#else
  return 0;
#endif
}

}  // namespace

void add_window_command(CLI::App& app, Run& run) {
  const auto scene = std::make_shared<fs::path>();
  app.add_option("SCENE", *scene, "Scene file to open in the window; scenes/report.toml if none is given")
      ->type_name("FILE");
  app.callback([&app, &run, scene] {
    if (app.get_subcommands().empty())
      run = [scene] { return open_window(scene->empty() ? default_scene() : *scene); };
    else if (!scene->empty())
      throw CLI::ParseError("a command was given after the scene file " + scene->string(), 2);
  });
}

}  // namespace glimt
