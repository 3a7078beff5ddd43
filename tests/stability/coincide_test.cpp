// Surfaces that coincide have one meaning, the same for every estimator, order and lane width: that of a small gap
// between them. An eye on a surface sees what it sees from just before it.
#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <functional>
#include <iostream>

#include "pictures.h"
#include "scene/file/scene_file.h"
#include "scene_parts.h"

using namespace glimt;

namespace {

constexpr double alpha = 1e-4;  ///< probability of a false alarm of each test
constexpr double gap = 2e-4;    ///< metres, in a room of 6 m: changes less than the noise

/// A closed white room with a camera at its front; lamps and things are to come.
Scene room(const std::string& walls = "white") {
  Scene scene;
  scene.materials = {lambertian("white", dvec3{0.7}),
                     lambertian("black", dvec3{0.05}),
                     lambertian("glow", dvec3{0.5}, dvec3{0.5}),
                     mirror("mirror", dvec3{0.9}),
                     glass("glass", 1.5),
                     glass("dense", 1.9),
                     light("lamp", dvec3{5}),
                     light("dim", dvec3{1})};
  scene.polygons = box(dvec3{-3}, dvec3{3}, walls);
  scene.camera = {{0, 0.5, 2.9}, {0, -0.5, 0}, {0, 1, 0}, 80};
  scene.image = {16, 16};
  return scene;
}

/// A horizontal square about (0, y, 0), front up.
Polygon square(const std::string& name, const std::string& material, double y, double half_width) {
  const double h = half_width;
  return {name, material, {{-h, y, h}, {h, y, h}, {h, y, -h}, {-h, y, -h}}};
}
Polygon flipped(Polygon p) {
  std::reverse(p.vertices.begin(), p.vertices.end());
  return p;
}

dvec3 tilt(const dvec3& v) {
  const dvec3 x = normalize(dvec3{1, 0.3, -0.2}), y = normalize(cross(dvec3{0.1, -0.3, 1}, x)), z = cross(x, y);
  return x * v.x + y * v.y + z * v.z + dvec3{0.1, -0.3, 0.2};
}
Scene tilted(Scene scene, std::size_t first_polygon) {
  for (std::size_t i = first_polygon; i < scene.polygons.size(); ++i)
    for (dvec3& v : scene.polygons[i].vertices) v = tilt(v);
  for (Mesh& m : scene.meshes)
    for (dvec3& v : m.vertices.edit()) v = tilt(v);
  return scene;
}

Mesh block(const std::string& name, const std::string& material, const dvec3& low, const dvec3& high) {
  Mesh mesh = box_mesh(low, high, material, false);
  mesh.name = name;
  return mesh;
}

/// Closed and not convex: a block with a step, fronts outwards. The profile in x and y is drawn along z.
Mesh stairs(const std::string& name, const std::string& material, const dvec3& at) {
  const std::vector<std::array<double, 2>> profile{{0, 0}, {1, 0}, {1, 0.5}, {0.5, 0.5}, {0.5, 1}, {0, 1}};
  Mesh mesh{name, material, {}, {}};
  for (const double z : {0.0, 1.0})
    for (const auto& [x, y] : profile) mesh.vertices.edit().push_back(at + dvec3{x, y, z});
  for (const auto& t : {std::array{0, 1, 2}, {0, 2, 3}, {0, 3, 4}, {0, 4, 5}}) {
    mesh.triangles.edit().push_back({t[0], t[2], t[1]});
    mesh.triangles.edit().push_back({t[0] + 6, t[1] + 6, t[2] + 6});
  }
  for (int i = 0; i < 6; ++i) {
    const int k = (i + 1) % 6;
    mesh.triangles.edit().push_back({i, k, k + 6});
    mesh.triangles.edit().push_back({i, k + 6, i + 6});
  }
  return mesh;
}

Scene with(Scene scene, const std::vector<Polygon>& polygons, const std::vector<Mesh>& meshes = {},
           const std::vector<Sphere>& spheres = {}) {
  scene.polygons.insert(scene.polygons.end(), polygons.begin(), polygons.end());
  scene.meshes = meshes;
  scene.spheres = spheres;
  return scene;
}

/// A lamp for scenes that have no other.
Sphere bulb() { return {"bulb", "lamp", {0, 2, 0}, 0.5}; }

struct Way {
  const char* name;
  LightSampling light_sampling;
  Mis mis;
  int samples;
};
constexpr std::array ways{
    Way{"auto", LightSampling::automatic, Mis::off, 16}, Way{"area and MIS", LightSampling::area, Mis::on, 16},
    Way{"solid angle", LightSampling::solid_angle, Mis::off, 16}, Way{"naive", LightSampling::none, Mis::off, 64}};

Series pictures(Scene scene, const Way& way, int block_size) {
  scene.render.light_sampling = way.light_sampling;
  scene.render.mis = way.mis;
  Series series;
  for (int seed = 1; seed <= 12; ++seed) {
    scene.render.seed = seed;
    // One thread is faster for so few pixels.
    series.blocks.push_back(
        block_means(render(compile(scene), way.samples * std::max(effort, 2) / 8, {.threads = 1}).mean(), block_size));
  }
  return series;
}

struct Case {
  const char* name;
  std::function<Scene(double gap)> scene;  ///< 0: the surfaces coincide
};

std::ostream& operator<<(std::ostream& out, const Case& c) { return out << c.name; }

Mesh doubled(Mesh mesh) {
  const std::vector<std::array<int, 3>> again = mesh.triangles;
  mesh.triangles.edit().insert(mesh.triangles.end(), again.begin(), again.end());
  return mesh;
}
/// An open mesh of a square, front up; `both`: with triangles the other way around, of the same vertices.
Mesh sheet(const std::string& material, double y, bool both) {
  Mesh mesh{"sheet", material, square("", "", y, 0.5).vertices, {{0, 1, 2}, {0, 2, 3}}};
  if (both) mesh.triangles.edit().insert(mesh.triangles.end(), {{0, 2, 1}, {0, 3, 2}});
  return mesh;
}

// With a gap, `g` is how far the surface that is to be in front stands before the other.
const std::vector<Case> cases{
    {"the same lamp twice",
     [](double g) {
       return g > 0 ? with(room(), {square("a", "lamp", 0, 0.5)})
                    : with(room(), {square("a", "lamp", 0, 0.5), square("b", "lamp", 0, 0.5)});
     }},
    {"the same lamp three times, begun at other corners",
     [](double g) {
       Polygon turned = square("b", "lamp", 0, 0.5);
       std::rotate(turned.vertices.begin(), turned.vertices.begin() + 1, turned.vertices.end());
       return g > 0 ? with(room(), {square("a", "lamp", 0, 0.5)})
                    : with(room(), {square("a", "lamp", 0, 0.5), turned, square("c", "lamp", 0, 0.5)});
     }},
    {"the same block that shines twice",
     [](double g) {
       const Mesh lamp = block("a", "lamp", {-0.5, -0.5, -0.5}, {0.5, 0.5, 0.5});
       return g > 0 ? with(room(), {}, {lamp}) : with(room(), {}, {lamp, block("b", "lamp", dvec3{-0.5}, dvec3{0.5})});
     }},
    {"the same ball that shines twice",
     [](double g) {
       return g > 0 ? with(room(), {}, {}, {bulb()}) : with(room(), {}, {}, {bulb(), {"b", "lamp", {0, 2, 0}, 0.5}});
     }},
    {"a ball that shines over a white one",
     [](double g) {
       return with(room(), {}, {}, {{"a", "lamp", {0, 1, 0}, 0.7 + g}, {"b", "white", {0, 1, 0}, 0.7}});
     }},
    {"a ball of glass over a white one",
     [](double g) {
       return with(room(), {square("l", "lamp", 2.5, 1)}, {},
                   {{"b", "white", {0, 1, 0}, 0.7}, {"a", "glass", {0, 1, 0}, 0.7 + g}});
     }},
    {"the triangles of a sheet that shines twice",
     [](double g) { return with(room(), {}, {g > 0 ? sheet("lamp", 0, false) : doubled(sheet("lamp", 0, false))}); }},
    {"two lamps back to back",
     [](double g) {
       return with(room(), {square("a", "lamp", g, 0.5), flipped(square("b", "lamp", 0, 0.5))});
     }},
    {"two lamps back to back, tilted",
     [](double g) {
       return tilted(with(room(), {square("a", "lamp", g, 0.5), flipped(square("b", "lamp", 0, 0.5))}), 6);
     }},
    {"a sheet that shines to both sides",
     [](double g) {
       return g > 0 ? with(room(), {flipped(square("b", "lamp", 0, 0.5)), square("a", "lamp", g, 0.5)})
                    : with(room(), {}, {sheet("lamp", 0, true)});
     }},
    {"a triangle and a square back to back",
     [](double g) {
       return with(room(), {square("a", "lamp", g, 0.5), {"b", "lamp", {{-1, 0, -1}, {1, 0, -1}, {0.3, 0, 0.8}}}});
     }},
    {"a lamp on a table",
     [](double g) {
       return with(room(), {square("a", "lamp", -1 + g, 0.5), square("b", "white", -1, 1)});
     }},
    {"a lamp on a table that faces down",
     [](double g) {
       return with(room(), {square("a", "lamp", -1 + g, 0.5), flipped(square("b", "white", -1, 1))});
     }},
    {"a lamp under a table",
     [](double g) {
       return with(room(), {square("b", "white", 1, 1), flipped(square("a", "lamp", 1 - g, 0.5))});
     }},
    {"a lamp of twelve corners on a tilted table",
     [](double g) {
       return tilted(with(room(), {disk("a", "lamp", {0, g, 0}, {0, 1, 0}, 0.6, 12), square("b", "white", 0, 1)}), 6);
     }},
    {"a lamp on a block",
     [](double g) {
       return with(room(), {square("a", "lamp", -1 + g, 0.5)}, {block("b", "white", {-1, -2, -1}, {1, -1, 1})});
     }},
    {"a lamp on a block of glass",
     [](double g) {
       return with(room(), {square("a", "lamp", -1 + g, 0.5)}, {block("b", "glass", {-1, -2, -1}, {1, -1, 1})});
     }},
    {"a lamp larger than the table it lies on",
     [](double g) {
       return with(room(), {square("b", "white", -1, 0.5), square("a", "lamp", -1 + g, 1)});
     }},
    {"a lamp before a mirror",
     [](double g) {
       return with(room(), {square("a", "lamp", -1 + g, 0.5), square("b", "mirror", -1, 1)});
     }},
    {"a mirror and a lamp back to back",
     [](double g) {
       return with(room(), {flipped(square("b", "mirror", 0, 1)), square("a", "lamp", g, 0.7)});
     }},
    {"a small lamp on a large one",
     [](double g) {
       return with(room(), {square("a", "lamp", -1 + g, 0.5), square("b", "dim", -1, 1)});
     }},
    {"a black square on a white one",
     [](double g) {
       return with(room(), {square("a", "black", -1 + g, 0.7), square("b", "white", -1, 1.5)}, {}, {bulb()});
     }},
    {"a lamp on a black square on a white one",
     [](double g) {
       return with(room(), {square("a", "black", -1 + g, 0.9), square("l", "lamp", -1 + 2 * g, 0.5),
                            square("b", "white", -1, 1.5)});
     }},
    {"a mirror on a block",
     [](double g) {
       return with(room(), {square("a", "mirror", -1 + g, 0.9)}, {block("b", "white", {-1, -2, -1}, {1, -1, 1})},
                   {bulb()});
     }},
    {"a block on a table that shines",
     [](double g) {
       return with(room(), {square("b", "lamp", -1, 1)}, {block("a", "white", {-0.5, -1 + g, -0.5}, {0.5, 0, 0.5})});
     }},
    {"a block of glass on a table that shines",
     [](double g) {
       return with(room(), {square("b", "lamp", -1, 1)}, {block("a", "glass", {-0.5, -1 + g, -0.5}, {0.5, 0, 0.5})});
     }},
    {"a block of glass on a table",
     [](double g) {
       return with(room(), {square("b", "white", -1, 1)}, {block("a", "glass", {-0.5, -1 + g, -0.5}, {0.5, 0, 0.5})},
                   {bulb()});
     }},
    {"stairs of glass on stairs",
     [](double g) {
       return with(room(), {}, {stairs("b", "white", {-0.5, -1, -0.5}), stairs("a", "glass", {-0.5, g, -0.5})},
                   {bulb()});
     }},
    {"a block of glass on the floor, which is a wall and hides the block's side",
     [](double g) {
       return with(room(), {}, {block("a", "glass", {-0.5, -3 - g, -0.5}, {0.5, -1, 0.5})}, {bulb()});
     }},
    {"stairs of glass on the floor, likewise",
     [](double g) {
       return with(room(), {}, {stairs("a", "glass", {-0.5, -3 - g, -0.5})}, {bulb()});
     }},
    {"a lamp flush with the glass that it is in",
     [](double g) {
       return with(
           room(), {},
           {block("b", "glass", dvec3{-1}, dvec3{1}), block("a", "lamp", {-0.4, 0.2, -0.4}, {0.4, 1 + g, 0.4})});
     }},
};

class Coincide : public testing::TestWithParam<Case> {};

TEST_P(Coincide, IsLikeAGap) {
  const Case& c = GetParam();
  const Estimate truth = pictures(c.scene(gap), {"", LightSampling::automatic, Mis::on, 32}, 16).overall();
  ASSERT_LT(truth.error, 0.04 * truth.mean) << "too much noise to tell";
  std::cout << "with a gap " << truth.mean << " +- " << truth.error << "\n";
  for (const bool reversed : {false, true}) {
    Scene scene = c.scene(0);
    if (reversed) {
      std::ranges::reverse(scene.polygons);
      std::ranges::reverse(scene.meshes);
      std::ranges::reverse(scene.spheres);
    }
    for (const Way& way : ways) {
      if (reversed && way.light_sampling != LightSampling::automatic) continue;
      const Estimate found = pictures(scene, way, 16).overall();
      std::cout << (reversed ? "reversed, " : "") << way.name << " " << found.mean << " +- " << found.error << "\n";
      EXPECT_GT(likelihood(found, truth), sidak(alpha, 5)) << way.name << (reversed ? ", in reversed order" : "");
    }
  }
}

TEST_P(Coincide, OneLaneAndManyGiveTheSameBits) {
  const CompiledScene scene = compile(GetParam().scene(0));
  const auto one = trace_all(scene, 2, Lanes::scalar), many = trace_all(scene, 2, Lanes::native);
  const std::ptrdiff_t at = first_difference(one, many);
  EXPECT_LT(at, 0) << replay(scene, at);
}

std::string title(const std::string& name) {
  std::string result;
  bool upper = true;
  for (const char c : name) {
    if (std::isalnum(static_cast<unsigned char>(c)) != 0)
      result += upper ? static_cast<char>(std::toupper(static_cast<unsigned char>(c))) : c;
    upper = std::isalnum(static_cast<unsigned char>(c)) == 0;
  }
  return result;
}

INSTANTIATE_TEST_SUITE_P(, Coincide, testing::ValuesIn(cases), [](const auto& c) { return title(c.param.name); });

// All that reflects half and glows with 0.5 in a closed room: 0.5 (1 + 1/2 + 1/4 + ...) = 1 in every pixel, and glass,
// which takes nothing away, cannot be seen.
struct GlassCase {
  const char* name;
  std::vector<Mesh> meshes;
  std::vector<Polygon> polygons = {};
};

std::ostream& operator<<(std::ostream& out, const GlassCase& c) { return out << c.name; }

/// Two blocks side by side in one mesh, with corners of their own.
Mesh twin_blocks() {
  Mesh both = block("a", "glass", {-1, -0.5, -0.5}, {0, 0.5, 0.5});
  const Mesh other = block("b", "glass", {0, -0.5, -0.5}, {1, 0.5, 0.5});
  const int offset = static_cast<int>(both.vertices.size());
  both.vertices.edit().insert(both.vertices.end(), other.vertices.begin(), other.vertices.end());
  for (const auto& t : other.triangles) both.triangles.edit().push_back({t[0] + offset, t[1] + offset, t[2] + offset});
  return both;
}

Mesh tilted(Mesh mesh) {
  for (dvec3& v : mesh.vertices.edit()) v = tilt(v);
  return mesh;
}

const std::vector<GlassCase> glass_cases{
    {"two blocks share a side",
     {block("a", "glass", {-1, -0.5, -0.5}, {0, 0.5, 0.5}), block("b", "glass", {0, -0.5, -0.5}, {1, 0.5, 0.5})}},
    {"two blocks of other glass share a side",
     {block("a", "glass", {-1, -0.5, -0.5}, {0, 0.5, 0.5}), block("b", "dense", {0, -0.5, -0.5}, {1, 0.5, 0.5})}},
    {"two tilted blocks share a part of a side",
     {tilted(block("a", "glass", {-1, -0.5, -0.5}, {0, 0.5, 0.5})),
      tilted(block("b", "glass", {0, -0.2, -0.9}, {1, 0.9, 0.3}))}},
    {"three blocks in a row",
     {block("a", "glass", {-1.5, -0.5, -0.5}, {-0.5, 0.5, 0.5}),
      block("b", "dense", {-0.5, -0.5, -0.5}, {0.5, 0.5, 0.5}),
      block("c", "glass", {0.5, -0.5, -0.5}, {1.5, 0.5, 0.5})}},
    {"four blocks around an edge",
     {block("a", "glass", {-1, -1, -0.5}, {0, 0, 0.5}), block("b", "dense", {0, -1, -0.5}, {1, 0, 0.5}),
      block("c", "glass", {0, 0, -0.5}, {1, 1, 0.5}), block("d", "dense", {-1, 0, -0.5}, {0, 1, 0.5})}},
    {"a block on stairs",
     {stairs("a", "glass", {-0.5, -0.5, -0.5}), block("b", "dense", {0, 0, -0.5}, {0.5, 0.5, 0.5})}},
    {"a block in a block, flush with one side",
     {block("a", "glass", dvec3{-1}, dvec3{1}), block("b", "dense", {-0.5, -0.5, 0}, {0.5, 0.5, 1})}},
    {"a block in a block, flush with three sides",
     {block("b", "dense", {0, 0, 0}, dvec3{1}), block("a", "glass", dvec3{-1}, dvec3{1})}},
    {"two blocks of one mesh", {twin_blocks()}},
    {"a block on a table", {block("a", "glass", {-0.5, -1, -0.5}, {0.5, 0, 0.5})}, {square("t", "glow", -1, 1)}},
    {"stairs on a table that faces down",
     {stairs("a", "glass", {-0.5, -1, -0.5})},
     {flipped(square("t", "glow", -1, 1))}},
    {"a block between two tables",
     {block("a", "glass", {-0.5, -1, -0.5}, {0.5, 0, 0.5})},
     {square("t", "glow", -1, 1), square("u", "glow", 0, 1)}},
};

class GlassFurnace : public testing::TestWithParam<GlassCase> {};

TEST_P(GlassFurnace, IsOneEverywhere) {
  Scene scene = room("glow");
  scene.polygons.insert(scene.polygons.end(), GetParam().polygons.begin(), GetParam().polygons.end());
  scene.meshes = GetParam().meshes;
  const Series series = pictures(scene, {"", LightSampling::automatic, Mis::off, 32}, 4);
  const Estimate all = series.overall();
  std::cout << all.mean << " +- " << all.error << "\n";
  EXPECT_GT(likelihood(all, 1), alpha);
  const double each = sidak(alpha, static_cast<double>(series.size()) / 3);
  for (std::size_t i = 0; i < series.size(); i += 3)
    EXPECT_GT(likelihood(series.block(i), 1), each) << "block " << i / 3 << ": " << series.block(i).mean;
}

INSTANTIATE_TEST_SUITE_P(, GlassFurnace, testing::ValuesIn(glass_cases),
                         [](const auto& c) { return title(c.param.name); });

// Eyes on surfaces.

struct EyeCase {
  const char* name;
  dvec3 eye, look_at;
  dvec3 off;  ///< to the side that the eye looks to
};

std::ostream& operator<<(std::ostream& out, const EyeCase& c) { return out << c.name; }

/// A room with a table, a block and balls.
Scene furnished() {
  return with(room(), {square("t", "white", -1, 1)},
              {block("b", "white", {-1, -1, -1}, {-0.2, 0, -0.2}), block("g", "glass", {0.3, -1, -1}, {1, 0, -0.2})},
              {bulb(), {"w", "white", {-1, -2, 0}, 0.8}, {"m", "mirror", {1, -2.2, 1}, 0.6}});
}

const std::vector<EyeCase> eyes{{"on a wall", {0, 0, 3}, {0, 0, 0}, {0, 0, -1}},
                                {"on a wall, looking along it", {-2.9, 0, 3}, {2, 0, 3}, {0, 0, -1}},
                                {"in an edge of the room", {-3, 0.2, 3}, {0, -0.5, 0}, {1, 0, -1}},
                                {"in a corner of the room", {-3, 3, 3}, {0, -1, 0}, {1, -1, -1}},
                                {"on a table, looking up", {0.2, -1, 0.7}, {0.1, 3, 0.2}, {0, 1, 0}},
                                {"on a table, looking down", {0.2, -1, 0.7}, {0.1, -3, 0.2}, {0, -1, 0}},
                                {"on a block", {-0.5, -0.5, -0.2}, {0.2, -0.3, 3}, {0, 0, 1}},
                                {"on glass, looking out", {0.6, -0.5, -0.2}, {0.2, -0.3, 3}, {0, 0, 1}},
                                {"on glass, looking in", {0.6, -0.5, -0.2}, {0.6, -0.6, -3}, {0, 0, -1}},
                                {"on a ball", {-1, -1.2, 0}, {0, 2, 0.2}, {0, 1, 0}},
                                {"on a mirror", {1, -2.2, 0.4}, {0, -2, -3}, {0, 0, -1}},
                                {"on the table and the block on it", {-0.4, -1, -0.2}, {0, 2, 3}, {0, 1, 1}}};

class EyeOn : public testing::TestWithParam<EyeCase> {};

TEST_P(EyeOn, SeesWhatItSeesFromBefore) {
  const EyeCase& c = GetParam();
  Scene scene = furnished();
  scene.camera.eye = c.eye + c.off * gap;
  scene.camera.look_at = c.look_at + c.off * gap;
  EXPECT_TRUE(compile(scene).warnings.empty());
  const Estimate truth = pictures(scene, {"", LightSampling::automatic, Mis::off, 32}, 16).overall();
  scene.camera.eye = c.eye;
  scene.camera.look_at = c.look_at;
  ASSERT_EQ(compile(scene).warnings.size(), 1u);
  EXPECT_NE(compile(scene).warnings[0].find("moved off it"), std::string::npos);
  for (const Way& way : ways) {
    const Estimate found = pictures(scene, way, 16).overall();
    std::cout << way.name << " " << found.mean << " +- " << found.error << ", before it " << truth.mean << "\n";
    EXPECT_GT(likelihood(found, truth), sidak(alpha, 4)) << way.name;
  }
}

INSTANTIATE_TEST_SUITE_P(, EyeOn, testing::ValuesIn(eyes), [](const auto& c) { return title(c.param.name); });

// Scenes whose right mean is known to all its digits; see the files.

struct File {
  const char* name;
  double mean, half_digit;
};

std::ostream& operator<<(std::ostream& out, const File& f) { return out << f.name; }

class CoincideFile : public testing::TestWithParam<File> {};

TEST_P(CoincideFile, HasTheRightMean) {
  const auto& [name, mean, half_digit] = GetParam();
  Scene scene = read_scene(std::string(GLIMT_TESTS_DIR "/data/coincide/") + name + ".toml");
  scene.image = {32, 32};
  for (const Way& way : ways) {
    const Estimate found = pictures(scene, way, 32).overall();
    std::cout << way.name << " " << found.mean << " +- " << found.error << "\n";
    const double nearest = std::clamp(found.mean, mean - half_digit, mean + half_digit);
    EXPECT_GT(likelihood(found, nearest), sidak(alpha, 4)) << way.name;
    EXPECT_LT(found.error, 0.03 * mean) << "too much noise to tell";
  }
}

INSTANTIATE_TEST_SUITE_P(, CoincideFile,
                         testing::Values(File{"dup_quad_lamp", 0.0525, 5e-5}, File{"back_to_back", 0.1049, 5e-5},
                                         File{"quad_lamp_on_quad", 0.1304, 5e-5}, File{"eye_on_wall", 0.3273, 5e-5},
                                         File{"glass_cubes_touch", 1, 0}, File{"glass_cube_split_vertices", 1, 0}),
                         [](const auto& f) { return std::string(f.param.name); });

// Geometry that is mended: the picture is that of the scene as it should have been.

struct MendedCase {
  const char* name;
  Scene mended, sound;
};

/// Every triangle has corners of its own.
Mesh exploded(const Mesh& mesh) {
  Mesh apart{mesh.name, mesh.material, {}, {}};
  for (const auto& t : mesh.triangles) {
    const int first = static_cast<int>(apart.vertices.size());
    for (const int i : t) apart.vertices.edit().push_back(mesh.vertices[static_cast<std::size_t>(i)]);
    apart.triangles.edit().push_back({first, first + 1, first + 2});
  }
  return apart;
}

/// With a corner in the middle of an edge for one of the two triangles there, and a triangle of no area between them.
Mesh needled(Mesh mesh) {
  const auto [a, b, c] = mesh.triangles[0];
  const auto at = [&](int i) { return mesh.vertices[static_cast<std::size_t>(i)]; };
  const int middle = static_cast<int>(mesh.vertices.size());
  mesh.vertices.edit().push_back((at(a) + at(b)) / 2.0);
  mesh.triangles.edit()[0] = {a, middle, c};
  mesh.triangles.edit().push_back({middle, b, c});
  mesh.triangles.edit().push_back({a, b, middle});
  return mesh;
}

std::vector<MendedCase> mended_cases() {
  const Mesh step = stairs("s", "glass", {-0.5, -1, -0.5}), cube = block("b", "dense", {-0.5, -1, -0.5}, {0.5, 0, 0.5});
  const std::vector<dvec3> l{{-1, 1, 1}, {1, 1, 1}, {1, 1, 0}, {0, 1, 0}, {0, 1, -1}, {-1, 1, -1}};
  const std::vector<dvec3> long_part{{-1, 1, 1}, {1, 1, 1}, {1, 1, 0}, {-1, 1, 0}},
      short_part{{-1, 1, 0}, {0, 1, 0}, {0, 1, -1}, {-1, 1, -1}};
  std::vector<dvec3> bent = square("", "", 1, 1).vertices, spiked = l;
  bent[2].y += 1e-4;
  spiked.insert(spiked.begin() + 2, {{3, 1, 1}, {1, 1, 1}});
  std::vector<MendedCase> all;
  for (const std::string material : {"lamp", "white", "mirror"}) {
    const std::vector<Sphere> light{material == "lamp" ? Sphere{"w", "white", {0, -1, 0}, 1} : bulb()};
    const auto scene = [&](const std::vector<std::vector<dvec3>>& outlines) {
      std::vector<Polygon> polygons;
      for (const auto& v : outlines) polygons.push_back({"", material, v});
      return with(room(), polygons, {}, light);
    };
    all.push_back({"an L", scene({l}), scene({long_part, short_part})});
    all.push_back({"an L with a spike", scene({spiked}), scene({long_part, short_part})});
    all.push_back({"a square with a corner off its plane", scene({bent}), scene({square("", "", 1, 1).vertices})});
  }
  for (const Mesh& mesh : {step, cube}) {
    all.push_back({"glass with corners for each triangle", with(room(), {}, {exploded(mesh)}, {bulb()}),
                   with(room(), {}, {mesh}, {bulb()})});
    all.push_back({"glass with a triangle of no area", with(room(), {}, {needled(mesh)}, {bulb()}),
                   with(room(), {}, {mesh}, {bulb()})});
  }
  return all;
}

TEST(MendedGeometry, LooksLikeTheGeometryItShouldHaveBeen) {
  const std::vector<MendedCase> all = mended_cases();
  for (const MendedCase& c : all) {
    SCOPED_TRACE(c.name);
    EXPECT_FALSE(compile(c.mended).warnings.empty());
    EXPECT_TRUE(compile(c.sound).warnings.empty());
    const Estimate truth = pictures(c.sound, ways[0], 16).overall();
    for (const Way& way : {ways[0], ways[3]}) {
      const Estimate found = pictures(c.mended, way, 16).overall();
      std::cout << c.name << ", " << way.name << " " << found.mean << " +- " << found.error << ", " << truth.mean
                << "\n";
      EXPECT_GT(likelihood(found, truth), sidak(alpha, 2 * static_cast<double>(all.size()))) << way.name;
      EXPECT_LT(found.error, 0.04 * truth.mean) << "too much noise to tell";
    }
  }
}

// What is told, and what stays as it is.

TEST(CoincideWords, SaysWhatIsLeftOutAndWhatIsMovedApart) {
  const CompiledScene twice = compile(cases[0].scene(0));
  ASSERT_EQ(twice.warnings.size(), 1u);
  EXPECT_EQ(twice.warnings[0], "1 object is there twice and left out once; the first: \"b\", the same as \"a\"");
  const CompiledScene on_table = compile(with(room(), {square("a", "lamp", -1, 0.5), square("b", "white", -1, 1)}));
  EXPECT_TRUE(on_table.warnings.empty());
  EXPECT_TRUE(std::ranges::any_of(on_table.compiled_in, [](const std::string& what) {
    return what.find("that coincide") != std::string::npos && what.ends_with("\"a\" and \"b\"");
  }));
}

// Rays then pass from glass to glass and from glass to air, as they do where the inner one is not flush.
TEST(CoincideWords, GlassInGlassStaysInside) {
  const Mesh outer = block("a", "glass", dvec3{-1}, dvec3{1});
  const Mesh inner = block("b", "dense", {-0.5, -0.5, 0}, {0.5, 0.5, 1});
  for (const std::vector<Mesh>& meshes : {std::vector{outer, inner}, {inner, outer}}) {
    const CompiledScene scene = compile(with(room(), {}, meshes));
    std::vector<float> front;  // of the planes at z = 1, in order
    for (const SolidPlane& plane : scene.solid_planes)
      if (plane.nz > 0.9f) front.push_back(plane.d);
    ASSERT_EQ(front.size(), 2u);
    if (meshes[0].name == "b") std::swap(front[0], front[1]);
    EXPECT_LT(front[1], front[0]);
  }
}

// On a ground of 20 km a block of 1 m stands as it does on one of 20 m: not in the air.
TEST(CoincideWords, AWideGroundDoesNotLiftWhatStandsOnIt) {
  for (const double ground : {20.0, 20e3}) {
    Scene scene =
        with(room(), {}, {block("b", "white", {-0.5, 0, -0.5}, {0.5, 1, 0.5})}, {{"l", "lamp", {0, 3, 0}, 0.5}});
    scene.polygons = {square("ground", "white", 0, ground / 2)};
    const CompiledScene compiled = compile(scene);
    double height = 1;  // of the block's side that faces down over the ground
    for (const SolidPlane& plane : compiled.solid_planes)
      if (plane.ny < -0.9f) height = -static_cast<double>(plane.d) - static_cast<double>(compiled.polygons[0].d);
    EXPECT_GT(height, 0);
    EXPECT_LT(height, 3e-5) << ground;
  }
}

// Tiles side by side, surfaces that cross, and a lamp a millimetre above a table do not coincide.
TEST(CoincideWords, NothingIsMovedThatOnlyTouches) {
  std::vector<Polygon> tiles;
  for (int i = -4; i < 4; ++i)
    for (int k = -4; k < 4; ++k)
      tiles.push_back({"", "white", {{i, -1, k + 1}, {i + 1, -1, k + 1}, {i + 1, -1, k}, {i, -1, k}}});
  tiles.push_back(square("above", "lamp", -0.999, 0.5));
  tiles.push_back({"across", "white", {{-1, -2, 0.3}, {1, -2, 0.3}, {1, 1, 0.3}, {-1, 1, 0.3}}});
  for (Polygon& p : tiles)
    for (dvec3& v : p.vertices) v *= 0.5;
  const CompiledScene scene = compile(with(room(), tiles, {tetrahedron("t", "white", {0.4, 1, 0}, 0.5)}, {bulb()}));
  for (const std::string& what : scene.compiled_in) EXPECT_EQ(what.find("coincide"), std::string::npos) << what;
}

}  // namespace
