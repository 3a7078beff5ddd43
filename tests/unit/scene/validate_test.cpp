#include "scene/validate/validate.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "material/list.h"
#include "scene/fields.h"
#include "scene/geometry/mesh_measures.h"
#include "unit/kernel/test_scenes.h"

namespace glimt {
namespace {

// Fields and names.

TEST(Validate, ASceneNeedsAnObject) { EXPECT_EQ(paths(scene_of({})), Paths{""}); }

TEST(Validate, NamesEveryProblem) {
  Scene scene = scene_of({{"ball", "white"}, {"", "wood", {0, 0, 0}, -1}});
  scene.camera.fov_y = 0;
  scene.image.width = 0;
  scene.render.spp = 0;
  scene.materials[0].set(Matt::reflectance, {0.5, 2, 0.5});
  scene.materials[0].name = "off white";
  scene.spheres[0].material = "off white";
  EXPECT_EQ(paths(scene), (Paths{"camera.fov_y", "image.width", "render.spp", "material.\"off white\".reflectance",
                                 "sphere[1].material", "sphere[1].radius"}));
}

// A sphere seen from the distance of 4 radii: squares of squares of its lengths must fit into a float.
TEST(Validate, LengthsMustNotVanish) {
  const auto scene_of_size = [](double radius) {
    Scene scene = scene_of({{"ball", "white", {0, 0, 0}, radius}});
    scene.camera.eye = {0, 0, 4 * radius};
    return scene;
  };
  EXPECT_EQ(paths(scene_of_size(1e-9)), Paths{});
  EXPECT_EQ(paths(scene_of_size(1e-10)), Paths{""});
  EXPECT_EQ(paths(scene_of_size(1e-25)), Paths{""});
}

template <class T>
void expect_bounds_hold(std::span<const Field<T>> fields, Scene scene, T& (*select)(Scene&)) {
  const double outside[] = {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity(),
                            -std::numeric_limits<double>::infinity()};
  for (const Field<T>& field : fields) {
    SCOPED_TRACE(field.key);
    T& object = select(scene);
    const T before = object;
    const auto refused = [&] {
      const auto problems = validate(scene);
      object = before;
      return problems.size() == 1 && problems[0].path.ends_with(field.key);
    };
    if (const auto* integer = std::get_if<Value<T, int>>(&field.member)) {
      integer->set(object, static_cast<int>(field.min) - 1);
      EXPECT_TRUE(refused());
      if (field.max < std::numeric_limits<int>::max()) {
        integer->set(object, static_cast<int>(field.max) + 1);
        EXPECT_TRUE(refused());
      }
    }
    for (const double value :
         {outside[0], outside[1], outside[2], std::nextafter(field.min, -1e300), std::nextafter(field.max, 1e300)}) {
      if (const auto* number = std::get_if<Value<T, double>>(&field.member)) {
        number->set(object, value);
        EXPECT_TRUE(refused()) << value;
      }
      for (int i = 0; i < 3; ++i)
        if (const auto* vector = std::get_if<Value<T, dvec3>>(&field.member)) {
          dvec3 v = vector->get(object);
          v[i] = value;
          vector->set(object, v);
          EXPECT_TRUE(refused()) << value << " in " << i;
        }
    }
  }
}

TEST(Validate, EveryFieldKeepsItsRange) {
  const Scene scene = scene_of({{"ball", "white"}});
  expect_bounds_hold<Settings>(settings_fields(), scene, [](Scene& s) -> Settings& { return s.render; });
  expect_bounds_hold<Camera>(camera_fields(), scene, [](Scene& s) -> Camera& { return s.camera; });
  expect_bounds_hold<ImageSize>(image_fields(), scene, [](Scene& s) -> ImageSize& { return s.image; });
  expect_bounds_hold<Sphere>(sphere_fields(), scene, [](Scene& s) -> Sphere& { return s.spheres[0]; });
  for (const MaterialInfo& info : material_infos()) {
    Scene typed = scene;
    typed.materials.push_back({.name = "other", .type = std::string(info.name)});
    expect_bounds_hold<Material>(info.fields, typed, [](Scene& s) -> Material& { return s.materials[2]; });
  }
}

TEST(Validate, ParametersThatTheTypeDoesNotReadMayBeAnything) {
  Scene scene = scene_of({{"ball", "white"}});
  scene.materials[0].set(Glass::ior, -1);
  EXPECT_EQ(paths(scene), Paths{});
}

TEST(Validate, TypesAreThoseThatThereAre) {
  Scene scene = scene_of({{"ball", "white"}});
  scene.materials[0].type = "wood";
  EXPECT_EQ(paths(scene), Paths{"material.white.type"});
}

TEST(Validate, NamesOfOneKindDiffer) {
  Scene scene = scene_of({{"a", "white"}, {"", "white"}, {"", "white"}, {"b", "white"}, {"a", "white"}},
                         {{"a", "white", {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}}});
  EXPECT_EQ(paths(scene), Paths{"sphere[4].name"});
  scene.spheres.pop_back();
  scene.materials.push_back({.name = "white"});
  scene.materials.push_back({.name = ""});
  EXPECT_EQ(paths(scene), (Paths{"material.white", "material.\"\""}));
}

TEST(Validate, ImagesHaveAtMost67MillionPixels) {
  Scene scene = scene_of({{"ball", "white"}});
  scene.image = {8192, 8192};
  EXPECT_EQ(paths(scene), Paths{});
  scene.image = {8192, 8193};
  EXPECT_EQ(paths(scene), Paths{"image.height"});
}

TEST(Validate, CameraHasADirectionAndAnUp) {
  Scene scene = scene_of({{"ball", "white"}});
  scene.camera = {{3, 4, 5}, {3, 4, 5}};
  EXPECT_EQ(paths(scene), Paths{"camera.look_at"});
  scene.camera = {{0, 5, 0}, {0, 0, 0}};
  EXPECT_EQ(paths(scene), Paths{"camera.up"});
  scene.camera = {{0, 5, 0}, {0, 0, 0}, {0, 0, -1e-9}};
  EXPECT_EQ(paths(scene), Paths{});
}

// Polygons.

Paths polygon_paths(std::vector<dvec3> vertices) { return paths(scene_of({}, {{"", "white", std::move(vertices)}})); }

std::vector<dvec3> regular(int corners, int step) {
  std::vector<dvec3> vertices;
  for (int i = 0; i < corners; ++i) {
    const double angle = 2 * std::numbers::pi * i * step / corners;
    vertices.push_back({std::cos(angle), 1, std::sin(angle)});
  }
  return vertices;
}

TEST(ValidatePolygon, ConvexOnesAreAllowedInBothWindings) {
  for (int corners = 3; corners < 40; ++corners) {
    EXPECT_EQ(polygon_paths(regular(corners, 1)), Paths{}) << corners;
    EXPECT_EQ(polygon_paths(regular(corners, corners - 1)), Paths{}) << corners;
  }
}

TEST(ValidatePolygon, ThreeCornersOnALineAreAllowed) {
  EXPECT_EQ(polygon_paths({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {2, 1, 0}, {0, 1, 0}}), Paths{});
}

TEST(ValidatePolygon, StarsAreRefused) {
  // Every corner of a pentagram turns the same way, twice around in all.
  EXPECT_EQ(polygon_paths(regular(5, 2)), Paths{"polygon[0].vertices"});
  EXPECT_EQ(polygon_paths(regular(7, 3)), Paths{"polygon[0].vertices"});
}

TEST(ValidatePolygon, PlanarToAHundredthOfTheSize) {
  for (const double size : {1e-3, 1.0, 1e6}) {
    // A square with one corner lifted by h has each corner about h / 4 off the mean plane; the diagonal is its size.
    const auto lifted = [&](double h) {
      return std::vector<dvec3>{{0, 0, 0}, {size, 0, 0}, {size, h, size}, {0, 0, size}};
    };
    EXPECT_EQ(polygon_paths(lifted(4 * 0.013 * size)), Paths{}) << size;
    EXPECT_EQ(polygon_paths(lifted(4 * 0.015 * size)).size(), 1u) << size;
  }
}

TEST(ValidatePolygon, DegenerateAtEverySize) {
  for (const double size : {1e-6, 1.0, 1e6}) {
    EXPECT_EQ(polygon_paths({{0, 0, 0}, {size, 0, 0}, {2 * size, 0, 0}}), Paths{"polygon[0].vertices"});
    EXPECT_EQ(polygon_paths({{0, 0, 0}, {size, 0, 0}, {0, 1e-3 * size, 0}}), Paths{});
  }
}

// Meshes.

TEST(ValidateMesh, ClosedMeshes) {
  Mesh mesh = cube({}, 1);
  EXPECT_TRUE(is_closed(mesh));
  EXPECT_TRUE(is_closed(flipped(mesh)));
  EXPECT_TRUE(is_closed(ball(10, 20)));
  std::swap(mesh.triangles.edit()[3][0], mesh.triangles.edit()[3][1]);
  EXPECT_FALSE(is_closed(mesh)) << "one triangle is turned over";
  mesh = cube({}, 1);
  mesh.triangles.edit().pop_back();
  EXPECT_FALSE(is_closed(mesh)) << "one is missing";
  mesh = cube({}, 1);
  mesh.triangles.edit().push_back(mesh.triangles[0]);
  EXPECT_FALSE(is_closed(mesh)) << "one is there twice";
  EXPECT_FALSE(is_closed(Mesh{}));
}

TEST(ValidateMesh, IndicesAndTriangles) {
  Mesh mesh = cube({}, 1);
  mesh.material = "white";
  mesh.triangles.edit()[2][1] = 8;
  mesh.triangles.edit()[4][0] = -1;
  EXPECT_EQ(paths(scene_of({}, {}, {mesh})), (Paths{"mesh[0].triangles[2]", "mesh[0].triangles[4]"}));
  mesh.vertices.edit()[7].z = std::numeric_limits<double>::infinity();
  mesh.triangles = cube({}, 1).triangles;
  EXPECT_EQ(paths(scene_of({}, {}, {mesh})), Paths{"mesh[0].vertices[7]"});
  mesh.vertices.edit()[7].z = 1;
  mesh.triangles = {{0, 1, 1}, {2, 2, 3}};
  EXPECT_EQ(paths(scene_of({}, {}, {mesh})), Paths{"mesh[0].triangles"}) << "none has an area";
}

TEST(ValidateMesh, OpenMeshesAreAllowedUnlessOfGlass) {
  Mesh mesh = cube({}, 1);
  mesh.triangles.edit().pop_back();
  EXPECT_EQ(paths(scene_of({}, {}, {mesh})), Paths{"mesh[0].material"});
  mesh.material = "white";
  EXPECT_EQ(paths(scene_of({}, {}, {mesh})), Paths{});
}

}  // namespace
}  // namespace glimt
