#include <gtest/gtest.h>

#include <fstream>
#include <glm/geometric.hpp>

#include "app/own_folder.h"
#include "app/viewer/offscreen.h"
#include "scene/file/scene_file.h"
#include "unit/import/mitsuba_text.h"
#include "unit/mesh/mesh_bytes.h"
#include "viewer/state/edit.h"

/// Mesh files and scenes of other programs in the window.
namespace glimt {
namespace {

using testing::Offscreen;
using testing::small_room;

constexpr int window_width = 1280, window_height = 800;

class ViewerImport : public testing::OwnFolder {
 protected:
  void SetUp() override {
    OwnFolder::SetUp();
    std::ofstream("part.obj") << testing::obj_tetrahedron;
    std::ofstream("part.ply") << testing::ply_tetrahedron;
    std::ofstream("part.glb", std::ios::binary) << testing::glb_triangle();
    std::ofstream("room.xml") << testing::mitsuba_room;
  }
  static void open(Offscreen& window, const std::filesystem::path& file) {
    Edits edits;
    edits.open = file;
    window.apply(edits);
  }
};

TEST_F(ViewerImport, MeshesAndScenesOfOthersOpen) {
  Offscreen window(small_room(), window_width, window_height);
  for (const char* file : {"part.obj", "part.ply", "part.glb", "room.xml"}) {
    open(window, folder / file);
    EXPECT_FALSE(window.state().message.error) << window.state().message.text;
    EXPECT_TRUE(window.state().message.text.starts_with(std::string("Opened ") + file)) << window.state().message.text;
    EXPECT_FALSE(window.state().scene.meshes.empty()) << file;
    EXPECT_EQ(window.state().file, "") << "saving must not replace a file that is no scene file";
    EXPECT_TRUE(window.draw_until_finished());
  }
  EXPECT_NE(window.state().message.text.find("room.xml:61: shape disk has no counterpart"), std::string::npos)
      << window.state().message.text;
  const Scene before = window.state().scene;
  std::ofstream("part.obj") << "v 1 2\n";
  open(window, folder / "part.obj");
  EXPECT_TRUE(window.state().message.error);
  EXPECT_EQ(window.state().scene, before);
}

TEST_F(ViewerImport, SavingNamesTheMeshRelativeToTheScene) {
  Offscreen window(small_room(), window_width, window_height);
  open(window, folder / "part.obj");
  const Scene opened = window.state().scene;
  std::filesystem::create_directory("saved");
  Edits edits;
  edits.save = folder / "saved/part.toml";
  window.apply(edits);
  std::ifstream stream("saved/part.toml");
  const std::string text{std::istreambuf_iterator<char>(stream), {}};
  EXPECT_NE(text.find("file = \"../part.obj\""), std::string::npos) << text;
  EXPECT_EQ(read_scene("saved/part.toml").meshes, opened.meshes);
}

// Scaling an object in the window changes how the file is placed, so that a saved scene says so.
TEST_F(ViewerImport, ScalingAMeshScalesItsPlacement) {
  std::ofstream("scene.toml") << write_scene(small_room(), folder)
                              << "[[mesh]]\nname = \"solid\"\nmaterial = \"white\"\nfile = \"part.obj\"\n"
                                 "scale = 0.5\nrotate = [0, 30, 0]\ntranslate = [1, 2, 3]\n";
  Scene scene = read_scene("scene.toml");
  for (std::size_t i = 0; i < scene.meshes.size(); ++i)
    if (scene.meshes[i].file) {
      scale(scene, {ObjectKind::mesh, i}, 1.5);
      const Scene again = parse_scene(write_scene(scene, folder), "scene.toml");
      const auto &a = scene.meshes[i].vertices, &b = again.meshes[i].vertices;
      ASSERT_EQ(a.size(), b.size());
      for (std::size_t v = 0; v < a.size(); ++v) EXPECT_LT(length(a[v] - b[v]), 1e-12);
      return;
    }
  ADD_FAILURE() << "no mesh has a file";
}

// A mesh of a file's materials gets another of its own: what wore that changes, and a saved scene says the same.
TEST_F(ViewerImport, ANewMaterialIsWornByTheMeshsOwnParts) {
  std::ofstream("scene.toml") << write_scene(small_room(), folder)
                              << "[[mesh]]\nname = \"solid\"\nmaterial = \"white\"\nfile = \"part.obj\"\n"
                                 "materials = {steel = \"mirror\"}\n";
  Scene scene = read_scene("scene.toml");
  const std::size_t solid = scene.meshes.size() - 1;
  set_material(scene, {ObjectKind::mesh, solid}, {.name = {}, .type = "lambertian"});
  ASSERT_EQ(scene.meshes[solid].parts.size(), 2u);
  EXPECT_EQ(scene.meshes[solid].parts[0].material, "mirror");
  EXPECT_EQ(scene.meshes[solid].parts[1].material, "solid");
  EXPECT_EQ(parse_scene(write_scene(scene, folder), "scene.toml"), scene);
}

}  // namespace
}  // namespace glimt
