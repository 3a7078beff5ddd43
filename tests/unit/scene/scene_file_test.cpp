#include "scene/file/scene_file.h"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <fstream>
#include <glm/geometric.hpp>
#include <map>
#include <random>
#include <set>

#include "material/list.h"
#include "scene/fields.h"
#include "scene/validate/validate.h"

namespace glimt {
namespace {

Scene reread(const Scene& scene) { return parse_scene(write_scene(scene), "written.toml"); }

std::filesystem::path scene_path(const std::string& name) { return std::filesystem::path(GLIMT_SCENES) / name; }

/// A camera, an image and one sphere.
Scene small_scene() {
  Scene scene;
  scene.materials = {{.name = "white"}};
  scene.spheres = {{.name = "ball", .material = "white"}};
  return scene;
}

// Scenes of the project.

TEST(SceneFile, ScenesOfTheProjectSurviveWriting) {
  int scenes = 0;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(GLIMT_SCENES)) {
    if (entry.path().extension() != ".toml") continue;
    SCOPED_TRACE(entry.path());
    const Scene scene = read_scene(entry.path());
    EXPECT_EQ(reread(scene), scene);
    EXPECT_EQ(write_scene(reread(scene)), write_scene(scene));
    ++scenes;
  }
  EXPECT_GE(scenes, 9);
}

TEST(SceneFile, HoldsWhatTheFileSays) {
  const Scene scene = read_scene(scene_path("hexagon.toml"));
  EXPECT_EQ(scene.name, "Hexagonal room");
  EXPECT_EQ(scene.camera, (Camera{{-2, 0, 0}, {13, 0, 0}, {0, 1, 0}, 80}));
  EXPECT_EQ(scene.image, (ImageSize{400, 400}));
  EXPECT_EQ(scene.render, Settings{});
  std::vector<std::string> names;
  for (const Material& material : scene.materials) names.push_back(material.name);
  EXPECT_EQ(names, (std::vector<std::string>{"white", "red", "green", "lamp", "mirror", "glass", "clay"}));
  EXPECT_EQ(find_material(scene, "red")->get(Matt::reflectance), glm::dvec3(0.75, 0.15, 0.15));
  EXPECT_EQ(find_material(scene, "lamp")->type, "light");
  EXPECT_EQ(find_material(scene, "lamp")->get(Light::radiance), glm::dvec3(20));
  EXPECT_EQ(find_material(scene, "wood"), nullptr);
  ASSERT_EQ(scene.spheres.size(), 4u);
  EXPECT_EQ(scene.spheres[0], (Sphere{"mirror", "mirror", {8.5, -3.6, -3.8}, 1.4}));
  ASSERT_EQ(scene.polygons.size(), 9u);
  EXPECT_EQ(scene.polygons[8].vertices[3], glm::dvec3(4, 4.99, 1));
  ASSERT_EQ(scene.meshes.size(), 1u);
  EXPECT_EQ(scene.meshes[0].triangles[3], (std::array{2, 3, 0}));
}

TEST(SceneFile, ReportIsTheHexagonWithAnOrenNayarSphere) {
  Scene expected = read_scene(scene_path("hexagon.toml"));
  const Scene report = read_scene(scene_path("report.toml"));
  expected.name = report.name;
  for (Material& material : expected.materials)
    if (material.name == "clay") material.type = "oren-nayar", material.set(OrenNayar::roughness, 0.6);
  EXPECT_EQ(report, expected);
}

/// The derivation is in the file: L = E / (1 - rho) where a closed box of one material glows.
TEST(SceneFile, FurnaceHasTheAnswerThatItStates) {
  const Scene furnace = read_scene(scene_path("furnace.toml"));
  std::map<std::pair<std::vector<double>, std::vector<double>>, int> edges;
  const auto key = [](const glm::dvec3& v) { return std::vector{v.x, v.y, v.z}; };
  ASSERT_EQ(furnace.polygons.size(), 6u);
  for (const Polygon& wall : furnace.polygons) {
    const Material& material = *find_material(furnace, wall.material);
    EXPECT_EQ(material.type, "lambertian");
    const glm::dvec3 radiance = material.get(Matt::emission) / (1.0 - material.get(Matt::reflectance));
    for (int channel = 0; channel < 3; ++channel)
      EXPECT_DOUBLE_EQ(radiance[channel], (std::array{1, 2, 4})[std::size_t(channel)]);
    const auto& v = wall.vertices;
    for (std::size_t i = 0; i < v.size(); ++i) ++edges[{key(v[i]), key(v[(i + 1) % v.size()])}];
    EXPECT_GT(dot(cross(v[1] - v[0], v[2] - v[0]), furnace.camera.eye - v[0]), 0)
        << wall.name << " shows the camera its back";
  }
  for (const auto& [edge, uses] : edges) {
    EXPECT_EQ(uses, 1);
    EXPECT_EQ(edges.count({edge.second, edge.first}), 1u) << "the box is open";
  }
}

// Writing and reading back.

/// A value that differs from the default, exactly representable in few decimals only by chance.
template <class T>
void set_other_value(const Field<T>& field, T& object) {
  const auto between = [&](double share) { return field.min + (field.max - field.min) * share; };
  if (const auto* integer = std::get_if<Value<T, int>>(&field.member))
    integer->set(object, static_cast<int>(field.max) - 1);
  if (const auto* number = std::get_if<Value<T, double>>(&field.member)) number->set(object, between(1 / 3.0));
  if (const auto* vector = std::get_if<Value<T, glm::dvec3>>(&field.member))
    vector->set(object, {between(1 / 3.0), between(1 / 7.0), between(1 / 11.0)});
  if (const auto* choice = std::get_if<Choice<T>>(&field.member))
    choice->set(object, (choice->get(object) + 1) % static_cast<int>(choice->names.size()));
}

template <class T, class Select>
void expect_all_survive(const Scene& scene, std::span<const Field<T>> fields, Select select) {
  for (const Field<T>& field : fields) {
    SCOPED_TRACE(field.key);
    Scene changed = scene;
    T& object = select(changed);
    set_other_value(field, object);
    EXPECT_NE(changed, scene);
    EXPECT_EQ(reread(changed), changed);
  }
}

TEST(SceneFile, EveryFieldSurvivesWriting) {
  const Scene scene = small_scene();
  expect_all_survive(scene, settings_fields(), [](Scene& s) -> Settings& { return s.render; });
  expect_all_survive(scene, camera_fields(), [](Scene& s) -> Camera& { return s.camera; });
  expect_all_survive(scene, image_fields(), [](Scene& s) -> ImageSize& { return s.image; });
  expect_all_survive(scene, sphere_fields(), [](Scene& s) -> Sphere& { return s.spheres[0]; });
  for (const MaterialInfo& info : material_infos()) {
    Scene typed = scene;
    typed.materials[0].type = info.name;
    expect_all_survive(typed, std::span<const Field<Material>>(info.fields),
                       [](Scene& s) -> Material& { return s.materials[0]; });
  }
}

TEST(SceneFile, ParametersThatTheTypeDoesNotReadComeBackAsDefaults) {
  Scene scene = small_scene();
  scene.materials[0].set(Glass::ior, 2);
  const std::string text = write_scene(scene);
  EXPECT_EQ(text.find("ior"), std::string::npos);
  EXPECT_EQ(parse_scene(text, "").materials[0], Material{.name = "white"});
}

TEST(SceneFile, WritesOnlySettingsThatDiffer) {
  Scene scene = small_scene();
  EXPECT_EQ(write_scene(scene).find("[render]"), std::string::npos);
  scene.render.shadow_rays = 3;
  EXPECT_NE(write_scene(scene).find("[render]\nshadow_rays = 3\n\n"), std::string::npos);
}

TEST(SceneFile, OddNamesSurvive) {
  Scene scene = small_scene();
  const std::string odd = "a.b \"c\" \\ [d] = 'e' # \n\t\x01\x7f \xc3\xa4\xe2\x82\xac";
  scene.name = scene.materials[0].name = scene.spheres[0].name = scene.spheres[0].material = odd;
  EXPECT_EQ(reread(scene), scene);
}

/// Any bits that make a coordinate: the shortest text must give back every one of them.
glm::dvec3 random_vector(std::mt19937_64& random) {
  const auto number = [&] {
    while (true)
      if (const double x = std::bit_cast<double>(random()); std::abs(x) <= max_coordinate) return x;
  };
  return {number(), number(), number()};
}

Scene random_scene(std::mt19937_64& random) {
  const auto unit = [&] { return std::uniform_real_distribution<double>(0, 1)(random); };
  const auto colour = [&] { return glm::dvec3(unit(), unit(), unit()); };
  const auto below = [&](std::size_t n) { return random() % n; };
  Scene scene;
  scene.name = std::to_string(random());
  Scene with_camera = small_scene();
  do {
    with_camera.camera = {random_vector(random), random_vector(random), {unit(), unit(), unit()}, 1 + 170 * unit()};
  } while (!validate(with_camera).empty());
  scene.camera = with_camera.camera;
  scene.image = {1 + static_cast<int>(below(4000)), 1 + static_cast<int>(below(4000))};
  scene.render.seed = static_cast<int>(below(1u << 31));
  for (std::size_t i = 0; i < material_infos().size() + below(4); ++i) {
    Material material{.name = "material " + std::to_string(random())};
    material.type = material_infos()[i % material_infos().size()].name;
    if (is_diffuse(material) || material.type == "mirror") material.set(Reflecting::reflectance, colour());
    if (material.type == "conductor")
      material.set(Conductor::eta, colour()), material.set(Conductor::roughness, unit());
    if (material.type == "oren-nayar") material.set(OrenNayar::roughness, unit());
    if (material.type == "lambertian") material.set(Matt::emission, colour() * 1e9);
    if (material.type == "glass") material.set(Glass::ior, 0.1 + unit());
    if (material.type == "light") material.set(Light::radiance, colour() * 1e-300);
    scene.materials.push_back(material);
  }
  const auto not_glass = [&] {
    const std::size_t i = below(scene.materials.size());
    return scene.materials[scene.materials[i].type == "glass" ? 0 : i].name;
  };
  for (std::size_t i = 0; i < 1 + below(5); ++i)
    scene.spheres.push_back({below(2) ? std::to_string(i) : "", not_glass(), random_vector(random), unit() + 1e-9});
  for (std::size_t i = 0; i < below(5); ++i) {
    // Corners on a circle, in order, in a plane through the origin.
    const glm::dvec3 u = normalize(colour() + 0.1), v = normalize(cross(u, colour() - glm::dvec3(0, 2, 0)));
    Polygon polygon{.name = "", .material = not_glass(), .vertices = {}};
    const std::size_t corners = 3 + below(6);
    for (std::size_t k = 0; k < corners; ++k) {
      const double angle = (static_cast<double>(k) + 0.5 * unit()) * 2 * 3.14159265 / static_cast<double>(corners);
      polygon.vertices.push_back(7.0 * (std::cos(angle) * u + std::sin(angle) * v));
    }
    scene.polygons.push_back(polygon);
  }
  for (std::size_t i = 0; i < below(3); ++i) {
    Mesh mesh{.name = "", .material = not_glass(), .vertices = {}, .triangles = {}};
    for (int k = 0; k < 12; ++k) mesh.vertices.edit().push_back(colour());
    for (int k = 0; k < 10; ++k) mesh.triangles.edit().push_back({k, k + 1, k + 2});
    scene.meshes.push_back(mesh);
  }
  return scene;
}

TEST(SceneFile, RandomScenesSurviveWriting) {
  std::mt19937_64 random(1);
  for (int i = 0; i < 300; ++i) {
    const Scene scene = random_scene(random);
    EXPECT_EQ(reread(scene), scene) << write_scene(scene);
  }
}

// What else files may be.

TEST(SceneFile, ByteOrderMarkAndCarriageReturnsAreAccepted) {
  std::ifstream file(scene_path("report.toml"));
  std::string text = "\xef\xbb\xbf";
  for (std::string line; std::getline(file, line);) text += line + "\r\n";
  EXPECT_EQ(parse_scene(text, "windows.toml"), read_scene(scene_path("report.toml")));
}

TEST(SceneFile, InlineTablesAreTables) {
  const Scene scene = parse_scene(R"(
camera = { eye = [0, 0, 5], look_at = [0, 0, 0], fov_y = 45 }
image = { width = 400, height = 400 }
material.white = { type = "lambertian", reflectance = [0.75, 0.75, 0.75] }
sphere = [{ name = "ball", center = [0, 0, 0], radius = 1, material = "white" }]
)",
                                  "inline.toml");
  EXPECT_EQ(scene, small_scene());
}

// Overrides.

Scene with(std::vector<std::string> overrides) { return read_scene(scene_path("report.toml"), overrides); }

TEST(Override, SetsAnyValue) {
  Scene expected = read_scene(scene_path("report.toml"));
  expected.name = "Another name";
  expected.camera.eye = {0, 0, 5};
  expected.camera.look_at.y = 0.5;
  expected.render.spp = 7;
  set_method(expected.render, Method::naive);
  expected.materials[6].set(OrenNayar::roughness, 0.25);
  expected.materials[6].set(OrenNayar::formula, OrenNayarFormula::report);
  expected.spheres[1].radius = 0.5;
  expected.spheres[3].radius = 0.75;
  expected.spheres[0].radius = 0.25;
  expected.polygons[2].material = "lamp";
  expected.polygons[3].material = "white";
  expected.meshes[0].vertices.edit()[3].y = -3;
  EXPECT_EQ(
      with({"name=Another name", "camera.eye=[0,0,5]", "camera.look_at.1=0.5", "render.spp=7", "render.method=naive",
            "material.clay.roughness=0.25", "material.clay.formula = \"report\"", "sphere.oren-nayar.radius=0.5",
            "sphere.3.radius=0.75", "sphere[0].radius=0.25", "polygon.wall 1.material=lamp",
            "polygon.\"wall 2\".material=white", "mesh.tetrahedron.vertices[3][1]=-3"}),
      expected);
}

TEST(Override, TheLastOneCounts) { EXPECT_EQ(with({"render.spp=7", "render.spp=9"}).render.spp, 9); }

TEST(Override, WholeTablesAreMerged) {
  const Scene scene = with({"image={width=20}", "camera={fov_y=30}"});
  EXPECT_EQ(scene.image, (ImageSize{20, 400}));
  EXPECT_EQ(scene.camera, (Camera{{-2, 0, 0}, {13, 0, 0}, {0, 1, 0}, 30}));
}

TEST(Override, NamesComeBeforePlaces) {
  Scene scene = small_scene();
  scene.spheres = {{"1", "white"}, {"0", "white"}};
  const std::vector<std::string> overrides{"sphere.1.radius=2", "sphere[1].radius=3"};
  scene.spheres[0].radius = 2;
  scene.spheres[1].radius = 3;
  EXPECT_EQ(parse_scene(write_scene(scene), "", overrides), scene);
}

TEST(Override, MakesMaterialsAfterThoseOfTheFile) {
  const Scene scene = with({"material.zinc.type=mirror", "material.zinc.reflectance=[0.5,0.5,0.6]",
                            "material.air.type=glass", "material.air.ior=1", "sphere.mirror.material=zinc"});
  ASSERT_EQ(scene.materials.size(), 9u);
  EXPECT_EQ(find_material(scene, scene.spheres[0].material)->get(Mirror::reflectance), glm::dvec3(0.5, 0.5, 0.6));
  EXPECT_EQ(scene.materials[6].name, "clay");
  EXPECT_EQ(find_material(scene, "air")->get(Glass::ior), 1);
}

TEST(Override, AnotherTypeLeavesTheFilesParametersBehind) {
  const Scene scene = with({"material.clay.type=lambertian", "material.mirror.type=glass", "material.mirror.ior=1.2"});
  EXPECT_EQ(scene.materials[6], (Material{.name = "clay", .type = "lambertian"}));
  EXPECT_EQ(scene.materials[4], (Material{.name = "mirror", .type = "glass"}.with(Glass::ior, 1.2)));
  EXPECT_EQ(reread(scene), scene);
}

}  // namespace
}  // namespace glimt
