#include "mesh/mesh_file.h"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <glm/geometric.hpp>
#include <map>
#include <random>
#include <set>

#include "app/own_folder.h"
#include "mesh/place_mesh.h"
#include "mesh/triangulate.h"
#include "unit/mesh/mesh_bytes.h"

namespace glimt {
namespace {

using namespace testing;
using glm::dvec3;
using Corners = std::array<int, 3>;

MeshData obj(const std::string& text) { return read_obj(text, "a.obj"); }
MeshData ply(const std::string& text) { return read_ply(text, "a.ply"); }
MeshData gltf(const std::string& bytes) { return read_gltf(bytes, "a.glb"); }

template <class Read>
std::string message_of(Read read) {
  try {
    read();
  } catch (const MeshFileError& error) {
    return error.what();
  }
  return "accepted";
}

dvec3 corner(const MeshData& mesh, std::size_t triangle, std::size_t k) {
  return mesh.vertices[static_cast<std::size_t>(mesh.triangles[triangle][k])];
}

/// A sixth of the sum of determinants: what a closed mesh that faces outwards holds.
double volume(const std::vector<dvec3>& vertices, const std::vector<Corners>& triangles) {
  double six = 0;
  for (const auto& [a, b, c] : triangles)
    six += dot(vertices[std::size_t(a)], cross(vertices[std::size_t(b)], vertices[std::size_t(c)]));
  return six / 6;
}

// What the three formats say.

TEST(MeshFile, ObjHoldsVerticesNormalsAndMaterials) {
  const MeshData mesh = obj(obj_tetrahedron);
  EXPECT_EQ(mesh.vertices, (std::vector<dvec3>{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}));
  EXPECT_EQ(mesh.triangles, (std::vector<Corners>{{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}}));
  ASSERT_EQ(mesh.normals.size(), 4u);
  EXPECT_NEAR(length(mesh.normals[3]), 1, 1e-15);
  EXPECT_EQ(mesh.normal_corners[1], (Corners{1, 1, 1}));
  ASSERT_EQ(mesh.groups.size(), 2u);
  EXPECT_EQ(mesh.groups[0].material, "steel");
  EXPECT_EQ(mesh.groups[1].material, "wood");
  EXPECT_EQ(mesh.groups[1].first, 2);
  EXPECT_EQ(mesh.groups[1].count, 2);
  EXPECT_TRUE(mesh.told.empty());
  EXPECT_DOUBLE_EQ(volume(mesh.vertices, mesh.triangles), 1.0 / 6);
}

TEST(MeshFile, ObjCountsBackwardsAndReadsAnyLineEnds) {
  const MeshData plain = obj("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  EXPECT_EQ(obj("v 0 0 0\nv 1 0 0\nv 0 1 0\nf -3 -2 -1").hash, plain.hash);
  EXPECT_EQ(obj("v 0 0 0\r\nv 1 0 0\r\nv 0 1 0\r\nf 1/1 2/1 3/1\r\n").hash, plain.hash);
  EXPECT_EQ(obj("v 0 0 0\rv 1 0 0\rv 0 1 0\rf 1 2 3\r").hash, plain.hash);
  EXPECT_EQ(obj("  v\t0 0e3 .0 1.0\nv 1 0 0\n\n# v 3\nv 0 +1 0\nvt 0 0\nl 1 2\nf 1/1 2/1 3/1 \n").hash, plain.hash);
}

TEST(MeshFile, MaterialsThatComeAgainAreOneGroup) {
  const MeshData mesh =
      obj("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\nusemtl a\nf 2 3 1\nusemtl b\nf 3 1 2\nusemtl a\nf 1 3 2\n");
  ASSERT_EQ(mesh.groups.size(), 3u);
  EXPECT_EQ(mesh.groups[1].material, "a");
  EXPECT_EQ(mesh.groups[1].count, 2);
  EXPECT_EQ(mesh.triangles, (std::vector<Corners>{{0, 1, 2}, {1, 2, 0}, {0, 2, 1}, {2, 0, 1}}));
}

TEST(MeshFile, PlyIsTheSameInTextAndBytes) {
  const MeshData text = ply(ply_tetrahedron);
  EXPECT_EQ(text.triangles, obj(obj_tetrahedron).triangles);
  EXPECT_TRUE(text.normals.empty());
  for (const bool big_endian : {false, true}) {
    const MeshData bytes = ply(binary_ply_tetrahedron(big_endian));
    EXPECT_EQ(bytes.vertices, text.vertices);
    EXPECT_EQ(bytes.triangles, text.triangles);
    EXPECT_EQ(bytes.normals, std::vector<dvec3>(4, dvec3{0, 1, 0}));
  }
}

TEST(MeshFile, GltfNodesPlaceTheirMeshes) {
  const MeshData mesh = gltf(glb_triangle());
  EXPECT_EQ(mesh.vertices, (std::vector<dvec3>{{10, 0, 0}, {12, 0, 0}, {10, 2, 2}}));
  EXPECT_EQ(mesh.triangles, (std::vector<Corners>{{0, 1, 2}}));
  ASSERT_EQ(mesh.groups.size(), 1u);
  EXPECT_EQ(mesh.groups[0].material, "red");
}

TEST(MeshFile, GltfMirrorsKeepFrontsAndStripsAlternate) {
  nlohmann::json json = gltf_triangle();
  json["nodes"][1]["scale"] = {-2, 2, 2};
  const MeshData mirrored = gltf(glb(json.dump(), gltf_triangle_buffer()));
  EXPECT_EQ(mirrored.triangles, (std::vector<Corners>{{0, 2, 1}}));
  json = gltf_triangle();
  json["accessors"][1]["count"] = 4;
  json["bufferViews"][1]["byteLength"] = 8;
  json["meshes"][0]["primitives"][0]["mode"] = 5;
  EXPECT_EQ(gltf(glb(json.dump(), gltf_triangle_buffer())).triangles, (std::vector<Corners>{{0, 1, 2}, {1, 0, 2}}));
}

// Bad files: one line each, with its place.

TEST(MeshFile, ObjMistakesNameTheirLine) {
  const std::string three = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
  const std::map<std::string, std::string> mistakes{
      {three + "f 1 2 4\n", "a.obj:4: a face names vertex 4; there are 3 so far, counted from 1"},
      {three + "\nf 1 2 0\n", "a.obj:5: a face names vertex 0; there are 3 so far, counted from 1"},
      {three + "f 1 2 -4\n", "a.obj:4: a face names vertex -4; there are 3 so far, counted from 1"},
      {three + "f 1//1 2//1 3//1\n", "a.obj:4: a face names normal 1; there are 0 so far, counted from 1"},
      {"v 0 nan 0\n", "a.obj:1: a vertex is not of three numbers"},
      {"v 0 0\n", "a.obj:1: a vertex is not of three numbers"},
      {"v 0 0 1e999\nv 0 0 0\n", "a.obj:1: vertex 0 has a coordinate that is not finite"},
      {three, "a.obj: holds no faces"},
      {"", "a.obj: holds no vertices"},
      {"# nothing\n", "a.obj: holds no vertices"},
  };
  for (const auto& [text, message] : mistakes) EXPECT_EQ(message_of([&] { obj(text); }), message) << text;
}

TEST(MeshFile, PlyMistakesNameTheirLine) {
  const auto with = [](const std::string& from, const std::string& to) {
    std::string text = ply_tetrahedron;
    return text.replace(text.find(from), from.size(), to);
  };
  const std::map<std::string, std::string> mistakes{
      {with("3 1 2 3", "3 1 2 4"), "a.ply:18: a face names vertex 4, counted from 0; there are 4"},
      {with("3 1 2 3", "3 1 2 -1"), "a.ply:18: a face names vertex -1, counted from 0; there are 4"},
      {with("3 1 2 3", "3 1 2"), "a.ply:19: is cut short"},
      {with("3 1 2 3", "9 1 2 3"), "a.ply:18: has a list that is longer than the file"},
      {with("1 0 0", "1 nan 0"), "a.ply:12: vertex 1 has a coordinate that is not finite"},
      {with("1 0 0", "1 x 0"), "a.ply:12: has something else where a number is due"},
      {with("element vertex 4", "element vertex 100000000"),
       "a.ply: claims 100000000 of vertex, which its size does not allow"},
      {with("element face 4", "element face 18446744073709551615"),
       "a.ply: claims 18446744073709551615 of face, which its size does not allow"},
      {with("property float z", "property half z"), "a.ply:7: has a property of a type that is not known"},
      {with("property float z\n", "property\n"), "a.ply:7: its header has a line that is not understood"},
      {with("property float z\n", ""), "a.ply: has vertices without x, y or z"},
      {with("format ascii 1.0", "format ebcdic 1.0"),
       "a.ply:2: has a format that is not known; allowed are ascii, binary_little_endian and binary_big_endian"},
      {with("end_header", "end"), "a.ply:10: its header has a line that is not understood"},
      {with("element face 4", "element face 0"), "a.ply: holds no faces"},
      {"solid", "a.ply:1: is no PLY: its first line is not \"ply\""},
      {"ply\nformat ascii 1.0\n", "a.ply:2: has no end_header"},
  };
  for (const auto& [text, message] : mistakes) EXPECT_EQ(message_of([&] { ply(text); }), message) << text;
  const std::string whole = binary_ply_tetrahedron(false);
  for (std::size_t size = 0; size < whole.size(); ++size)
    EXPECT_NE(message_of([&] { ply(whole.substr(0, size)); }), "accepted") << "cut to " << size << " bytes";
}

TEST(MeshFile, GltfMistakesAreTold) {
  const auto message = [](auto change) {
    nlohmann::json json = gltf_triangle();
    change(json);
    return message_of([&] { gltf(glb(json.dump(), gltf_triangle_buffer())); });
  };
  EXPECT_EQ(message([](auto& j) { j["accessors"][0]["count"] = 100000000; }),
            "a.glb: accessor 0 is longer than its buffer");
  EXPECT_EQ(message([](auto& j) { j["accessors"][0]["bufferView"] = 9; }),
            "a.glb: names buffer view 9, which is not there");
  EXPECT_EQ(message([](auto& j) { j["bufferViews"][0]["byteLength"] = 1000; }),
            "a.glb: accessor 0 is outside its buffer");
  EXPECT_EQ(message([](auto& j) { j["nodes"][1]["children"] = {0}; }), "a.glb: has node 0 at two places of its tree");
  EXPECT_EQ(message([](auto& j) { j["nodes"][1]["mesh"] = 1; }), "a.glb: names mesh 1, which is not there");
  EXPECT_EQ(message([](auto& j) { j["meshes"][0]["primitives"][0]["mode"] = 0; }), "a.glb: holds no vertices");
  EXPECT_EQ(message([](auto& j) { j["extensionsRequired"] = {"KHR_draco_mesh_compression"}; }),
            "a.glb: is compressed by KHR_draco_mesh_compression, which is not read; allowed are files without");
  std::string nested =
      R"({"asset": {"version": "2.0", "extras": )" + std::string(100000, '[') + std::string(100000, ']') + "}}";
  EXPECT_EQ(message_of([&] { gltf(nested); }), "a.glb: its JSON is nested too deep");
}

TEST(MeshFile, GltfOfSmallSizeMakesNoEndlessMesh) {
  nlohmann::json json = gltf_triangle();
  json["accessors"][1]["count"] = 3;
  nlohmann::json primitive = json["meshes"][0]["primitives"][0], many = nlohmann::json::array();
  for (int i = 0; i < 2000; ++i) many.push_back(primitive);
  json["meshes"][0]["primitives"] = many;
  nlohmann::json nodes = nlohmann::json::array(), roots = nlohmann::json::array();
  for (int i = 0; i < 2000; ++i) nodes.push_back({{"mesh", 0}}), roots.push_back(i);
  json["nodes"] = nodes;
  json["scenes"][0]["nodes"] = roots;
  const std::string message = message_of([&] { gltf(glb(json.dump(), gltf_triangle_buffer())); });
  EXPECT_NE(message.find("triangles of so small a file"), std::string::npos) << message;
}

TEST(MeshFile, WhatIsLeftOutIsCounted) {
  const std::string vertices = "v 0 0 0\nv 1 0 0\nv 0 1 0\nvn 0 0 0\n";
  const MeshData mesh = obj(vertices + "f 1 2\nf 1//1 2//1 3//1\nf 3\n");
  EXPECT_EQ(mesh.told, (std::vector<std::string>{
                           "2 faces have fewer than 3 corners and are left out; the first: a.obj:5",
                           "1 normal has no direction and is computed where it is needed; the first: a.obj"}));
  const PlacedMesh placed = place(mesh, {}, true);
  EXPECT_EQ(placed.normals, std::vector<dvec3>(3, dvec3{0, 0, 1}));
}

class MeshFileOnDisk : public OwnFolder {};

TEST_F(MeshFileOnDisk, MissingFilesAndFoldersAreTold) {
  std::filesystem::create_directory("folder.obj");
  EXPECT_EQ(message_of([] { load_mesh("none.obj"); }), "none.obj: cannot be read: No such file or directory");
  EXPECT_EQ(message_of([] { load_mesh("folder.obj"); }), "folder.obj: cannot be read: it is a folder");
  EXPECT_EQ(message_of([] { load_mesh("mesh.stl"); }),
            "mesh.stl: is no mesh by its ending; allowed are .obj, .ply, .gltf and .glb");
}

TEST_F(MeshFileOnDisk, WhatIsInUseIsReadOnce) {
  std::ofstream("a.obj") << obj_tetrahedron;
  auto first = load_mesh("a.obj");
  EXPECT_EQ(load_mesh("a.obj"), first);
  EXPECT_EQ(load_mesh(folder / "a.obj"), first);
  std::ofstream("a.obj", std::ios::app) << "f 1 2 3\n";
  const auto changed = load_mesh("a.obj");
  EXPECT_NE(changed, first);
  EXPECT_NE(changed->hash, first->hash);
}

// A random star-shaped outline, often not convex, in a random plane: its triangles cover it once. Their areas add up to
// it, all turned its way.
TEST(Triangulate, CoversOutlinesThatAreNotConvex) {
  std::mt19937 random(1);
  const auto uniform = [&](double low, double high) { return std::uniform_real_distribution(low, high)(random); };
  int concave = 0;
  for (int round = 0; round < 500; ++round) {
    const int corners = 4 + round % 20;
    const dvec3 u = normalize(dvec3(uniform(-1, 1), uniform(-1, 1), 0.3)),
                v = normalize(cross(u, dvec3(0.2, 0.7, uniform(-1, 1))));
    const dvec3 normal = cross(u, v);
    std::vector<dvec3> outline;
    for (int i = 0; i < corners; ++i) {
      const double angle = 2 * 3.14159265358979 * i / corners, radius = uniform(0.2, 1);
      outline.push_back(dvec3(3, 2, 1) + radius * (std::cos(angle) * u + std::sin(angle) * v));
    }
    double area = 0, sum = 0;
    for (std::size_t i = 1; i + 1 < outline.size(); ++i)
      area += dot(cross(outline[i] - outline[0], outline[i + 1] - outline[0]), normal);
    const auto triangles = triangulate(outline);
    ASSERT_EQ(triangles.size(), outline.size() - 2);
    for (const auto& [a, b, c] : triangles) {
      const double part = dot(cross(outline[b] - outline[a], outline[c] - outline[a]), normal);
      EXPECT_GT(part, -1e-12) << "round " << round;
      sum += std::abs(part);
    }
    EXPECT_NEAR(sum, area, 1e-9) << "round " << round;
    for (std::size_t i = 0; i < outline.size(); ++i) {
      const dvec3 &a = outline[i], &b = outline[(i + 1) % outline.size()], &c = outline[(i + 2) % outline.size()];
      if (dot(cross(b - a, c - a), normal) < 0) {
        ++concave;
        break;
      }
    }
  }
  EXPECT_GT(concave, 300) << "the outlines were convex";
}

TEST(Triangulate, KeepsTheWindingOfFiveCorners) {
  const MeshData mesh = obj("v 0 0 0\nv 2 0 0\nv 2 2 0\nv 1 0.5 0\nv 0 2 0\nf 1 2 3 4 5\n");
  ASSERT_EQ(mesh.triangles.size(), 3u);
  for (std::size_t t = 0; t < 3; ++t)
    EXPECT_GT(cross(corner(mesh, t, 1) - corner(mesh, t, 0), corner(mesh, t, 2) - corner(mesh, t, 0)).z, 0);
}

// Placement: scale, then turns about x, y and z, then the move.

TEST(PlaceMesh, ScalesTurnsAndMovesInThisOrder) {
  const MeshData mesh = obj("v 1 2 3\nv 0 0 0\nv 1 0 0\nf 1 2 3\n");
  // (1, 2, 3) x (2, 1, 1) = (2, 2, 3); about x by 90: (2, -3, 2); about y by 90: (2, -3, -2); about z by 90: (3, 2,
  // -2).
  const PlacedMesh placed = place(mesh, {{2, 1, 1}, {90, 90, 90}, {10, 0, 0}}, false);
  EXPECT_EQ(placed.vertices[0], (dvec3{13, 2, -2}));
  EXPECT_TRUE(placed.normals.empty());
}

TEST(PlaceMesh, MirrorsKeepTheFront) {
  const MeshData mesh = obj(obj_tetrahedron);
  for (const dvec3 scale : {dvec3{-1, 1, 1}, dvec3{-1, -1, -1}, dvec3{2, -3, 1}, dvec3{-2, -3, 1}})
    for (const bool smooth : {false, true}) {
      const PlacedMesh placed = place(mesh, {scale, {10, 20, 30}, {1, 2, 3}}, smooth);
      EXPECT_NEAR(volume(placed.vertices, placed.triangles) -
                      volume(std::vector<dvec3>(placed.vertices.size(), dvec3{0}), placed.triangles),
                  std::abs(scale.x * scale.y * scale.z) / 6, 1e-12);
      for (std::size_t t = 0; smooth && t < placed.triangles.size(); ++t) {
        const auto at = [&](std::size_t k) { return placed.vertices[std::size_t(placed.triangles[t][k])]; };
        const dvec3 across = normalize(cross(at(1) - at(0), at(2) - at(0)));
        for (std::size_t k = 0; k < 3; ++k)
          EXPECT_NEAR(dot(across, placed.normals[std::size_t(placed.triangles[t][k])]), 1, 1e-12);
      }
    }
}

TEST(PlaceMesh, VerticesWithSeveralNormalsBecomeSeveral) {
  const PlacedMesh flat = place(obj(obj_tetrahedron), {}, false), smooth = place(obj(obj_tetrahedron), {}, true);
  EXPECT_EQ(flat.vertices.size(), 4u);
  EXPECT_EQ(smooth.vertices.size(), 12u);
  EXPECT_EQ(smooth.normals.size(), 12u);
  EXPECT_DOUBLE_EQ(volume(smooth.vertices, smooth.triangles), volume(flat.vertices, flat.triangles));
}

// On a sphere of triangles the mean normals point away from the centre, at seams of repeated vertices too.
TEST(PlaceMesh, ComputedNormalsOfASpherePointOutwards) {
  std::string text;
  constexpr int n = 24;
  for (int row = 0; row <= n; ++row)
    for (int column = 0; column <= 2 * n; ++column) {
      const double theta = 3.14159265358979 * row / n, phi = 3.14159265358979 * (column % (2 * n)) / n;
      text += "v " + std::to_string(std::sin(theta) * std::cos(phi)) + " " + std::to_string(std::cos(theta)) + " " +
              std::to_string(std::sin(theta) * std::sin(phi)) + "\n";
    }
  for (int row = 0; row < n; ++row)
    for (int column = 0; column < 2 * n; ++column) {
      const int a = 1 + row * (2 * n + 1) + column, b = a + 2 * n + 1;
      text += "f " + std::to_string(a) + " " + std::to_string(a + 1) + " " + std::to_string(b + 1) + " " +
              std::to_string(b) + "\n";
    }
  const PlacedMesh sphere = place(obj(text), {}, true);
  for (std::size_t i = 0; i < sphere.vertices.size(); ++i)
    EXPECT_GT(dot(normalize(sphere.vertices[i]), sphere.normals[i]), 0.998) << i;
}

}  // namespace
}  // namespace glimt
