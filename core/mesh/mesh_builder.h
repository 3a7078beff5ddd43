#pragma once

#include <filesystem>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>

#include "mesh/mesh_data.h"

namespace glimt {

/// A mesh file that cannot be used; what() is one line, "FILE:LINE: what" or "FILE: what".
struct MeshFileError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// A face's corner by its places from 0; -1: without a normal.
struct FaceCorner {
  std::int64_t vertex = 0;
  std::int64_t normal = -1;
};

/// Puts a mesh together from what a file says, and counts what it leaves out. Places in the file, such as "line 12",
/// are for messages. Throws MeshFileError.
class MeshBuilder {
 public:
  explicit MeshBuilder(const std::filesystem::path& file) : file_(file.filename().string()) {}

  void reserve(std::size_t vertices, std::size_t triangles);
  void add_vertex(const glm::dvec3& vertex, std::size_t line);
  void add_normal(const glm::dvec3& normal);
  /// The normals that were added are those of the vertices, one each in their order.
  void normals_are_of_vertices() { vertex_normals_ = true; }
  /// The following faces are of this material.
  void set_material(std::string_view name);
  /// A polygon becomes triangles. Its corners are vertices that have been added.
  void add_face(std::span<const FaceCorner> corners, std::size_t line);

  const MeshData& data() const { return data_; }
  /// Nothing may be added after.
  MeshData finish();

  /// `line` from 1; 0: the file has no lines.
  [[noreturn]] void fail(const std::string& what, std::size_t line = 0) const;

 private:
  struct Count {
    std::size_t number = 0, line = 0;
    void add(std::size_t at) {
      if (number++ == 0) line = at;
    }
  };
  void tell(const Count& count, const char* one, const char* many);
  void add_triangle(const FaceCorner& a, const FaceCorner& b, const FaceCorner& c);
  void sort_by_group();

  std::string file_;
  MeshData data_;
  std::vector<std::string> materials_;
  int material_ = -1;
  std::vector<int> material_of_;  ///< of each triangle; empty as long as all are of the first
  bool corner_normals_ = false, vertex_normals_ = false;
  Count few_corners_, bad_normals_;
};

}  // namespace glimt
