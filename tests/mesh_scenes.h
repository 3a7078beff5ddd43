#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "blob_mesh.h"
#include "scene/file/scene_file.h"

namespace glimt {

inline void write_blob(const std::filesystem::path& folder) { std::ofstream(folder / "blob.obj") << blob_obj(); }

/// A scene that there is a picture of in tests/data: of scenes/, or meshes.toml with the file that it names.
inline Scene reference_scene(const std::string& name) {
  if (name != "meshes") return read_scene(GLIMT_SCENES "/" + name + ".toml");
  const std::filesystem::path folder = std::filesystem::path(testing::TempDir()) / "glimt_meshes";
  std::filesystem::create_directories(folder);
  write_blob(folder);
  std::filesystem::copy_file(GLIMT_TESTS_DIR "/data/meshes.toml", folder / "meshes.toml",
                             std::filesystem::copy_options::overwrite_existing);
  return read_scene(folder / "meshes.toml");
}

}  // namespace glimt
