#include "mesh/mesh_builder.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <glm/geometric.hpp>
#include <limits>
#include <numeric>

#include "mesh/triangulate.h"

namespace glimt {
namespace {

constexpr std::size_t most_elements = std::size_t{1} << 30;

/// FNV-1a over words of 8 bytes.
class Hash {
 public:
  template <class T>
  void add(const std::vector<T>& values) {
    add_word(values.size());
    const auto* bytes = reinterpret_cast<const char*>(values.data());
    const std::size_t size = values.size() * sizeof(T);
    std::size_t at = 0;
    for (std::uint64_t word = 0; at + sizeof word <= size; at += sizeof word) {
      std::memcpy(&word, bytes + at, sizeof word);
      add_word(word);
    }
    std::uint64_t rest = 0;
    if (size > at) std::memcpy(&rest, bytes + at, size - at);
    add_word(rest);
  }
  void add(std::string_view text) { add(std::vector<char>(text.begin(), text.end())); }
  void add_word(std::uint64_t word) { value_ = std::rotl(value_ ^ word, 29) * 0x9e3779b97f4a7c15; }
  std::uint64_t value() const { return value_; }

 private:
  std::uint64_t value_ = 0xcbf29ce484222325;
};

bool finite(const glm::dvec3& v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }

}  // namespace

void MeshBuilder::reserve(std::size_t vertices, std::size_t triangles) {
  data_.vertices.reserve(vertices);
  data_.triangles.reserve(triangles);
}

void MeshBuilder::fail(const std::string& what, std::size_t line) const {
  throw MeshFileError(file_ + (line > 0 ? ":" + std::to_string(line) : "") + ": " + what);
}

void MeshBuilder::add_vertex(const glm::dvec3& vertex, std::size_t line) {
  if (!finite(vertex))
    fail("vertex " + std::to_string(data_.vertices.size()) + " has a coordinate that is not finite", line);
  if (data_.vertices.size() >= most_elements) fail("has more vertices than can be counted", line);
  data_.vertices.push_back(vertex);
}

void MeshBuilder::add_normal(const glm::dvec3& normal) {
  const double size = length(normal);
  data_.normals.push_back(finite(normal) && std::isfinite(size) && size > 0 ? normal / size : glm::dvec3{0});
}

void MeshBuilder::set_material(std::string_view name) {
  auto known = std::ranges::find(materials_, name);
  if (known == materials_.end()) known = materials_.insert(known, std::string(name));
  const int material = static_cast<int>(known - materials_.begin());
  if (material_of_.empty() && material > 0 && !data_.triangles.empty()) material_of_.assign(data_.triangles.size(), 0);
  material_ = material;
}

void MeshBuilder::add_face(std::span<const FaceCorner> corners, std::size_t line) {
  const auto vertices = static_cast<std::int64_t>(data_.vertices.size());
  const auto normals = static_cast<std::int64_t>(data_.normals.size());
  for (const FaceCorner& corner : corners) {
    if (corner.vertex < 0 || corner.vertex >= vertices)
      fail("a face names vertex " + std::to_string(corner.vertex) + ", counted from 0; there are " +
               std::to_string(vertices),
           line);
    if (corner.normal < -1 || corner.normal >= normals)
      fail("a face names normal " + std::to_string(corner.normal) + ", counted from 0; there are " +
               std::to_string(normals),
           line);
  }
  if (corners.size() < 3) return few_corners_.add(line);
  if (material_ < 0) set_material({});
  if (corners.size() == 3) return add_triangle(corners[0], corners[1], corners[2]);
  std::vector<glm::dvec3> outline;
  outline.reserve(corners.size());
  for (const FaceCorner& c : corners) outline.push_back(data_.vertices[static_cast<std::size_t>(c.vertex)]);
  const auto triangles = triangulate(outline);
  if (triangles.empty())
    fail("a face has " + std::to_string(corners.size()) + " corners and is not convex; allowed are " +
             std::to_string(most_corners),
         line);
  for (const auto& [a, b, c] : triangles) add_triangle(corners[a], corners[b], corners[c]);
}

void MeshBuilder::add_triangle(const FaceCorner& a, const FaceCorner& b, const FaceCorner& c) {
  if (data_.triangles.size() >= most_elements) fail("has more triangles than can be counted");
  const bool has_normals = std::max({a.normal, b.normal, c.normal}) >= 0;
  if (has_normals && !corner_normals_) {
    corner_normals_ = true;
    data_.normal_corners.assign(data_.triangles.size(), {-1, -1, -1});
  }
  const auto narrow = [](std::int64_t i) { return static_cast<int>(i); };
  data_.triangles.push_back({narrow(a.vertex), narrow(b.vertex), narrow(c.vertex)});
  if (corner_normals_) data_.normal_corners.push_back({narrow(a.normal), narrow(b.normal), narrow(c.normal)});
  if (!material_of_.empty() || material_ > 0) material_of_.push_back(material_);
}

void MeshBuilder::tell(const Count& count, const char* one, const char* many) {
  if (count.number == 0) return;
  data_.told.push_back(std::to_string(count.number) + " " + (count.number == 1 ? one : many) + "; the first: " + file_ +
                       (count.line > 0 ? ":" + std::to_string(count.line) : ""));
}

void MeshBuilder::sort_by_group() {
  if (material_of_.empty()) {
    data_.groups = {{materials_.front(), 0, static_cast<int>(data_.triangles.size())}};
    return;
  }
  std::vector<int> order(data_.triangles.size());
  std::iota(order.begin(), order.end(), 0);
  const auto material = [&](int i) { return material_of_[static_cast<std::size_t>(i)]; };
  std::ranges::stable_sort(order, {}, material);
  const auto sorted = [&](const std::vector<std::array<int, 3>>& values) {
    std::vector<std::array<int, 3>> result;
    result.reserve(values.size());
    for (const int i : order) result.push_back(values[static_cast<std::size_t>(i)]);
    return result;
  };
  data_.triangles = sorted(data_.triangles);
  if (corner_normals_) data_.normal_corners = sorted(data_.normal_corners);
  for (std::size_t i = 0; i < order.size(); ++i) {
    const std::string& name = materials_[static_cast<std::size_t>(material(order[i]))];
    if (data_.groups.empty() || data_.groups.back().material != name)
      data_.groups.push_back({name, static_cast<int>(i), 0});
    ++data_.groups.back().count;
  }
}

MeshData MeshBuilder::finish() {
  if (data_.vertices.empty()) fail("holds no vertices");
  if (data_.triangles.empty()) fail("holds no faces");
  sort_by_group();
  const bool of_vertices = vertex_normals_ && data_.normals.size() == data_.vertices.size();
  if (!corner_normals_ && !of_vertices) data_.normals.clear();
  for (const glm::dvec3& normal : data_.normals)
    if (normal == glm::dvec3{0}) bad_normals_.add(0);
  tell(few_corners_, "face has fewer than 3 corners and is left out",
       "faces have fewer than 3 corners and are left out");
  tell(bad_normals_, "normal has no direction and is computed where it is needed",
       "normals have no direction and are computed where they are needed");
  Hash hash;
  hash.add(data_.vertices);
  hash.add(data_.triangles);
  hash.add(data_.normals);
  hash.add(data_.normal_corners);
  for (const MeshGroup& group : data_.groups) {
    hash.add(group.material);
    hash.add_word(static_cast<std::uint64_t>(group.count));
  }
  data_.hash = hash.value();
  return std::move(data_);
}

}  // namespace glimt
