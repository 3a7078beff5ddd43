#include "import/import.h"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <glm/ext/matrix_transform.hpp>
#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>
#include <map>
#include <random>

#include "app/own_folder.h"
#include "compile/compiled_scene.h"
#include "import/placement_of.h"
#include "material/list.h"
#include "scene/file/scene_file.h"
#include "scene/validate/validate.h"
#include "unit/import/mitsuba_text.h"
#include "unit/mesh/mesh_bytes.h"

namespace glimt {
namespace {

using namespace testing;
using glm::dvec3;

template <class Read>
std::string message_of(Read read) {
  try {
    read();
  } catch (const SceneError& error) {
    return error.what();
  }
  return "accepted";
}

void expect_near(const dvec3& a, const dvec3& b, double tolerance = 1e-9) {
  EXPECT_LT(length(a - b), tolerance) << a.x << " " << a.y << " " << a.z << ", not " << b.x << " " << b.y << " " << b.z;
}

class Import : public OwnFolder {
 protected:
  void SetUp() override {
    OwnFolder::SetUp();
    std::ofstream("part.obj") << obj_tetrahedron;
    std::ofstream("part.ply") << ply_tetrahedron;
  }
  static ImportedScene import(const std::string& text) {
    std::ofstream("room.xml") << text;
    return import_scene("room.xml");
  }
  /// A scene of one sphere with this bsdf.
  static Material bsdf(const std::string& text) {
    return import("<scene version='3.0.0'><shape type='sphere'>" + text + "</shape></scene>").scene.materials.at(0);
  }
  static std::string with(std::string text, const std::string& from, const std::string& to) {
    return text.replace(text.find(from), from.size(), to);
  }
};

// Mitsuba.

TEST_F(Import, MitsubaRoomIsWholeAndCanBeRendered) {
  const ImportedScene imported = import(mitsuba_room);
  const Scene& scene = imported.scene;
  ASSERT_EQ(imported.notes.size(), 1u);
  EXPECT_EQ(text_of(imported.notes[0]),
            "room.xml:61: shape disk has no counterpart; in its place: a polygon of 64 corners and the same area");
  for (const Problem& problem : validate(scene)) ADD_FAILURE() << problem.path << ": " << problem.message;
  EXPECT_EQ(scene.image, (ImageSize{120, 80}));
  EXPECT_EQ(scene.render.spp, 32);
  EXPECT_EQ(scene.render.max_depth, 8);
  expect_near(scene.camera.eye, {0, 1, 6});
  expect_near(normalize(scene.camera.look_at - scene.camera.eye), {0, 0, -1});
  expect_near(scene.camera.up, {0, 1, 0});
  // 60 degrees across 120 pixels: tan 30 over 1.5 up and down.
  EXPECT_NEAR(scene.camera.fov_y, 2 * std::atan(std::tan(glm::pi<double>() / 6) / 1.5) * 180 / glm::pi<double>(), 1e-9);

  EXPECT_EQ(find_material(scene, "white")->get(Matt::reflectance), dvec3(0.7, 0.6, 0.5));
  const Material& gold = *find_material(scene, "gold");
  EXPECT_EQ(gold.get(Conductor::preset), Metal::gold);
  EXPECT_NEAR(gold.get(Conductor::roughness), 0.3, 1e-12) << "alpha is roughness squared";
  EXPECT_EQ(find_material(scene, "mirror")->type, "mirror");
  EXPECT_DOUBLE_EQ(find_material(scene, "glass")->get(Glass::ior), 1.5);
  EXPECT_DOUBLE_EQ(find_material(scene, "frosted")->get(Glass::ior), 1.333);
  EXPECT_NEAR(find_material(scene, "frosted")->get(Glass::roughness), 0.2, 1e-12);

  ASSERT_EQ(scene.polygons.size(), 3u);
  const auto normal = [](const Polygon& p) {
    return normalize(cross(p.vertices[1] - p.vertices[0], p.vertices[2] - p.vertices[0]));
  };
  expect_near(normal(scene.polygons[0]), {0, 1, 0});
  expect_near(normal(scene.polygons[1]), {0, -1, 0});
  expect_near(scene.polygons[1].vertices[0] * dvec3(0, 1, 0), {0, 4, 0});
  EXPECT_EQ(find_material(scene, scene.polygons[1].material)->get(Light::radiance), dvec3(9));
  ASSERT_EQ(scene.spheres.size(), 1u);
  EXPECT_EQ(scene.spheres[0].center, dvec3(-1.5, 1, 0));
  ASSERT_EQ(scene.meshes.size(), 3u);
  EXPECT_EQ(scene.meshes[1].name, "solid");
  EXPECT_FALSE(scene.meshes[1].smooth);
  EXPECT_TRUE(scene.meshes[2].smooth);
  expect_near(scene.meshes[1].file->placement.scale, dvec3(0.5));
  // x -> -z, y -> y, z -> x, moved by -3 along x.
  expect_near(scene.meshes[2].vertices[1], {-3, 0, -1});
  EXPECT_FALSE(compile(scene).compiled_in.empty());
}

TEST_F(Import, MitsubaRoomSurvivesWriting) {
  const ImportedScene imported = import(mitsuba_room);
  const Scene again = parse_scene(write_scene(imported.scene), "room.toml");
  EXPECT_EQ(write_scene(again), write_scene(imported.scene));
  EXPECT_EQ(parse_scene(write_scene(imported.scene, folder), "room.toml"), again) << "relative paths";
}

TEST_F(Import, BsdfsAreMapped) {
  EXPECT_EQ(bsdf("<bsdf type='diffuse'/>").get(Matt::reflectance), dvec3(0.5));
  EXPECT_EQ(bsdf("").get(Matt::reflectance), dvec3(0.5));
  EXPECT_EQ(bsdf("<bsdf type='diffuse'><rgb name='reflectance' value='#ff00ff'/></bsdf>").get(Matt::reflectance),
            dvec3(1, 0, 1));
  expect_near(bsdf("<bsdf type='diffuse'><rgb name='reflectance' value='#808080'/></bsdf>").get(Matt::reflectance),
              dvec3(0.2158605), 1e-6);
  EXPECT_NEAR(bsdf("<bsdf type='dielectric'/>").get(Glass::ior), 1.5046 / 1.000277, 1e-12);
  EXPECT_EQ(bsdf("<bsdf type='conductor'/>").get(Conductor::preset), Metal::copper);
  const Material metal =
      bsdf("<bsdf type='roughconductor'><rgb name='eta' value='1 2 3'/><rgb name='k' value='4 5 6'/></bsdf>");
  EXPECT_EQ(metal.get(Conductor::eta), dvec3(1, 2, 3));
  EXPECT_EQ(metal.get(Conductor::k), dvec3(4, 5, 6));
  EXPECT_NEAR(metal.get(Conductor::roughness), std::sqrt(0.1), 1e-12);
}

// A rough conductor of material "none" reflects all light: Fresnel's factor of an imaginary index is 1.
TEST_F(Import, MetalOfNoMaterialReflectsAll) {
  const Material m = bsdf(
      "<bsdf type='roughconductor'><string name='material' value='none'/><float name='alpha' value='0.2'/></bsdf>");
  for (const float cos : {0.0F, 0.1F, 0.5F, 1.0F})
    EXPECT_NEAR(
        conductor_fresnel(cos, static_cast<float>(m.get(Conductor::eta).x), static_cast<float>(m.get(Conductor::k).x)),
        1.0F, 1e-6F);
}

TEST_F(Import, FieldOfViewIsOfTheAxisThatIsNamed) {
  const auto fov_y = [&](const std::string& axis, int width, int height) {
    std::string text = with(mitsuba_room, "value=\"x\"", "value=\"" + axis + "\"");
    text = with(text, "\"$size\"", "\"" + std::to_string(width) + "\"");
    return import(with(text, "value=\"80\"", "value=\"" + std::to_string(height) + "\"")).scene.camera.fov_y;
  };
  const auto degrees = [](double tangent) { return 2 * std::atan(tangent) * 180 / glm::pi<double>(); };
  const double t = std::tan(glm::pi<double>() / 6);
  EXPECT_NEAR(fov_y("y", 200, 100), 60, 1e-9);
  EXPECT_NEAR(fov_y("smaller", 200, 100), 60, 1e-9);
  EXPECT_NEAR(fov_y("larger", 200, 100), degrees(t / 2), 1e-9);
  EXPECT_NEAR(fov_y("smaller", 100, 200), degrees(2 * t), 1e-9);
  EXPECT_NEAR(fov_y("diagonal", 100, 100), degrees(t / std::sqrt(2)), 1e-9);
}

TEST_F(Import, IncludesAndParametersAreFilledIn) {
  std::ofstream("materials.xml")
      << "<scene version='3.0.0'><bsdf type='diffuse' id='m'><rgb name='reflectance' value='$grey'/></bsdf></scene>";
  const ImportedScene imported = import(
      "<scene version='3.0.0'><default name='grey' value='0.25'/><include filename='materials.xml'/>"
      "<shape type='sphere'><ref id='m'/></shape><bsdf type='diffuse' id='unused'/></scene>");
  EXPECT_EQ(find_material(imported.scene, "m")->get(Matt::reflectance), dvec3(0.25));
}

TEST_F(Import, ElderSpellingIsUnderstood) {
  const Material m =
      bsdf("<bsdf type='dielectric'><float name='intIOR' value='1.4'/><float name='extIOR' value='1'/></bsdf>");
  EXPECT_DOUBLE_EQ(m.get(Glass::ior), 1.4);
}

TEST_F(Import, WhatHasNoCounterpartIsListed) {
  const ImportedScene imported = import(R"(<scene version="3.0.0">
<emitter type="envmap"/>
<shape type="cylinder"/>
<shape type="sphere">
  <bsdf type="plastic"><rgb name="diffuse_reflectance" value="0.1 0.2 0.3"/></bsdf>
</shape>
</scene>)");
  std::vector<std::string> notes;
  for (const ImportNote& note : imported.notes) notes.push_back(text_of(note));
  EXPECT_EQ(notes,
            (std::vector<std::string>{
                "room.xml:2: emitter envmap has no counterpart; in its place: nothing",
                "room.xml:3: shape cylinder has no counterpart; in its place: nothing",
                "room.xml:5: bsdf plastic has no counterpart; in its place: lambertian of its diffuse_reflectance",
                "room.xml: a scene without an area light has no counterpart; in its place: a lit room around it"}));
  EXPECT_EQ(imported.scene.materials[0].get(Matt::reflectance), dvec3(0.1, 0.2, 0.3));
}

TEST_F(Import, MitsubaMistakesNameTheirLine) {
  EXPECT_EQ(message_of([] { import("<scene>\n<shape"); }).substr(0, 11), "room.xml:2:");
  EXPECT_EQ(message_of([] { import("<html/>"); }),
            "room.xml:1: is no scene of Mitsuba: its outermost element is <html>, not <scene>");
  EXPECT_EQ(message_of([] { import("<scene>\n<shape type='sphere'><ref id='x'/></shape></scene>"); }),
            "room.xml:2: refers to \"x\", which is not there");
  EXPECT_EQ(
      message_of([] { import("<scene>\n<shape type='sphere'>\n<float name='radius' value='two'/></shape></scene>"); }),
      "room.xml:3: has \"two\" where numbers are due");
  EXPECT_EQ(message_of([] {
              import("<scene>\n<shape type='obj'><string name='filename' value='none.obj'/></shape></scene>");
            }).substr(0, 12),
            "room.xml:2: ");
  EXPECT_EQ(message_of([] { import("<scene><bsdf type='$x'/></scene>"); }),
            "room.xml:1: names the parameter $x, which has no default");
  std::string nested;
  for (int i = 0; i < 100000; ++i) nested += "<a>";
  EXPECT_NE(message_of([&] { import("<scene>" + nested + "</scene>"); }), "accepted");
}

TEST_F(Import, ParametersWithinParametersEnd) {
  std::string text = "<scene><default name='a0' value='0123456789'/>";
  for (int i = 1; i < 30; ++i) {
    const std::string last = "$a" + std::to_string(i - 1);
    text += "<default name='a" + std::to_string(i) + "' value='" + last + last + last + last + "'/>";
  }
  EXPECT_NE(message_of([&] { import(text + "</scene>"); }).find("too long"), std::string::npos);
}

// T = move * turn * scale is found again, mirrored or not, for any angles; a shear is not one.
TEST(PlacementOf, FindsScaleTurnAndMove) {
  std::mt19937 random(3);
  const auto uniform = [&](double low, double high) { return std::uniform_real_distribution(low, high)(random); };
  for (int round = 0; round < 1000; ++round) {
    const Placement made{{uniform(0.1, 3) * (round % 2 ? -1 : 1), uniform(0.1, 3), uniform(0.1, 3)},
                         {uniform(-180, 180),
                          round % 5   ? uniform(-180, 180)
                          : round % 3 ? 90
                                      : -90,
                          uniform(-180, 180)},
                         {uniform(-9, 9), uniform(-9, 9), uniform(-9, 9)}};
    MeshData axes;
    axes.vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    const auto images = place(axes, made, false).vertices;
    glm::dmat4 matrix{1};
    for (int i = 0; i < 3; ++i) matrix[i] = glm::dvec4(images[std::size_t(i) + 1] - images[0], 0);
    matrix[3] = glm::dvec4(images[0], 1);
    const auto found = placement_of(matrix);
    ASSERT_TRUE(found) << round;
    const auto again = place(axes, *found, false).vertices;
    for (std::size_t i = 0; i < 4; ++i) expect_near(again[i], images[i], 1e-7);
  }
  glm::dmat4 shear{1};
  shear[1][0] = 0.3;
  EXPECT_FALSE(placement_of(shear));
  EXPECT_FALSE(placement_of(glm::scale(glm::dmat4{1}, {1, 0, 1})));
}

// glTF and bare meshes.

TEST_F(Import, GltfHasItsCameraAndMaterials) {
  nlohmann::json json = gltf_triangle();
  json["cameras"] = nlohmann::json::parse(
      R"([{"type": "perspective", "perspective": {"yfov": 0.5, "aspectRatio": 2, "znear": 0.1}}])");
  json["nodes"].push_back({{"camera", 0}, {"translation", {1, 2, 3}}});
  json["scenes"][0]["nodes"].push_back(2);
  json["materials"].push_back(
      {{"name", "metal"},
       {"pbrMetallicRoughness", {{"baseColorFactor", {0.9, 0.5, 0.1, 1}}, {"roughnessFactor", 0.4}}}});
  json["materials"].push_back({{"name", "glow"},
                               {"emissiveFactor", {1, 0.5, 0}},
                               {"extensions", {{"KHR_materials_emissive_strength", {{"emissiveStrength", 4}}}}}});
  std::ofstream("a.glb", std::ios::binary) << glb(json.dump(), gltf_triangle_buffer());
  const ImportedScene imported = import_scene("a.glb");
  const Scene& scene = imported.scene;
  EXPECT_EQ(scene.camera.eye, dvec3(1, 2, 3));
  expect_near(normalize(scene.camera.look_at - scene.camera.eye), {0, 0, -1});
  EXPECT_NEAR(scene.camera.fov_y, 0.5 * 180 / glm::pi<double>(), 1e-12);
  EXPECT_EQ(scene.image.width, 2 * scene.image.height);
  EXPECT_EQ(find_material(scene, "red")->get(Matt::reflectance), dvec3(1, 0, 0));
  const Material& metal = *find_material(scene, "metal");
  EXPECT_DOUBLE_EQ(metal.get(Conductor::roughness), 0.4);
  for (int i = 0; i < 3; ++i)
    EXPECT_NEAR(conductor_fresnel(1.0F, float(metal.get(Conductor::eta)[i]), float(metal.get(Conductor::k)[i])),
                (std::array{0.9F, 0.5F, 0.1F})[std::size_t(i)], 1e-5F)
        << "reflected straight back";
  EXPECT_EQ(find_material(scene, "glow")->get(Light::radiance), dvec3(4, 2, 0));
  ASSERT_EQ(scene.meshes.size(), 1u);
  EXPECT_EQ(scene.meshes[0].material, "red");
}

TEST_F(Import, BareMeshesStandInALitRoom) {
  std::ofstream("a.glb", std::ios::binary) << glb_triangle();
  for (const char* file : {"part.obj", "part.ply", "a.glb"}) {
    SCOPED_TRACE(file);
    const ImportedScene imported = read_or_import(file);
    EXPECT_TRUE(imported.notes.empty());
    EXPECT_EQ(imported.scene.meshes.size(), 1u);
    EXPECT_TRUE(validate(imported.scene).empty());
    const CompiledScene compiled = compile(imported.scene);
    EXPECT_NE(std::ranges::find_if(compiled.compiled_in,
                                   [](const std::string& s) { return s.find("room") != std::string::npos; }),
              compiled.compiled_in.end())
        << "the room around the camera is closed";
  }
}

TEST_F(Import, OverridesChangeWhatIsImported) {
  const std::vector<std::string> overrides{"mesh.part.scale=2", "image.width=33"};
  const Scene scene = read_or_import("part.obj", overrides).scene;
  EXPECT_EQ(scene.image.width, 33);
  EXPECT_EQ(scene.meshes[0].vertices[1], dvec3(2, 0, 0));
  EXPECT_EQ(message_of([] { read_or_import("part.stl"); }), "part.stl: cannot be read: No such file or directory");
}

}  // namespace
}  // namespace glimt
