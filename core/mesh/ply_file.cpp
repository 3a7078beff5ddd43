#include <algorithm>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstring>
#include <limits>
#include <optional>

#include "mesh/mesh_file.h"

namespace glimt {
namespace {

enum class NumberType { int8, uint8, int16, uint16, int32, uint32, float32, float64 };

std::size_t size_of(NumberType type) {
  constexpr std::array<std::size_t, 8> sizes{1, 1, 2, 2, 4, 4, 4, 8};
  return sizes[static_cast<std::size_t>(type)];
}

struct Property {
  std::string_view name;
  NumberType type{};
  std::optional<NumberType> count_type;  ///< of a list
};

struct Element {
  std::string_view name;
  std::uint64_t count = 0;
  std::vector<Property> properties;
};

enum class Coding { text, little_endian, big_endian };

/// Reads numbers one after the other, of text or bytes.
class Numbers {
 public:
  Numbers(std::string_view rest, Coding coding, std::size_t line, const MeshBuilder& mesh)
      : rest_(rest), coding_(coding), line_(line), mesh_(mesh) {}

  double next(NumberType type) { return coding_ == Coding::text ? next_word() : next_bytes(type); }
  /// The least bytes that such a number takes.
  std::size_t least_size(NumberType type) const { return coding_ == Coding::text ? 2 : size_of(type); }
  /// Bytes that are left; the last number of a text may lack its space.
  std::size_t left() const { return rest_.size() + 1; }
  std::size_t line() const { return coding_ == Coding::text ? line_ : 0; }

 private:
  double next_word() {
    while (!rest_.empty() && std::string_view(" \t\r\n").find(rest_.front()) != std::string_view::npos) {
      line_ += rest_.front() == '\n';
      rest_.remove_prefix(1);
    }
    if (rest_.empty()) mesh_.fail("is cut short", line_);
    double value = 0;
    if (rest_.front() == '+') rest_.remove_prefix(1);
    const auto [end, error] = std::from_chars(rest_.data(), rest_.data() + rest_.size(), value);
    const auto length = static_cast<std::size_t>(end - rest_.data());
    const bool ends = length == rest_.size() || std::string_view(" \t\r\n").find(*end) != std::string_view::npos;
    if (error == std::errc::result_out_of_range) value = std::numeric_limits<double>::infinity();
    if (error == std::errc::invalid_argument || !ends) mesh_.fail("has something else where a number is due", line_);
    rest_.remove_prefix(length);
    return value;
  }

  template <class T>
  T take() {
    std::array<char, sizeof(T)> bytes;
    if (rest_.size() < bytes.size()) mesh_.fail("is cut short");
    std::memcpy(bytes.data(), rest_.data(), bytes.size());
    rest_.remove_prefix(bytes.size());
    if (coding_ == Coding::big_endian) std::ranges::reverse(bytes);
    return std::bit_cast<T>(bytes);
  }

  double next_bytes(NumberType type) {
    switch (type) {
      case NumberType::int8:
        return take<std::int8_t>();
      case NumberType::uint8:
        return take<std::uint8_t>();
      case NumberType::int16:
        return take<std::int16_t>();
      case NumberType::uint16:
        return take<std::uint16_t>();
      case NumberType::int32:
        return take<std::int32_t>();
      case NumberType::uint32:
        return take<std::uint32_t>();
      case NumberType::float32:
        return static_cast<double>(take<float>());
      default:
        return take<double>();
    }
  }

  std::string_view rest_;
  Coding coding_;
  std::size_t line_;
  const MeshBuilder& mesh_;
};

/// The words of the header, line by line.
class PlyHeader {
 public:
  PlyHeader(std::string_view bytes, const MeshBuilder& mesh) : rest_(bytes), mesh_(mesh) {
    if (next_line() != "ply") mesh_.fail("is no PLY: its first line is not \"ply\"", 1);
    bool has_format = false;
    while (true) {
      if (rest_.empty()) mesh_.fail("has no end_header", line_);
      const auto words = split(next_line());
      if (words.empty() || words[0] == "comment" || words[0] == "obj_info") continue;
      if (words[0] == "end_header") break;
      if (words[0] == "format" && words.size() == 3) {
        has_format = true;
        read_format(words[1]);
      } else if (words[0] == "element" && words.size() == 3) {
        elements.push_back({words[1], count(words[2]), {}});
      } else if (words[0] == "property" && !elements.empty() && words.size() > 2 &&
                 words.size() == (words[1] == "list" ? 5u : 3u)) {
        add_property(words);
      } else {
        mesh_.fail("its header has a line that is not understood", line_);
      }
    }
    if (!has_format) mesh_.fail("its header names no format", line_);
  }

  Numbers numbers() const { return {rest_, coding_, line_ + 1, mesh_}; }

  std::vector<Element> elements;

 private:
  std::string_view next_line() {
    const std::size_t end = std::min(rest_.find('\n'), rest_.size());
    std::string_view line = rest_.substr(0, end);
    rest_.remove_prefix(std::min(end + 1, rest_.size()));
    if (line.ends_with('\r')) line.remove_suffix(1);
    ++line_;
    return line;
  }

  static std::vector<std::string_view> split(std::string_view line) {
    std::vector<std::string_view> words;
    while (true) {
      line.remove_prefix(std::min(line.find_first_not_of(" \t"), line.size()));
      if (line.empty() || words.size() > 5) return words;
      const std::size_t end = std::min(line.find_first_of(" \t"), line.size());
      words.push_back(line.substr(0, end));
      line.remove_prefix(end);
    }
  }

  void read_format(std::string_view name) {
    if (name == "ascii")
      coding_ = Coding::text;
    else if (name == "binary_little_endian")
      coding_ = Coding::little_endian;
    else if (name == "binary_big_endian")
      coding_ = Coding::big_endian;
    else
      mesh_.fail("has a format that is not known; allowed are ascii, binary_little_endian and binary_big_endian",
                 line_);
  }

  std::uint64_t count(std::string_view word) const {
    std::uint64_t value = 0;
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
    if (error != std::errc{} || end != word.data() + word.size()) mesh_.fail("has an element without a count", line_);
    return value;
  }

  NumberType type(std::string_view word) const {
    constexpr std::array<std::string_view, 8> old_names{"char", "uchar", "short", "ushort",
                                                        "int",  "uint",  "float", "double"};
    constexpr std::array<std::string_view, 8> names{"int8",  "uint8",  "int16",   "uint16",
                                                    "int32", "uint32", "float32", "float64"};
    for (std::size_t i = 0; i < names.size(); ++i)
      if (word == names[i] || word == old_names[i]) return static_cast<NumberType>(i);
    mesh_.fail("has a property of a type that is not known", line_);
  }

  void add_property(const std::vector<std::string_view>& words) {
    Property property{words.back(), type(words[words.size() - 2]), {}};
    if (words[1] == "list") property.count_type = type(words[2]);
    elements.back().properties.push_back(property);
  }

  std::string_view rest_;
  const MeshBuilder& mesh_;
  std::size_t line_ = 0;
  Coding coding_ = Coding::text;
};

/// Throws where the rest of the file cannot hold what its header claims.
void check_claim(const Element& element, const Numbers& numbers, const MeshBuilder& mesh) {
  std::size_t row = 0;
  for (const Property& p : element.properties) row += numbers.least_size(p.count_type.value_or(p.type));
  if (row > 0 && element.count > numbers.left() / row)
    mesh.fail("claims " + std::to_string(element.count) + " of " + std::string(element.name) +
              ", which its size does not allow");
}

/// Of a list whose count comes next.
std::size_t list_size(const Property& list, Numbers& numbers, const MeshBuilder& mesh) {
  const double count = numbers.next(*list.count_type);
  if (!(count >= 0) || count != std::floor(count) || count > static_cast<double>(numbers.left()))
    mesh.fail("has a list that is longer than the file", numbers.line());
  return static_cast<std::size_t>(count);
}

void skip(const Property& property, Numbers& numbers, const MeshBuilder& mesh) {
  const std::size_t count = property.count_type ? list_size(property, numbers, mesh) : 1;
  for (std::size_t i = 0; i < count; ++i) numbers.next(property.type);
}

void read_vertices(const Element& element, Numbers& numbers, MeshBuilder& mesh) {
  constexpr std::array<std::string_view, 6> names{"x", "y", "z", "nx", "ny", "nz"};
  std::vector<int> columns;  // of each property, its place among the names
  for (const Property& p : element.properties) {
    const auto place = std::ranges::find(names, p.name);
    columns.push_back(place == names.end() || p.count_type ? -1 : static_cast<int>(place - names.begin()));
  }
  const auto has = [&](int column) { return std::ranges::find(columns, column) != columns.end(); };
  if (!has(0) || !has(1) || !has(2)) mesh.fail("has vertices without x, y or z");
  const bool has_normals = has(3) && has(4) && has(5);
  mesh.reserve(element.count, 0);
  for (std::uint64_t i = 0; i < element.count; ++i) {
    std::array<double, 6> values{};
    for (std::size_t p = 0; p < columns.size(); ++p)
      if (columns[p] < 0)
        skip(element.properties[p], numbers, mesh);
      else
        values[static_cast<std::size_t>(columns[p])] = numbers.next(element.properties[p].type);
    mesh.add_vertex({values[0], values[1], values[2]}, numbers.line());
    if (has_normals) mesh.add_normal({values[3], values[4], values[5]});
  }
}

void read_faces(const Element& element, Numbers& numbers, MeshBuilder& mesh) {
  mesh.reserve(0, element.count);
  std::vector<FaceCorner> corners;
  for (std::uint64_t i = 0; i < element.count; ++i)
    for (const Property& p : element.properties) {
      if (!p.count_type || (p.name != "vertex_indices" && p.name != "vertex_index")) {
        skip(p, numbers, mesh);
        continue;
      }
      corners.clear();
      const std::size_t count = list_size(p, numbers, mesh);
      for (std::size_t k = 0; k < count; ++k) {
        const double index = numbers.next(p.type);
        if (!(std::abs(index) <= std::numeric_limits<std::int32_t>::max() * 2.0) || index != std::floor(index))
          mesh.fail("a face names a vertex that is no whole number", numbers.line());
        corners.push_back({static_cast<std::int64_t>(index)});
      }
      mesh.add_face(corners, numbers.line());
    }
}

}  // namespace

MeshData read_ply(std::string_view bytes, const std::filesystem::path& file) {
  MeshBuilder mesh(file);
  const PlyHeader header(bytes, mesh);
  Numbers numbers = header.numbers();
  for (const Element& element : header.elements) {
    if (element.properties.empty()) continue;
    check_claim(element, numbers, mesh);
    if (element.name == "vertex")
      read_vertices(element, numbers, mesh);
    else if (element.name == "face")
      read_faces(element, numbers, mesh);
    else
      for (std::uint64_t i = 0; i < element.count; ++i)
        for (const Property& p : element.properties) skip(p, numbers, mesh);
  }
  mesh.normals_are_of_vertices();
  return mesh.finish();
}

}  // namespace glimt
