#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <limits>
#include <optional>
#include <type_traits>

#include "mesh/gltf_document.h"
#include "mesh/mesh_file.h"

namespace glimt {
namespace {

/// The numbers of an accessor, each row in range of its buffer.
class Rows {
 public:
  Rows(const tinygltf::Model& model, int index, const MeshBuilder& mesh) {
    const auto at = [&](const auto& all, int place, const char* what) -> const auto& {
      if (place < 0 || static_cast<std::size_t>(place) >= all.size())
        mesh.fail(std::string("names ") + what + " " + std::to_string(place) + ", which is not there");
      return all[static_cast<std::size_t>(place)];
    };
    const tinygltf::Accessor& accessor = at(model.accessors, index, "accessor");
    const auto refuse = [&](const char* why) { mesh.fail("accessor " + std::to_string(index) + " " + why); };
    if (accessor.sparse.isSparse) refuse("is sparse, which is not read");
    const tinygltf::BufferView& view = at(model.bufferViews, accessor.bufferView, "buffer view");
    const tinygltf::Buffer& buffer = at(model.buffers, view.buffer, "buffer");
    const int stride = accessor.ByteStride(view);
    const int bytes = tinygltf::GetComponentSizeInBytes(static_cast<std::uint32_t>(accessor.componentType));
    columns_ = tinygltf::GetNumComponentsInType(static_cast<std::uint32_t>(accessor.type));
    if (stride <= 0 || bytes <= 0 || columns_ <= 0) refuse("is of no known type");
    const std::size_t size = buffer.data.size(),
                      row = static_cast<std::size_t>(bytes) * static_cast<std::size_t>(columns_);
    count_ = accessor.count;
    stride_ = static_cast<std::size_t>(stride);
    if (view.byteOffset > size || view.byteLength > size - view.byteOffset || accessor.byteOffset > view.byteLength)
      refuse("is outside its buffer");
    const std::size_t left = view.byteLength - accessor.byteOffset;
    if (count_ > 0 && (row > left || count_ - 1 > (left - row) / stride_)) refuse("is longer than its buffer");
    data_ = buffer.data.data() + view.byteOffset + accessor.byteOffset;
    type_ = accessor.componentType;
    normalized_ = accessor.normalized;
  }

  std::size_t count() const { return count_; }
  int columns() const { return columns_; }
  std::int64_t index(std::size_t row) const { return static_cast<std::int64_t>(number(row, 0)); }
  glm::dvec3 vector(std::size_t row) const { return {number(row, 0), number(row, 1), number(row, 2)}; }

 private:
  template <class T>
  double as(const unsigned char* from) const {
    T value{};
    std::memcpy(&value, from, sizeof value);
    if constexpr (std::is_integral_v<T>)
      if (normalized_) return std::max(-1.0, static_cast<double>(value) / std::numeric_limits<T>::max());
    return static_cast<double>(value);
  }

  double number(std::size_t row, std::size_t column) const {
    const unsigned char* start = data_ + row * stride_;
    switch (type_) {
      case TINYGLTF_COMPONENT_TYPE_BYTE:
        return as<std::int8_t>(start + column);
      case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
        return as<std::uint8_t>(start + column);
      case TINYGLTF_COMPONENT_TYPE_SHORT:
        return as<std::int16_t>(start + 2 * column);
      case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
        return as<std::uint16_t>(start + 2 * column);
      case TINYGLTF_COMPONENT_TYPE_INT:
        return as<std::int32_t>(start + 4 * column);
      case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
        return as<std::uint32_t>(start + 4 * column);
      case TINYGLTF_COMPONENT_TYPE_DOUBLE:
        return as<double>(start + 8 * column);
      default:
        return static_cast<double>(as<float>(start + 4 * column));
    }
  }

  const unsigned char* data_ = nullptr;
  std::size_t count_ = 0, stride_ = 0;
  int columns_ = 0, type_ = 0;
  bool normalized_ = false;
};

/// How many vertices and triangles a file may make by naming the same ones many times.
std::size_t most_made(std::size_t bytes) { return 1'000'000 + 4 * bytes; }

struct GltfReader {
  const tinygltf::Model& model;
  MeshBuilder& mesh;
  std::size_t most;
  std::size_t skipped = 0;

  void add(const tinygltf::Primitive& primitive, const glm::dmat4& transform) {
    const int mode = primitive.mode < 0 ? TINYGLTF_MODE_TRIANGLES : primitive.mode;
    const auto position = primitive.attributes.find("POSITION"), normal = primitive.attributes.find("NORMAL");
    if (position == primitive.attributes.end() || mode < TINYGLTF_MODE_TRIANGLES || mode > TINYGLTF_MODE_TRIANGLE_FAN) {
      ++skipped;
      return;
    }
    const Rows positions(model, position->second, mesh);
    if (positions.columns() != 3) mesh.fail("has positions that are not of three numbers");
    const std::size_t first = mesh.data().vertices.size(), first_normal = mesh.data().normals.size();
    bound(first + positions.count());
    for (std::size_t i = 0; i < positions.count(); ++i)
      mesh.add_vertex(glm::dvec3(transform * glm::dvec4(positions.vector(i), 1)), 0);
    const bool mirrored = determinant(glm::dmat3(transform)) < 0;
    bool has_normals = false;
    if (normal != primitive.attributes.end()) {
      const Rows normals(model, normal->second, mesh);
      has_normals = normals.columns() == 3 && normals.count() == positions.count();
      const glm::dmat3 m(transform);
      const glm::dmat3 cofactors(cross(m[1], m[2]), cross(m[2], m[0]), cross(m[0], m[1]));
      for (std::size_t i = 0; has_normals && i < normals.count(); ++i)
        mesh.add_normal(cofactors * normals.vector(i) * (mirrored ? -1.0 : 1.0));
    }
    mesh.set_material(gltf_material_name(model, primitive.material));

    std::optional<Rows> indices;
    if (primitive.indices >= 0) indices.emplace(model, primitive.indices, mesh);
    const std::size_t count = indices ? indices->count() : positions.count();
    bound(mesh.data().triangles.size() + count);
    const auto corner = [&](std::size_t k) {
      const std::int64_t i = indices ? indices->index(k) : static_cast<std::int64_t>(k);
      if (i < 0 || i >= static_cast<std::int64_t>(positions.count()))
        mesh.fail("a face names vertex " + std::to_string(i) + "; there are " + std::to_string(positions.count()));
      const auto offset = static_cast<std::int64_t>(first);
      return FaceCorner{offset + i, has_normals ? static_cast<std::int64_t>(first_normal) + i : -1};
    };
    const std::size_t step = mode == TINYGLTF_MODE_TRIANGLES ? 3 : 1;
    for (std::size_t k = 0; k + 3 <= count; k += step) {
      std::array corners{corner(mode == TINYGLTF_MODE_TRIANGLE_FAN ? 0 : k), corner(k + 1), corner(k + 2)};
      const bool odd = mode == TINYGLTF_MODE_TRIANGLE_STRIP && k % 2 == 1;
      if (odd != mirrored) std::swap(corners[1], corners[2]);
      mesh.add_face(corners, 0);
    }
  }

  void bound(std::size_t number) const {
    if (number > most) mesh.fail("makes more than " + std::to_string(most) + " triangles of so small a file");
  }
};

}  // namespace

std::vector<std::filesystem::path> files_beside(const std::filesystem::path& file) {
  std::vector<std::filesystem::path> files;
  if (file.extension() != ".gltf" && file.extension() != ".glb") return files;
  for (const tinygltf::Buffer& buffer : parse_gltf(read_mesh_bytes(file), file).buffers)
    if (!buffer.uri.empty() && !buffer.uri.starts_with("data:")) files.push_back(file.parent_path() / buffer.uri);
  return files;
}

MeshData read_gltf(std::string_view bytes, const std::filesystem::path& file) {
  const tinygltf::Model model = parse_gltf(bytes, file);
  MeshBuilder mesh(file);
  std::size_t size = bytes.size();
  for (const tinygltf::Buffer& buffer : model.buffers) size += buffer.data.size();
  GltfReader reader{model, mesh, most_made(size)};
  walk_nodes(model, file, [&](const tinygltf::Node& node, const glm::dmat4& transform) {
    if (node.mesh < 0) return;
    if (static_cast<std::size_t>(node.mesh) >= model.meshes.size())
      mesh.fail("names mesh " + std::to_string(node.mesh) + ", which is not there");
    for (const tinygltf::Primitive& p : model.meshes[static_cast<std::size_t>(node.mesh)].primitives)
      reader.add(p, transform);
  });
  MeshData data = mesh.finish();
  if (reader.skipped > 0)
    data.told.push_back(std::to_string(reader.skipped) + " of the parts of " + file.filename().string() +
                        " are no triangles and are left out");
  return data;
}

}  // namespace glimt
