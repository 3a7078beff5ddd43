#include <gtest/gtest.h>

#include <filesystem>
#include <glm/geometric.hpp>

#include "import/import.h"
#include "mesh_scenes.h"
#include "pictures.h"

// Scenes of Mitsuba, written by hand, against the scene files of the same rooms.
namespace glimt {
namespace {

namespace fs = std::filesystem;

constexpr double alpha = 1e-4;  ///< of a false alarm, for each scene

struct ImportCase {
  std::string name;
  int samples;  ///< per pixel and seed
};

class ImportedPicture : public testing::TestWithParam<ImportCase> {};

Scene from_xml(const std::string& name) {
  const fs::path folder = fs::path(testing::TempDir()) / "glimt_import";
  fs::create_directories(folder);
  fs::copy(GLIMT_TESTS_DIR "/data/import", folder, fs::copy_options::overwrite_existing | fs::copy_options::recursive);
  write_blob(folder);
  const ImportedScene imported = import_scene(folder / (name + ".xml"));
  for (const ImportNote& note : imported.notes) ADD_FAILURE() << text_of(note);
  return imported.scene;
}

/// With light tracing and shared paths, whose noise is small, at 64x64 pixels.
Series series(Scene scene, int samples, int first_seed) {
  scene.image = {64, 64};
  Series pictures;
  for (int seed = 0; seed < 16; ++seed) {
    scene.render.seed = first_seed + seed;
    pictures.blocks.push_back(block_means(render(compile(scene), samples).mean(), 8));
  }
  return pictures;
}

// Every block's means differ by no more than their noise (Welch's t-tests).
TEST_P(ImportedPicture, IsThatOfTheSceneFile) {
  const Scene ours = reference_scene(GetParam().name), theirs = from_xml(GetParam().name);
  EXPECT_EQ(theirs.image, ours.image);
  EXPECT_LT(length(theirs.camera.eye - ours.camera.eye), 1e-9);
  EXPECT_NEAR(theirs.camera.fov_y, ours.camera.fov_y, 1e-9);
  const int samples = GetParam().samples * effort / 8;
  const Series a = series(ours, samples, 1), b = series(theirs, samples, 101);
  const double level = sidak(alpha, static_cast<double>(a.size()));
  for (std::size_t i = 0; i < a.size(); ++i) {
    const Estimate file = a.block(i), import = b.block(i);
    EXPECT_GT(likelihood(file, import), level)
        << "block (" << i / 3 % 8 << ", " << i / 24 << "), channel " << i % 3 << ": " << file.mean << " +- "
        << file.error << " of the scene file, " << import.mean << " +- " << import.error << " of the import";
  }
}

INSTANTIATE_TEST_SUITE_P(Scenes, ImportedPicture,
                         testing::Values(ImportCase{"hexagon", 32}, ImportCase{"glossy", 32}, ImportCase{"meshes", 16}),
                         [](const auto& scene) { return scene.param.name; });

}  // namespace
}  // namespace glimt
