#include "import/import.h"

#include <cstdio>

#include "cli/commands.h"
#include "cli/render_options.h"
#include "film/file_bytes.h"
#include "mesh/mesh_file.h"
#include "scene/file/scene_file.h"
#include "scene/validate/validate.h"

namespace glimt {
namespace fs = std::filesystem;
namespace {

struct ImportOptions {
  fs::path file, out;
  bool strict = false, copy_meshes = false;
};

void replace_by(const fs::path& from, const fs::path& to) {
  std::error_code error;
  fs::copy_file(from, to, fs::copy_options::overwrite_existing, error);
  if (error) throw BadInput(to.string() + ": cannot be written: " + error.message());
}

/// Into the folder of the scene; the scene then names the copies.
void copy_meshes(Scene& scene, const fs::path& folder) {
  for (Mesh& mesh : scene.meshes) {
    if (!mesh.file) continue;
    const fs::path from = mesh.file->path, to = folder / from.filename();
    std::error_code error;
    if (fs::equivalent(to, from, error)) continue;
    if (fs::exists(to, error) && load_mesh(to)->hash != mesh.file->data->hash)
      throw BadInput(to.string() + ": is another mesh already; nothing is written");
    replace_by(from, to);
    for (const fs::path& beside : files_beside(from)) replace_by(beside, folder / beside.filename());
    mesh.file->path = to;
  }
}

void tell(const std::vector<ImportNote>& notes) {
  for (const ImportNote& note : notes) std::fprintf(stderr, "%s\n", text_of(note).c_str());
}

int run_import(const ImportOptions& options) {
  if (options.out.extension() != ".toml") throw BadInput(options.out.string() + ": a scene file's name ends in .toml");
  ImportedScene imported = import_scene(options.file);
  tell(imported.notes);
  if (options.strict && !imported.notes.empty())
    throw BadInput(options.file.string() + ": is refused, because --strict allows no replacements");
  const fs::path folder = fs::absolute(options.out).parent_path();
  if (options.copy_meshes) copy_meshes(imported.scene, folder);
  replace_file(options.out, write_scene(imported.scene, folder));
  if (const std::vector<Problem> problems = validate(imported.scene); !problems.empty())
    throw BadInput(options.out.string() + ": is written, but cannot be rendered: " + problems.front().message);
  return 0;
}

}  // namespace

Scene read_input(const fs::path& file, std::span<const std::string> overrides) {
  ImportedScene opened = read_or_import(file, overrides);
  tell(opened.notes);
  return std::move(opened.scene);
}

void add_import_command(CLI::App& app, Run& run) {
  CLI::App* command =
      app.add_subcommand("import", "Make a scene file of a scene of Mitsuba 3 or glTF 2.0, or of a mesh");
  const auto options = std::make_shared<ImportOptions>();
  command->add_option("FILE", options->file, "Mitsuba 3 (.xml), glTF 2.0 (.gltf, .glb), OBJ or PLY")
      ->required()
      ->type_name("FILE");
  add_file_option(*command, "-o,--output", options->out, "Scene file (.toml) to write")->required();
  command->add_flag("--copy-meshes", options->copy_meshes, "Copy mesh files to the folder of the scene file");
  command->add_flag("--strict", options->strict, "Refuse a file with something that has no counterpart");
  command->callback([&run, options] { run = [options] { return run_import(*options); }; });
}

}  // namespace glimt
