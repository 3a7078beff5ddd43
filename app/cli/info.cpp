#include <algorithm>
#include <cstdio>
#include <string>

#include "cli/commands.h"
#include "compile/compiled_scene.h"
#include "scene/fields.h"

namespace glimt {
namespace fs = std::filesystem;
namespace {

std::string counted(std::size_t count, const std::string& singular, const std::string& plural) {
  return std::to_string(count) + " " + (count == 1 ? singular : plural);
}

void print_line(const char* title, const std::string& text) { std::printf("%-12s %s\n", title, text.c_str()); }

void print_list(const char* title, const std::vector<std::string>& lines) {
  if (lines.empty()) print_line(title, "nothing");
  for (const auto& line : lines) print_line(&line == &lines.front() ? title : "", line);
}

/// Names of the objects that are lamps.
template <class Objects>
void add_lamps(const Scene& scene, const Objects& objects, const std::string& kind, std::vector<std::string>& lamps) {
  for (const auto& object : objects)
    if (const Material* m = find_material(scene, object.material); m && is_lamp(*m))
      lamps.push_back(kind + (object.name.empty() ? "" : " \"" + object.name + "\"") + " of " + m->name);
}

int run_info(const fs::path& file) {
  const Scene scene = read_input(file);
  const CompiledScene compiled = compile(scene);

  std::size_t triangles = 0;
  for (const Mesh& mesh : scene.meshes) triangles += mesh.triangles.size();
  std::vector<std::string> materials, lamps;
  for (const Material& m : scene.materials) materials.push_back(m.name + ": " + m.type);
  add_lamps(scene, scene.spheres, "sphere", lamps);
  add_lamps(scene, scene.polygons, "polygon", lamps);
  add_lamps(scene, scene.meshes, "mesh", lamps);

  print_line("name", scene.name);
  print_line("image", std::to_string(scene.image.width) + " x " + std::to_string(scene.image.height));
  print_line("objects", counted(scene.spheres.size(), "sphere", "spheres") + ", " +
                            counted(scene.polygons.size(), "polygon", "polygons") + ", " +
                            counted(scene.meshes.size(), "mesh", "meshes") + " with " +
                            counted(triangles, "triangle", "triangles"));
  print_list("materials", materials);
  print_list("lamps", lamps);
  print_list("compiled in", compiled.compiled_in);
  print_list("left out", compiled.left_out);
  if (!compiled.warnings.empty()) print_list("warnings", compiled.warnings);
  return 0;
}

}  // namespace

void add_info_command(CLI::App& app, Run& run) {
  CLI::App* command = app.add_subcommand("info", "Say what a scene holds, and what was compiled in and left out");
  const auto scene = std::make_shared<fs::path>();
  command->add_option("SCENE", *scene, "Scene file")->required()->type_name("FILE");
  command->callback([&run, scene] { run = [scene] { return run_info(*scene); }; });
}

}  // namespace glimt
