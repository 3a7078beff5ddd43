#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>

#include "compile/compiled_scene.h"
#include "lamp/list.h"
#include "material/lobes.h"
#include "scene/file/scene_file.h"
#include "scene_parts.h"

using namespace glimt;

namespace {

bool mentions(const std::vector<std::string>& lines, const std::string& text) {
  return std::ranges::any_of(lines, [&](const std::string& line) { return line.find(text) != std::string::npos; });
}

Scene from_file(const std::string& name) { return read_scene(GLIMT_SCENES "/" + name + ".toml"); }

/// A white box [-1, 1]^3 around the camera, with a lamp below its ceiling.
Scene lit_box() {
  Scene scene;
  scene.materials = {lambertian("white", dvec3{0.5}), light("lamp", {4, 5, 6}), mirror("mirror", dvec3{0.9}),
                     glass("glass", 1.5)};
  scene.polygons = box(dvec3{-1}, dvec3{1}, "white");
  scene.polygons.push_back({"lamp", "lamp", {{-0.2, 0.9, -0.2}, {0.2, 0.9, -0.2}, {0.2, 0.9, 0.2}, {-0.2, 0.9, 0.2}}});
  scene.camera = {{0, 0, 0.9}, {0, 0, 0}, {0, 1, 0}, 60};
  return scene;
}

template <class L>
bool has(const CompiledScene& scene) {
  return (scene.lobes & lobe_bit<L>) != 0;
}

TEST(Compile, HexagonIsARoomOfFourSlabs) {
  const CompiledScene c = compile(from_file("hexagon"));
  EXPECT_EQ(c.room.size(), 4u) << "eight faces in pairs";
  EXPECT_TRUE(mentions(c.compiled_in, "8 faces as 4 pairs"));
  EXPECT_EQ(c.polygons.size(), 1u) << "the lamp, 1 cm below the ceiling";
  EXPECT_EQ(c.lamps.rows(), 1);
  EXPECT_EQ(c.spheres.size(), 3u);
  EXPECT_EQ(c.glass_spheres.size(), 1u);
  EXPECT_FALSE(c.room_hides_lamps);
  EXPECT_TRUE(c.has_glass && has<MirrorLobe>(c));
  EXPECT_FALSE(has<OrenNayarLobe>(c) || c.has_glow);
  EXPECT_EQ(c.max_radiance, 20);
  EXPECT_TRUE(c.warnings.empty());
}

TEST(Compile, TetrahedronOnTheFloorLosesItsBottom) {
  const CompiledScene c = compile(from_file("hexagon"));
  ASSERT_EQ(c.solids.size(), 1u);
  EXPECT_EQ(c.solid_planes.size(), 3u);
  EXPECT_TRUE(c.triangles.empty());
  EXPECT_TRUE(mentions(c.left_out, "a face of \"tetrahedron\""));
  Scene raised = from_file("hexagon");
  for (dvec3& v : raised.meshes[0].vertices.edit()) v.y += 0.01;
  EXPECT_EQ(compile(raised).solid_planes.size(), 4u);
}

TEST(Compile, LeavesOutWhatTheSceneDoesNotNeed) {
  const CompiledScene c = compile(from_file("hexagon_empty"));
  for (const char* feature : {"mirror", "glass", "Oren-Nayar", "EON", "glowing"})
    EXPECT_TRUE(mentions(c.left_out, feature)) << feature;
  EXPECT_FALSE(c.has_glass || c.has_glow);
  EXPECT_EQ(c.lobes, lobe_bit<LambertianLobe> | lobe_bit<LampLobe>);
  EXPECT_TRUE(has<OrenNayarLobe>(compile(from_file("report"))));
  EXPECT_TRUE(compile(from_file("furnace")).has_glow);
}

TEST(Compile, OpenCornellBoxIsNoRoom) {
  const CompiledScene c = compile(from_file("cornell"));
  EXPECT_TRUE(c.room.empty());
  EXPECT_EQ(c.polygons.size(), 6u);
}

TEST(Compile, RoomSeenFromOutsideIsPolygons) {
  Scene scene = lit_box();
  EXPECT_EQ(compile(scene).room.size(), 3u);
  scene.camera.eye.z = 3;
  const CompiledScene c = compile(scene);
  EXPECT_TRUE(c.room.empty());
  EXPECT_EQ(c.polygons.size(), 7u);
}

TEST(Compile, CeilingMayBeSeveralPolygons) {
  Scene scene = lit_box();
  std::vector<dvec3>& ceiling = scene.polygons[1].vertices;
  Polygon other = scene.polygons[1];
  other.name = "other half";
  ceiling[1].x = ceiling[2].x = 0.25;
  other.vertices[0].x = other.vertices[3].x = 0.25;
  scene.polygons.push_back(other);
  const CompiledScene c = compile(scene);
  EXPECT_EQ(c.room.size(), 3u);
  EXPECT_EQ(c.polygons.size(), 1u) << "the lamp";
  scene.materials.push_back(lambertian("grey", dvec3{0.4}));
  scene.polygons.back().material = "grey";
  EXPECT_TRUE(compile(scene).room.empty());
}

// The whole ceiling of 2 m x 2 m is one parallelogram; its power alone is in the table.
TEST(Compile, CeilingMayBeALamp) {
  Scene scene = lit_box();
  scene.render.light_sampling = LightSampling::area;
  scene.polygons.pop_back();
  scene.polygons[1].material = "lamp";
  const CompiledScene c = compile(scene);
  EXPECT_EQ(c.room.size(), 3u);
  ASSERT_EQ(c.lamps.rows(), 1);
  EXPECT_FLOAT_EQ(c.lamps[LampColumn::weight_g][0], 5 * 4);
  EXPECT_EQ(c.lamps[lamp_column(FlatColumn::normal_y)][0], -1);
  std::ranges::reverse(scene.polygons[1].vertices);
  const CompiledScene turned = compile(scene);
  EXPECT_EQ(turned.room.size(), 3u);
  EXPECT_EQ(turned.lamps.rows(), 0) << "it shines to the outside";
}

TEST(Compile, LampInThePlaneOfTheCeilingIsLeftOutWithAWarning) {
  Scene scene = lit_box();
  for (dvec3& v : scene.polygons.back().vertices) v.y = 1;
  const CompiledScene c = compile(scene);
  EXPECT_EQ(c.lamps.rows(), 0);
  EXPECT_TRUE(mentions(c.warnings, "\"lamp\" lies in the plane of a wall"));
  EXPECT_TRUE(mentions(c.warnings, "black"));
  // The same lamp as a mesh, there and above the ceiling.
  for (const double y : {1.0, 1.5}) {
    Scene with_mesh = scene;
    with_mesh.polygons.pop_back();
    with_mesh.meshes = {{"lamp", "lamp", scene.polygons.back().vertices, {{0, 1, 2}, {0, 2, 3}}}};
    for (dvec3& v : with_mesh.meshes[0].vertices.edit()) v.y = y;
    EXPECT_TRUE(
        mentions(compile(with_mesh).warnings, y > 1 ? "\"lamp\" is outside" : "\"lamp\" lies in the plane of a wall"));
  }
}

TEST(Compile, ObjectsOutsideTheRoomAreLeftOut) {
  Scene scene = lit_box();
  scene.spheres = {
      {"out", "white", {3, 0, 0}, 0.5}, {"pierces", "white", {1, 0, 0}, 0.5}, {"in", "white", {0, 0, 0}, 0.5}};
  scene.polygons.push_back({"lamp outside", "lamp", {{0, 2, 0}, {1, 2, 0}, {1, 2, 1}}});
  scene.meshes = {tetrahedron("mesh outside", "white", {0, 0, -5}, 1)};
  const CompiledScene c = compile(scene);
  EXPECT_EQ(c.spheres.size(), 2u);
  EXPECT_EQ(c.lamps.rows(), 1);
  EXPECT_TRUE(c.solids.empty());
  for (const char* name : {"\"out\"", "\"lamp outside\"", "\"mesh outside\""})
    EXPECT_TRUE(mentions(c.left_out, name)) << name;
  EXPECT_TRUE(mentions(c.warnings, "\"lamp outside\" is outside the closed room"));
}

TEST(Compile, NamesTheMaterialsThatItCompilesIn) {
  Scene scene = lit_box();
  scene.materials.push_back(eon("soft", 0.5, dvec3{0.5}));
  scene.spheres = {{"ball", "soft", {0, 0, 0}, 0.5}, {"in glass", "glass", {0, -0.7, 0}, 0.1}};
  const CompiledScene c = compile(scene);
  EXPECT_TRUE(mentions(c.compiled_in, "EON") && mentions(c.compiled_in, "glass"));
  EXPECT_TRUE(mentions(c.left_out, "Oren-Nayar") && mentions(c.left_out, "mirror reflection"));
  scene.materials.back().set(Eon::roughness, 0);
  EXPECT_TRUE(mentions(compile(scene).left_out, "EON")) << "smooth, it is Lambertian";
}

// Half of such a lamp is behind the wall, from which no light may come in.
TEST(Compile, WallsHideLampsThatPierceThem) {
  Scene scene = lit_box();
  EXPECT_FALSE(compile(scene).room_hides_lamps);
  scene.spheres = {{"bulb", "lamp", {0, 1, 0}, 0.3}};
  EXPECT_TRUE(compile(scene).room_hides_lamps);
  scene.spheres.clear();
  const std::vector<dvec3> pane{{0.5, 0.5, 0}, {0.5, 1.5, 0}, {0.9, 1.5, 0}};
  scene.polygons.push_back({"pane", "lamp", pane});
  EXPECT_TRUE(compile(scene).room_hides_lamps);
  scene.polygons.pop_back();
  scene.meshes = {{"pane", "lamp", pane, {{0, 1, 2}}}};
  EXPECT_TRUE(compile(scene).room_hides_lamps) << "an open mesh";
  scene.meshes = {tetrahedron("closed", "lamp", {0, 1, 0}, 0.3)};
  EXPECT_TRUE(compile(scene).room_hides_lamps);
}

TEST(Compile, RoomMayBeOneMeshInsideOutOrNot) {
  Scene scene = lit_box();
  const Polygon lamp = scene.polygons.back();
  scene.polygons = {lamp};
  for (const bool inwards : {true, false}) {
    scene.meshes = {box_mesh(dvec3{-1}, dvec3{1}, "white", inwards)};
    const CompiledScene c = compile(scene);
    EXPECT_EQ(c.room.size(), 3u) << inwards;
    EXPECT_TRUE(c.triangles.empty() && c.solids.empty()) << inwards;
    scene.meshes[0].material = "lamp";
    EXPECT_EQ(compile(scene).lamps.rows(), inwards ? 7 : 1) << "walls that glow to the inside only";
  }
}

TEST(Compile, PartitionWallMakesTheRoomSmaller) {
  Scene scene = lit_box();
  scene.polygons.push_back({"partition", "mirror", {{-1, -1, -0.5}, {1, -1, -0.5}, {1, 1, -0.5}, {-1, 1, -0.5}}});
  scene.spheres = {{"behind", "white", {0, 0, -0.8}, 0.1}};
  const CompiledScene c = compile(scene);
  EXPECT_EQ(c.room.size(), 3u);
  EXPECT_TRUE(has<MirrorLobe>(c));
  EXPECT_TRUE(mentions(c.left_out, "\"behind\""));
}

TEST(Compile, ASphereAroundTheCameraIsAShell) {
  Scene scene = lit_box();
  scene.polygons.clear();
  scene.spheres = {
      {"sky", "white", {0, 0, 0}, 5}, {"ball", "white", {0, 0, 0}, 0.5}, {"drop", "glass", {0, 0, 1}, 0.3}};
  const CompiledScene c = compile(scene);
  EXPECT_EQ(c.shells.size(), 1u);
  EXPECT_EQ(c.spheres.size(), 1u);
  EXPECT_EQ(c.glass_spheres.size(), 1u) << "around the camera too, and glass still";
}

// Ten thousand kilometres away doubles still hold 1e-9 m; what the kernel reads is the same up to that.
TEST(Compile, ASceneFarAwayIsTheSame) {
  for (const double distance : {1e4, 1e7}) {
    Scene scene = from_file("hexagon");
    const CompiledScene near = compile(scene);
    const dvec3 by{distance, -distance / 2, distance / 4};
    scene.camera.eye += by, scene.camera.look_at += by;
    for (Sphere& s : scene.spheres) s.center += by;
    for (Polygon& p : scene.polygons)
      for (dvec3& v : p.vertices) v += by;
    for (Mesh& m : scene.meshes)
      for (dvec3& v : m.vertices.edit()) v += by;
    const CompiledScene far = compile(scene);
    ASSERT_EQ(far.room.size(), near.room.size());
    ASSERT_EQ(far.solid_planes.size(), near.solid_planes.size());
    ASSERT_EQ(far.surfaces.rows(), near.surfaces.rows());
    const double allowed = 2e-6 + distance * 1e-14;
    auto expect_near = [&](float a, float b) { EXPECT_NEAR(a, b, allowed) << "moved by " << distance; };
    for (std::size_t i = 0; i < near.room.size(); ++i) {
      expect_near(far.room[i].middle, near.room[i].middle);
      expect_near(far.room[i].half, near.room[i].half);
    }
    for (std::size_t i = 0; i < near.solid_planes.size(); ++i)
      expect_near(far.solid_planes[i].d, near.solid_planes[i].d);
    for (std::size_t i = 0; i < near.spheres.size(); ++i) expect_near(far.spheres[i].cy, near.spheres[i].cy);
    for (std::size_t k = 0; k < 3; ++k) {
      expect_near(far.camera.eye[k], near.camera.eye[k]);
      expect_near(far.camera.corner[k], near.camera.corner[k]);
    }
  }
}

float eta_of(const CompiledScene& c, float inverse_radius) {
  for (std::size_t i = 0; i < static_cast<std::size_t>(c.surfaces.rows()); ++i)
    if (std::abs(c.surfaces[Column::inverse_radius][i] - inverse_radius) < 1e-6f) return c.surfaces[Column::eta][i];
  return 0;
}

// eta is the index behind the surface over that in front: of water in glass 1.33 / 1.5, of air (ior 1) in water 1
// / 1.33.
TEST(Compile, NestedGlassKnowsWhatIsAroundIt) {
  Scene scene = lit_box();
  scene.materials.push_back(glass("water", 1.33));
  scene.materials.push_back(glass("air", 1));
  scene.spheres = {{"outer", "glass", {0, 0, 0}, 0.5},
                   {"middle", "water", {0, 0, 0}, 0.25},
                   {"inner", "air", {0.05, 0, 0}, 0.125},
                   {"beside", "glass", {0.7, 0.7, 0}, 0.1}};
  const CompiledScene c = compile(scene);
  EXPECT_FLOAT_EQ(eta_of(c, 2), 1.5f);
  EXPECT_FLOAT_EQ(eta_of(c, 4), 1.33f / 1.5f);
  EXPECT_FLOAT_EQ(eta_of(c, 8), 1 / 1.33f);
  EXPECT_FLOAT_EQ(eta_of(c, 10), 1.5f);
}

TEST(Compile, NestedGlassMeshesWithoutNamesToo) {
  Scene scene = lit_box();
  scene.materials.push_back(glass("water", 1.33));
  scene.meshes = {box_mesh(dvec3{-0.5}, dvec3{0.5}, "glass", false), tetrahedron("", "water", {0, 0, 0}, 0.3)};
  for (Mesh& m : scene.meshes) m.name.clear();
  for (const bool turned_round : {false, true}) {
    if (turned_round) std::ranges::reverse(scene.meshes);
    const CompiledScene c = compile(scene);
    int outer = 0, inner = 0;
    for (const SolidPlane& plane : c.solid_planes) {
      const float eta = c.surfaces[Column::eta][static_cast<std::size_t>(plane.surface)];
      outer += std::abs(eta - 1.5f) < 1e-6f ? 1 : 0;
      inner += std::abs(eta - 1.33f / 1.5f) < 1e-6f ? 1 : 0;
    }
    EXPECT_EQ(outer, 6) << turned_round;
    EXPECT_EQ(inner, 4) << turned_round;
  }
}

// Each entry of an alias table stands for 1/n: what it keeps goes to itself, the rest to the other. Together that is
// the probability in proportion to area times radiance. The weight is radiance times area over it (of a sphere,
// radiance over it).
TEST(Compile, AliasTableHoldsTheLampsPowers) {
  Scene scene = lit_box();
  scene.materials.push_back(light("bright", {100, 0, 0}));
  scene.materials.push_back(light("dark", dvec3{0}));
  scene.spheres = {{"bulb", "bright", {0.5, 0, 0}, 0.1}, {"off", "dark", {-0.5, 0, 0}, 0.1}};
  scene.polygons.push_back(disk("disk", "lamp", {0, 0, -0.9}, {0, 0, 1}, 0.3, 7));
  scene.meshes = {tetrahedron("mesh", "bright", {0, -0.5, 0}, 0.05)};
  const CompiledScene c = compile(scene);
  const auto n = static_cast<std::size_t>(c.lamps.rows());
  ASSERT_EQ(n, 1u + 1u + 5u + 4u)
      << "a parallelogram, a sphere, seven corners, four sides; none of the one without radiance";
  std::vector<double> chosen(n);
  for (std::size_t i = 0; i < n; ++i) {
    const double keep = static_cast<double>(c.lamps[LampColumn::alias_threshold][i]);
    chosen[i] += keep / static_cast<double>(n);
    chosen[static_cast<std::size_t>(std::bit_cast<std::int32_t>(c.lamps[LampColumn::alias_other][i]))] +=
        (1 - keep) / static_cast<double>(n);
  }
  std::vector<double> power(n);
  double total = 0;
  for (std::size_t i = 0; i < n; ++i) {
    auto vec = [&](LampColumn first) {
      auto at = [&](int k) {
        return static_cast<double>(c.lamps[static_cast<LampColumn>(static_cast<int>(first) + k)][i]);
      };
      return dvec3{at(0), at(1), at(2)};
    };
    const dvec3 weight = vec(LampColumn::weight_r);
    const auto shape = std::bit_cast<std::int32_t>(c.lamps[LampColumn::shape][i]);
    const bool sphere = shape == lamp_shape_number<SphereLamp>;
    const double area =
        sphere ? 4 * std::numbers::pi * 0.01
               : length(cross(vec(lamp_column(FlatColumn::edge_1_x)), vec(lamp_column(FlatColumn::edge_2_x)))) *
                     (shape == lamp_shape_number<TriangleLamp> ? 0.5 : 1.0);
    const double sum = weight.g > 0 ? 15 : 100;  // of the lamp's radiance over the channels
    power[i] = area * sum;
    total += power[i];
    const double weighed = sphere ? 1 : area;
    EXPECT_NEAR((weight.r + weight.g + weight.b) * chosen[i], sum * weighed, 1e-5 * sum * weighed) << i;
  }
  for (std::size_t i = 0; i < n; ++i) EXPECT_NEAR(chosen[i], power[i] / total, 1e-6) << i;
}

TEST(Compile, TellsWhichLightIsLeftToChance) {
  Scene scene = lit_box();
  const std::string chance = "by chance alone";
  EXPECT_FALSE(mentions(compile(scene).compiled_in, chance));
  scene.render.light_sampling = LightSampling::none;
  EXPECT_TRUE(mentions(compile(scene).compiled_in, chance + ": light straight from lamps"));
  scene.render = {};
  scene.spheres = {{"ball", "glass", {0, 0, 0}, 0.2}};
  EXPECT_TRUE(mentions(compile(scene).compiled_in, "but for those over one sphere"));
  EXPECT_FALSE(mentions(compile(scene).compiled_in, "caustics on matt surfaces"));
  scene.render.light_paths = 0;
  EXPECT_TRUE(mentions(compile(scene).compiled_in, chance + ": caustics on matt surfaces"));
  scene.render.caustics = Caustics::off;
  EXPECT_FALSE(mentions(compile(scene).compiled_in, chance));
}

TEST(Compile, WarnsOfConstantRouletteWhereItsVarianceIsInfinite) {
  Scene scene = lit_box();
  scene.render.roulette = Roulette::constant;
  EXPECT_TRUE(compile(scene).warnings.empty());
  scene.materials[0].set(Matt::reflectance, {0.5, 0.87, 0.5});
  EXPECT_TRUE(mentions(compile(scene).warnings, "infinite variance"));
  scene.render.roulette = Roulette::throughput;
  EXPECT_TRUE(compile(scene).warnings.empty());
}

TEST(Compile, RefusesWhatCannotBeRendered) {
  Scene scene = lit_box();
  scene.spheres = {{"bad", "white", {0, 0, 0}, -1}};
  EXPECT_THROW(compile(scene), SceneError);
}

/// Of the scene's spheres: 0 where caustics are not connected over it, 1 by reflection, 2 by refraction too.
std::vector<int> connected_over(const Scene& scene) {
  const CompiledScene c = compile(scene);
  std::vector<int> kinds;
  for (const Sphere& s : scene.spheres) {
    int kind = 0;
    for (const ChainSphere& chain : c.chain_spheres) {
      const double off = length(s.center - dvec3{chain.center[0], chain.center[1], chain.center[2]} -
                                dvec3{c.origin[0], c.origin[1], c.origin[2]});
      if (off > 1e-6 || std::abs(s.radius - static_cast<double>(chain.radius)) > 1e-6) continue;
      kind = chain.refracts ? 2 : 1;
      EXPECT_EQ(std::bit_cast<std::int32_t>(c.surfaces[Column::chain][chain.surface]), kind);
    }
    kinds.push_back(kind);
  }
  return kinds;
}

TEST(Compile, ConnectsOverMirrorAndGlassSpheresInTheRoom) {
  Scene scene = lit_box();
  scene.materials.push_back(mirror("black", dvec3{0}));
  scene.spheres = {{"a", "mirror", {-0.5, -0.8, 0}, 0.2}, {"b", "glass", {0.5, -0.8, 0}, 0.2},
                   {"c", "white", {0, 0, -0.5}, 0.1},     {"d", "black", {0, 0.5, -0.5}, 0.1},
                   {"e", "glass", {0.9, 0.5, 0}, 0.2},    {"f", "mirror", {-0.9, 0.5, 0}, 0.2}};
  EXPECT_EQ(connected_over(scene), (std::vector{1, 2, 0, 0, 0, 0})) << "the last two reach through the walls";
  for (const auto& change : {+[](Settings& s) { s.sphere_connections = SphereConnections::off; },
                             +[](Settings& s) { s.caustics = Caustics::off; },
                             +[](Settings& s) { s.light_sampling = LightSampling::none; }}) {
    Scene other = scene;
    change(other.render);
    EXPECT_EQ(connected_over(other), std::vector<int>(6)) << "left to chance";
  }
  scene.polygons.pop_back();
  EXPECT_EQ(connected_over(scene), std::vector<int>(6)) << "no lamp";
}

// A ray inside the glass would meet what is there.
TEST(Compile, ConnectsByRefractionOnlyThroughEmptyGlass) {
  const Sphere ball{"ball", "glass", {0, 0, 0}, 0.5};
  Scene scene = lit_box();
  scene.spheres = {ball, {"beside", "glass", {0.8, 0, 0}, 0.1}, {"touching", "white", {0, 0.7, 0}, 0.2}};
  EXPECT_EQ(connected_over(scene), (std::vector{2, 2, 0}));
  scene.spheres = {ball, {"inside", "glass", {0.3, 0, 0}, 0.1}};
  EXPECT_EQ(connected_over(scene), (std::vector{1, 2}));
  scene.spheres = {ball, {"half inside", "white", {0.5, 0, 0}, 0.1}};
  EXPECT_EQ(connected_over(scene), (std::vector{1, 0}));
  scene.spheres = {ball};
  for (const bool inside : {false, true}) {
    Scene other = scene;
    const double x = inside ? 0.4 : 0.51;
    other.polygons.push_back({"slice", "white", {{x, -0.9, -0.9}, {x, 0.9, -0.9}, {x, 0.9, 0.9}, {x, -0.9, 0.9}}});
    EXPECT_EQ(connected_over(other), std::vector{inside ? 1 : 2});
    other = scene;
    other.meshes = {tetrahedron("block", "white", {inside ? 0.2 : 0.8, 0, 0}, 0.1)};
    EXPECT_EQ(connected_over(other), std::vector{inside ? 1 : 2});
  }
}

TEST(Compile, ConnectsOverNoMoreThanEightSpheresTheLargest) {
  Scene scene = lit_box();
  std::vector<int> expected;
  for (int i = 0; i < 10; ++i) {
    scene.spheres.push_back({"", "mirror", {-0.9 + 0.2 * i, 0, 0}, 0.05 + 0.004 * i});
    expected.push_back(i < 2 ? 0 : 1);
  }
  EXPECT_EQ(connected_over(scene), expected);
}

}  // namespace
