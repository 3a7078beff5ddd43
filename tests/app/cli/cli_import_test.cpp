#include "app/cli/cli_test.h"
#include "unit/import/mitsuba_text.h"
#include "unit/mesh/mesh_bytes.h"

using namespace glimt::testing;

namespace {

class CommandLineImport : public CommandLine {
 protected:
  CommandLineImport() {
    write("room.xml", mitsuba_room);
    write("part.obj", obj_tetrahedron);
    write("part.ply", ply_tetrahedron);
    write("part.glb", glb_triangle());
  }
};

TEST_F(CommandLineImport, MakesASceneFileAndListsWhatHasNoCounterpart) {
  const Result result = glimt({"import", "room.xml", "-o", "room.toml"});
  EXPECT_EQ(result.status, 0) << result.err;
  EXPECT_EQ(result.err,
            "room.xml:61: shape disk has no counterpart; in its place: a polygon of 64 corners and the same area\n");
  EXPECT_TRUE(has(read("room.toml"), "file = \"part.obj\"")) << read("room.toml");
  EXPECT_EQ(glimt({"info", "room.toml"}).status, 0);
  const Result strict = glimt({"import", "room.xml", "-o", "strict.toml", "--strict"});
  EXPECT_EQ(strict.status, 2);
  EXPECT_TRUE(has(strict.err, "room.xml: is refused, because --strict allows no replacements")) << strict.err;
  EXPECT_EQ(read("strict.toml"), "");
}

TEST_F(CommandLineImport, CopiesMeshesBesideTheScene) {
  std::filesystem::create_directory(folder / "out");
  EXPECT_EQ(glimt({"import", "part.obj", "-o", "out/near.toml"}).status, 0);
  EXPECT_TRUE(has(read("out/near.toml"), "file = \"../part.obj\"")) << read("out/near.toml");
  EXPECT_EQ(glimt({"import", "part.obj", "-o", "out/own.toml", "--copy-meshes"}).status, 0);
  EXPECT_TRUE(has(read("out/own.toml"), "file = \"part.obj\"")) << read("out/own.toml");
  EXPECT_EQ(read("out/part.obj"), obj_tetrahedron);
  write("out/part.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  const Result taken = glimt({"import", "part.obj", "-o", "out/own.toml", "--copy-meshes"});
  EXPECT_EQ(taken.status, 2);
  EXPECT_TRUE(has(taken.err, "is another mesh already; nothing is written")) << taken.err;
}

TEST_F(CommandLineImport, CopiesTheBuffersOfGltfToo) {
  nlohmann::json json = gltf_triangle();
  json["buffers"][0]["uri"] = "part.bin";
  write("part.bin", gltf_triangle_buffer());
  write("part.gltf", json.dump());
  std::filesystem::create_directory(folder / "out");
  const Result result = glimt({"import", "part.gltf", "-o", "out/own.toml", "--copy-meshes"});
  EXPECT_EQ(result.status, 0) << result.err;
  std::filesystem::remove(folder / "part.bin");
  std::filesystem::remove(folder / "part.gltf");
  const Result info = glimt({"info", "out/own.toml"});
  EXPECT_EQ(info.status, 0) << info.err;
}

TEST_F(CommandLineImport, RendersMeshesAndScenesOfOthersAtOnce) {
  for (const char* file : {"room.xml", "part.obj", "part.ply", "part.glb"}) {
    const Result result = glimt({"render", file, "-o", "out.png", "--size", "24x16", "--spp", "1"});
    EXPECT_EQ(result.status, 0) << file << ": " << result.err;
    EXPECT_GT(read("out.png").size(), 100U) << file;
  }
}

// What a picture holds is opened again.
TEST_F(CommandLineImport, CheckpointsNoticeAnotherMesh) {
  EXPECT_EQ(glimt({"import", "part.obj", "-o", "room.toml"}).status, 0);
  const auto render = [&](const std::string& spp) {
    return glimt({"render", "room.toml", "-o", "room.png", "--size", "24x16", "--spp", spp, "--checkpoint", "room.ckpt",
                  "--resume", "room.ckpt"});
  };
  EXPECT_EQ(render("2").status, 0);
  EXPECT_EQ(render("4").status, 0);
  write("part.obj", std::string(obj_tetrahedron) + "v 3 3 3\nf 1 2 5\n");
  const Result changed = render("6");
  EXPECT_EQ(changed.status, 2);
  EXPECT_TRUE(has(changed.err, "holds another mesh than when this was written")) << changed.err;
}

TEST_F(CommandLineImport, MistakesAreOneLine) {
  const Result missing = glimt({"import", "none.xml", "-o", "a.toml"});
  EXPECT_EQ(missing.status, 2);
  EXPECT_EQ(missing.err, "none.xml: cannot be read: No such file or directory\n");
  EXPECT_EQ(glimt({"import", "part.obj", "-o", "a.png"}).err, "a.png: a scene file's name ends in .toml\n");
  const Result other = glimt({"import", "room.toml", "-o", "a.toml"});
  EXPECT_EQ(other.err, "room.toml: cannot be imported by its ending; allowed are .xml, .gltf, .glb, .obj and .ply\n");
}

}  // namespace
