#define TINYOBJLOADER_USE_DOUBLE
#include <tiny_obj_loader.h>

#include <algorithm>
#include <istream>
#include <streambuf>

#include "mesh/mesh_file.h"

namespace glimt {
namespace {

/// A text as a stream that hands out one line at a time, and so knows which one is being read.
class LineBuffer : public std::streambuf {
 public:
  explicit LineBuffer(std::string text) : text_(std::move(text)) {
    if (text_.find('\n') == std::string::npos) std::ranges::replace(text_, '\r', '\n');
  }
  std::size_t line() const { return line_; }  ///< from 1
  /// Of the line: what follows its first word.
  std::string_view arguments() const {
    std::string_view text(eback(), static_cast<std::size_t>(egptr() - eback()));
    text.remove_prefix(std::min(text.find_first_not_of(" \t"), text.size()));
    text.remove_prefix(std::min(text.find_first_of(" \t"), text.size()));
    return text;
  }

 private:
  int_type underflow() override {
    if (next_ >= text_.size()) return traits_type::eof();
    const std::size_t begin = next_;
    next_ = std::min(text_.find('\n', begin), text_.size() - 1) + 1;
    setg(text_.data() + begin, text_.data() + begin, text_.data() + next_);
    ++line_;
    return traits_type::to_int_type(*gptr());
  }

  std::string text_;
  std::size_t next_ = 0, line_ = 0;
};

struct ObjReader {
  LineBuffer& lines;
  MeshBuilder& mesh;
  std::vector<FaceCorner> corners;

  /// The library takes what is no number for 0.
  bool three_numbers() const {
    int words = 0;
    bool within = false;
    for (const char c : lines.arguments()) {
      const bool space = c == ' ' || c == '\t' || c == '\r' || c == '\n';
      if (!space && std::string_view("0123456789+-.eE").find(c) == std::string_view::npos) return false;
      words += !space && !within;
      within = !space;
    }
    return words >= 3;
  }

  void vertex(double x, double y, double z) {
    if (!three_numbers()) mesh.fail("a vertex is not of three numbers", lines.line());
    mesh.add_vertex({x, y, z}, lines.line());
  }

  void normal(double x, double y, double z) { mesh.add_normal(three_numbers() ? glm::dvec3{x, y, z} : glm::dvec3{0}); }

  /// Counted from 1, or from the last backwards by negative numbers.
  std::int64_t place(int index, std::size_t count, const char* what) const {
    const auto n = static_cast<std::int64_t>(count);
    if (index == 0 || index > n || index < -n)
      mesh.fail(std::string("a face names ") + what + " " + std::to_string(index) + "; there are " + std::to_string(n) +
                    " so far, counted from 1",
                lines.line());
    return index > 0 ? index - 1 : n + index;
  }

  void face(std::span<const tinyobj::index_t> indices) {
    corners.clear();
    for (const tinyobj::index_t& i : indices)
      corners.push_back({place(i.vertex_index, mesh.data().vertices.size(), "vertex"),
                         i.normal_index == 0 ? -1 : place(i.normal_index, mesh.data().normals.size(), "normal")});
    mesh.add_face(corners, lines.line());
  }

  void material(std::string_view name) {
    while (!name.empty() && (name.back() == ' ' || name.back() == '\t')) name.remove_suffix(1);
    mesh.set_material(name);
  }
};

ObjReader& reader(void* data) { return *static_cast<ObjReader*>(data); }

}  // namespace

MeshData read_obj(std::string bytes, const std::filesystem::path& file) {
  LineBuffer lines(std::move(bytes));
  MeshBuilder mesh(file);
  ObjReader state{lines, mesh, {}};
  tinyobj::callback_t callbacks;
  callbacks.vertex_cb = [](void* data, double x, double y, double z, double) { reader(data).vertex(x, y, z); };
  callbacks.normal_cb = [](void* data, double x, double y, double z) { reader(data).normal(x, y, z); };
  callbacks.index_cb = [](void* data, tinyobj::index_t* indices, int count) {
    reader(data).face({indices, static_cast<std::size_t>(count)});
  };
  callbacks.usemtl_cb = [](void* data, const char* name, int) { reader(data).material(name); };
  std::istream stream(&lines);
  stream.exceptions(std::ios::badbit);
  std::string error;
  if (!tinyobj::LoadObjWithCallback(stream, callbacks, &state, nullptr, nullptr, &error)) mesh.fail(error);
  return mesh.finish();
}

}  // namespace glimt
