#pragma once

#include <bit>
#include <cstring>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

/// Small sound mesh files, for tests.
namespace glimt::testing {

/// A tetrahedron that stands on its side y = 0, closed, with normals and two materials.
inline const std::string obj_tetrahedron = R"(# a tetrahedron
mtllib none.mtl
o solid
v 0 0 0
v 1 0 0
v 0 1 0
v 0 0 1
vn 0 0 -1
vn 0 -1 0
vn -1 0 0
vn 1 1 1
usemtl steel
f 1//1 3//1 2//1
f 1//2 2//2 4//2
usemtl wood
f 1//3 4//3 3//3
f 2//4 3//4 4//4
)";

inline const std::string ply_tetrahedron = R"(ply
format ascii 1.0
comment a tetrahedron
element vertex 4
property float x
property float y
property float z
element face 4
property list uchar int vertex_indices
end_header
0 0 0
1 0 0
0 1 0
0 0 1
3 0 2 1
3 0 1 3
3 0 3 2
3 1 2 3
)";

template <class T>
void append(std::string& bytes, T value, bool big_endian = false) {
  std::string word(sizeof value, '\0');
  std::memcpy(word.data(), &value, sizeof value);
  bytes += big_endian ? std::string(word.rbegin(), word.rend()) : word;
}

/// The same, in bytes, with normals and a column and a list that nobody reads.
inline std::string binary_ply_tetrahedron(bool big_endian) {
  std::string bytes = std::string("ply\nformat binary_") + (big_endian ? "big" : "little") + R"(_endian 1.0
element vertex 4
property float x
property uchar quality
property float y
property double z
property float nx
property float ny
property float nz
element face 4
property list uchar ushort vertex_index
property list uchar float texcoord
end_header
)";
  constexpr int corners[4][3]{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  constexpr int faces[4][3]{{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}};
  const auto number = [&](auto value) { append(bytes, value, big_endian); };
  for (const auto& v : corners) {
    number(static_cast<float>(v[0])), number(std::uint8_t{7}), number(static_cast<float>(v[1]));
    number(static_cast<double>(v[2]));
    for (int i = 0; i < 3; ++i) number(static_cast<float>(i == 1 ? 2 : 0));
  }
  for (const auto& f : faces) {
    number(std::uint8_t{3});
    for (const int i : f) number(static_cast<std::uint16_t>(i));
    number(std::uint8_t{2}), number(0.5F), number(0.25F);
  }
  return bytes;
}

/// A triangle at x, y, z = 0..1 in a node that doubles it and moves it by (10, 0, 0).
inline nlohmann::json gltf_triangle() {
  return nlohmann::json::parse(R"({
    "asset": {"version": "2.0"},
    "scene": 0,
    "scenes": [{"nodes": [0]}],
    "nodes": [{"translation": [10, 0, 0], "children": [1]}, {"scale": [2, 2, 2], "mesh": 0}],
    "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1, "material": 0}]}],
    "materials": [{"name": "red", "pbrMetallicRoughness": {"baseColorFactor": [1, 0, 0, 1], "metallicFactor": 0}}],
    "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3"},
                  {"bufferView": 1, "componentType": 5123, "count": 3, "type": "SCALAR"}],
    "bufferViews": [{"buffer": 0, "byteLength": 36}, {"buffer": 0, "byteOffset": 36, "byteLength": 6}],
    "buffers": [{"byteLength": 44}]
  })");
}

inline std::string gltf_triangle_buffer() {
  std::string buffer;
  for (const float x : {0.F, 0.F, 0.F, 1.F, 0.F, 0.F, 0.F, 1.F, 1.F}) append(buffer, x);
  for (const int i : {0, 1, 2, 0}) append(buffer, static_cast<std::uint16_t>(i));
  return buffer;
}

/// JSON and buffer as .glb.
inline std::string glb(std::string json, const std::string& buffer) {
  while (json.size() % 4 != 0) json += ' ';
  std::string bytes = "glTF";
  append(bytes, std::uint32_t{2});
  append(bytes, static_cast<std::uint32_t>(28 + json.size() + buffer.size()));
  append(bytes, static_cast<std::uint32_t>(json.size()));
  bytes += "JSON" + json;
  append(bytes, static_cast<std::uint32_t>(buffer.size()));
  return bytes + std::string("BIN\0", 4) + buffer;
}

inline std::string glb_triangle() { return glb(gltf_triangle().dump(), gltf_triangle_buffer()); }

}  // namespace glimt::testing
