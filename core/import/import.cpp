#include "import/import.h"

#include <algorithm>
#include <array>
#include <cctype>

#include "import/import_parts.h"
#include "mesh/mesh_file.h"
#include "scene/file/scene_file.h"

namespace glimt {
namespace fs = std::filesystem;
namespace {

std::string lower_ending(const fs::path& file) {
  std::string text = file.extension().string();
  std::ranges::transform(text, text.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return text;
}

}  // namespace

bool is_importable(const fs::path& file) { return lower_ending(file) == ".xml" || is_mesh_file(file); }

ImportedScene import_scene(const fs::path& file) {
  try {
    const std::string ending = lower_ending(file);
    if (ending == ".xml") return import_mitsuba(file);
    if (ending == ".gltf" || ending == ".glb") return import_gltf(file);
    if (is_mesh_file(file)) return import_mesh(file);
  } catch (const MeshFileError& error) {
    throw SceneError(error.what());
  }
  throw SceneError(file.string() + ": cannot be imported by its ending; allowed are .xml, .gltf, .glb, .obj and .ply");
}

std::string text_of(const ImportNote& note) {
  return note.place + ": " + note.what + " has no counterpart; in its place: " + note.instead;
}

ImportedScene read_or_import(const fs::path& file, std::span<const std::string> overrides) {
  if (!is_importable(file)) return {read_scene(file, overrides), {}};
  ImportedScene imported = import_scene(file);
  // As text, which is what overrides change.
  imported.scene = parse_scene(write_scene(imported.scene), file.string() + " as a scene file", overrides);
  return imported;
}

}  // namespace glimt
