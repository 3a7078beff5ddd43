#include <gtest/gtest.h>

#include <fstream>
#include <glm/geometric.hpp>

#include "app/own_folder.h"
#include "compile/compiled_scene.h"
#include "scene/file/scene_change.h"
#include "scene/file/scene_file.h"
#include "scene/geometry/mend.h"
#include "unit/mesh/mesh_bytes.h"

namespace glimt {
namespace {

using namespace testing;
using glm::dvec3;

const std::string head = R"([camera]
eye = [0, 0, 5]
look_at = [0, 0, 0]
fov_y = 45
[image]
width = 40
height = 30
[material.white]
type = "lambertian"
reflectance = [0.5, 0.5, 0.5]
[material.metal]
type = "mirror"
reflectance = [1, 1, 1]
)";

template <class Read>
std::string message_of(Read read) {
  try {
    read();
  } catch (const SceneError& error) {
    return error.what();
  }
  return "accepted";
}

/// A folder with meshes/solid.obj, and scene.toml beside the folder "meshes".
class MeshScene : public OwnFolder {
 protected:
  void SetUp() override {
    OwnFolder::SetUp();
    std::filesystem::create_directory("meshes");
    std::ofstream("meshes/solid.obj") << obj_tetrahedron;
  }
  static Scene scene(const std::string& keys, const std::vector<std::string>& overrides = {}) {
    std::ofstream("scene.toml") << text(keys);
    return read_scene("scene.toml", overrides);
  }
  static std::string text(const std::string& keys) {
    return head + "[[mesh]]\nname = \"solid\"\nmaterial = \"white\"\nfile = \"meshes/solid.obj\"\n" + keys;
  }
};

TEST_F(MeshScene, FilesAreNamedRelativeToTheScene) {
  const Scene here = scene("");
  EXPECT_EQ(here.meshes[0].vertices.size(), 4u);
  EXPECT_EQ(here.meshes[0].file->path, folder / "meshes/solid.obj");
  std::filesystem::create_directory("elsewhere");
  std::filesystem::current_path("elsewhere");
  EXPECT_EQ(read_scene("../scene.toml"), here);
  EXPECT_EQ(read_scene(folder / "scene.toml"), here);
  std::filesystem::current_path("..");
  EXPECT_EQ(parse_scene(text(""), "standard input"), here) << "relative to the working folder";
}

TEST_F(MeshScene, PlacementIsReadAndChecked) {
  EXPECT_EQ(scene("scale = 2\ntranslate = [1, 2, 3]\n").meshes[0].vertices[1], dvec3(3, 2, 3));
  EXPECT_EQ(scene("scale = [2, 3, 4]\nrotate = [0, 0, 90]\n").meshes[0].vertices[1], dvec3(0, 2, 0));
  EXPECT_EQ(message_of([] { scene("scale = 0\n"); }),
            "scene.toml:18:9: mesh \"solid\": scale has a 0; allowed is any other number");
  EXPECT_EQ(message_of([] { scene("scale = [1, 2]\n"); }),
            "scene.toml:18:9: scale: expected an array of 3 numbers, found 2 elements");
  EXPECT_EQ(message_of([] { scene("translate = [nan, 0, 0]\nsmooth = true\n"); }),
            "scene.toml:18:13: mesh \"solid\": translate[0] is nan; allowed is -1000000000 to 1000000000");
  EXPECT_EQ(message_of([] { scene("scal = 2\n"); }).substr(0, 73),
            "scene.toml:18:1: unknown key \"scal\" in [[mesh]]; the nearest known key is");
  EXPECT_EQ(message_of([] { scene("vertices = []\n"); }),
            "scene.toml:18:12: vertices: the mesh has a file; allowed is either");
}

TEST_F(MeshScene, OverridesPlaceMeshes) {
  EXPECT_EQ(scene("", {"mesh.solid.translate=[1,0,0]"}).meshes[0].vertices[0], dvec3(1, 0, 0));
  EXPECT_EQ(scene("", {"mesh.0.scale=3"}).meshes[0].vertices[1], dvec3(3, 0, 0));
  EXPECT_EQ(message_of([] { scene("", {"mesh.solid.scale=0"}); }),
            "--set mesh.solid.scale=0: mesh \"solid\": scale has a 0; allowed is any other number");
  EXPECT_EQ(message_of([] { scene("", {"mesh.solid.file=none.obj"}); }).substr(0, 40),
            "--set mesh.solid.file=none.obj: file: " + folder.string().substr(0, 2));
}

TEST_F(MeshScene, BadFilesGiveOneLineWithBothPlaces) {
  std::ofstream("meshes/solid.obj") << "v 0 0 0\nf 1 2 3\n";
  EXPECT_EQ(message_of([] { scene(""); }),
            "scene.toml:17:8: file: solid.obj:2: a face names vertex 2; there are 1 so far, counted from 1");
  std::filesystem::remove("meshes/solid.obj");
  EXPECT_EQ(message_of([] { scene(""); }), "scene.toml:17:8: file: " + (folder / "meshes/solid.obj").string() +
                                               ": cannot be read: No such file or directory");
}

TEST_F(MeshScene, MaterialsComeByNameOrByMap) {
  EXPECT_TRUE(scene("").meshes[0].parts.empty()) << "the scene has no material steel or wood";
  const Scene mapped = scene("materials = {steel = \"metal\"}\n");
  ASSERT_EQ(mapped.meshes[0].parts.size(), 2u);
  EXPECT_EQ(mapped.meshes[0].parts[0], (MeshPart{"metal", 0, 2}));
  EXPECT_EQ(mapped.meshes[0].parts[1], (MeshPart{"white", 2, 2}));
  const Scene named =
      parse_scene(text("[material.wood]\ntype = \"lambertian\"\nreflectance = [0.4, 0.3, 0.2]\n"), "scene.toml");
  EXPECT_EQ(named.meshes[0].parts[1].material, "wood");
  EXPECT_EQ(message_of([] { scene("materials = {stel = \"metal\"}\n"); }),
            "scene.toml:18:14: materials: the file has no material \"stel\"; the nearest is \"steel\" (allowed: steel, "
            "wood)");
  EXPECT_EQ(message_of([] { scene("materials = {steel = \"mettle\"}\n"); }),
            "scene.toml:18:22: mesh \"solid\": there is no material \"mettle\"; the nearest is \"metal\" (allowed: "
            "white, metal)");
  EXPECT_EQ(scene("", {"mesh.solid.materials.steel=metal"}).meshes[0].parts, mapped.meshes[0].parts);
}

TEST_F(MeshScene, EachMaterialIsAMeshOfItsOwnWhenRendered) {
  const Scene mended = mend(scene("materials = {steel = \"metal\"}\n")).scene;
  ASSERT_EQ(mended.meshes.size(), 2u);
  EXPECT_EQ(mended.meshes[0].material, "metal");
  EXPECT_EQ(mended.meshes[1].material, "white");
  EXPECT_EQ(mended.meshes[0].triangles.size() + mended.meshes[1].triangles.size(), 4u);
  EXPECT_EQ(mended.meshes[1].name, "solid");
}

TEST_F(MeshScene, WhatIsLeftOutOfAFileIsTold) {
  std::ofstream("meshes/solid.obj", std::ios::app) << "f 1 2\n";
  const std::vector<std::string> told = mend(scene("")).told;
  EXPECT_EQ(told, std::vector<std::string>{"1 face has fewer than 3 corners and is left out; the first: solid.obj:18"});
}

TEST_F(MeshScene, SmoothMeshesHaveNormals) {
  EXPECT_TRUE(scene("").meshes[0].normals.empty());
  const Scene smooth = scene("smooth = true\n");
  EXPECT_TRUE(smooth.meshes[0].smooth);
  EXPECT_EQ(smooth.meshes[0].normals.size(), smooth.meshes[0].vertices.size());
  EXPECT_EQ(message_of([] { scene("smooth = 1\n"); }),
            "scene.toml:18:10: smooth: expected true or false, found an integer");
}

TEST_F(MeshScene, WritingNamesTheFile) {
  const std::string keys =
      "scale = [1, 2, 3]\nrotate = [10, 20, 30]\ntranslate = [4, 5, 6]\nsmooth = true\nmaterials = {steel = "
      "\"metal\"}\n";
  const Scene read = scene(keys);
  const std::string relative = write_scene(read, folder);
  EXPECT_NE(relative.find("file = \"meshes/solid.obj\"\n"), std::string::npos) << relative;
  EXPECT_EQ(relative.find("vertices"), std::string::npos);
  EXPECT_EQ(relative.find("hash"), std::string::npos);
  EXPECT_EQ(parse_scene(relative, (folder / "other.toml").string()), read);
  EXPECT_NE(write_scene(read, folder / "below").find("file = \"../meshes/solid.obj\"\n"), std::string::npos);
  EXPECT_EQ(parse_scene(write_scene(read), "/nowhere/picture.png"), read) << "a record has whole paths";
}

TEST_F(MeshScene, RecordsNoticeAnotherMesh) {
  const Scene before = scene("");
  const std::string record = write_scene(before);
  EXPECT_EQ(first_change(scene(""), before), "");
  std::ofstream("meshes/solid.obj", std::ios::app) << "v 9 9 9\nf 1 2 5\n";
  EXPECT_NE(first_change(scene(""), before), "");
  EXPECT_EQ(message_of([&] { parse_scene(record, "picture.png"); }).substr(0, 30),
            "picture.png:21:8: file: " + folder.string().substr(0, 6));
  EXPECT_NE(
      message_of([&] { parse_scene(record, "picture.png"); }).find("holds another mesh than when this was written"),
      std::string::npos);
}

// A picture that went to another machine with its mesh beside it.
TEST_F(MeshScene, RecordsFindTheMeshBesideThem) {
  const Scene before = scene("");
  const std::string record = write_scene(before);
  std::filesystem::create_directory("elsewhere");
  std::filesystem::rename("meshes/solid.obj", "elsewhere/solid.obj");
  EXPECT_EQ(message_of([&] { parse_scene(record, "picture.png"); }).substr(0, 24), "picture.png:21:8: file: ");
  const Scene after = parse_scene(record, "elsewhere/picture.png");
  EXPECT_EQ(first_change(after, before), "");
}

}  // namespace
}  // namespace glimt
