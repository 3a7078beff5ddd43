#include "import/mitsuba_xml.h"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <glm/ext/matrix_transform.hpp>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include "mesh/mesh_file.h"
#include "scene/file/scene_file.h"

namespace glimt {
namespace fs = std::filesystem;
namespace {

constexpr int most_nested_xml = 32;
constexpr std::size_t most_text = 1 << 16;

/// "toWorld" of earlier versions as "to_world".
std::string snake_case(std::string_view name) {
  std::string result;
  for (std::size_t i = 0; i < name.size(); ++i) {
    const auto c = static_cast<unsigned char>(name[i]);
    if (std::isupper(c) && i > 0 && !std::isupper(static_cast<unsigned char>(name[i - 1]))) result += '_';
    result += static_cast<char>(std::tolower(c));
  }
  return result;
}

std::string one_line(std::string text) {
  std::ranges::replace_if(
      text, [](unsigned char c) { return c < 0x20; }, ' ');
  return text;
}

}  // namespace

MitsubaFile::MitsubaFile(const fs::path& file) {
  load(file, 0);
  for (const auto& document : documents_) collect_ids(document->xml.document_element(), 0);
}

void MitsubaFile::load(const fs::path& file, int depth) {
  const fs::path whole = fs::absolute(file).lexically_normal();
  if (by_path_.contains(whole)) return;
  if (depth > most_nested_xml) throw SceneError(file.string() + ": is included too deep");
  auto owned = std::make_unique<Document>();
  Document& document = *owned;
  document.file = whole;
  document.text = read_mesh_bytes(file);
  const pugi::xml_parse_result result = document.xml.load_buffer(document.text.data(), document.text.size());
  by_path_[whole] = documents_.size();
  documents_.push_back(std::move(owned));
  if (!result) {
    const auto begin = document.text.begin();
    const auto at = begin + std::min<std::ptrdiff_t>(result.offset, std::ssize(document.text));
    throw SceneError(file.filename().string() + ":" + std::to_string(1 + std::count(begin, at, '\n')) +
                     ": is no sound XML: " + result.description());
  }
  const pugi::xml_node root = document.xml.document_element();
  if (std::string_view(root.name()) != "scene")
    fail(root, "is no scene of Mitsuba: its outermost element is <" + std::string(root.name()) + ">, not <scene>");
  for (const pugi::xml_node node : root.children()) {
    const std::string_view kind = node.name();
    if (kind == "default") parameters_.emplace(node.attribute("name").value(), attribute(node, "value"));
    if (kind == "include") load(path_of(attribute(node, "filename"), node), depth + 1);
  }
}

void MitsubaFile::collect_ids(pugi::xml_node node, int depth) {
  if (depth > most_nested_xml) fail(node, "is nested too deep");
  if (std::string_view(node.name()) != "ref")
    if (const std::string id = attribute(node, "id"); !id.empty()) ids_.emplace(id, node);
  for (const pugi::xml_node child : node.children()) collect_ids(child, depth + 1);
}

void MitsubaFile::for_each(const std::function<void(pugi::xml_node)>& visit) const {
  std::set<const Document*> visited;
  visit_children(*documents_.front(), visited, visit);
}

void MitsubaFile::visit_children(const Document& document, std::set<const Document*>& visited,
                                 const std::function<void(pugi::xml_node)>& visit) const {
  if (!visited.insert(&document).second) return;
  for (const pugi::xml_node node : document.xml.document_element().children()) {
    const std::string_view kind = node.name();
    if (kind == "include") {
      const fs::path file = path_of(attribute(node, "filename"), node);
      visit_children(*documents_[by_path_.at(fs::absolute(file).lexically_normal())], visited, visit);
    } else if (kind != "default" && node.type() == pugi::node_element) {
      visit(node);
    }
  }
}

const MitsubaFile::Document& MitsubaFile::document_of(pugi::xml_node node) const {
  for (const auto& document : documents_)
    if (document->xml.root() == node.root()) return *document;
  return *documents_.front();
}

std::string MitsubaFile::place(pugi::xml_node node) const {
  const Document& document = document_of(node);
  const auto begin = document.text.begin();
  const auto at = begin + std::clamp<std::ptrdiff_t>(node.offset_debug(), 0, std::ssize(document.text));
  return document.file.filename().string() + ":" + std::to_string(1 + std::count(begin, at, '\n'));
}

void MitsubaFile::fail(pugi::xml_node node, const std::string& what) const {
  throw SceneError(place(node) + ": " + one_line(what));
}

std::string MitsubaFile::attribute(pugi::xml_node node, const char* name) const {
  std::string text = node.attribute(name).value();
  for (std::size_t at = text.find('$'); at != std::string::npos; at = text.find('$', at)) {
    std::size_t end = at + 1;
    while (end < text.size() && (std::isalnum(static_cast<unsigned char>(text[end])) || text[end] == '_')) ++end;
    const auto parameter = parameters_.find(text.substr(at + 1, end - at - 1));
    if (parameter == parameters_.end())
      fail(node, "names the parameter " + text.substr(at, end - at) + ", which has no default");
    const std::string& value = parameter->second;
    if (text.size() + value.size() > most_text) fail(node, "has parameters within parameters that are too long");
    text.replace(at, end - at, value);
    at += value.size();
  }
  return text;
}

pugi::xml_node MitsubaFile::property(pugi::xml_node object, std::string_view name) const {
  for (const pugi::xml_node child : object.children())
    if (snake_case(child.attribute("name").value()) == name) return child;
  return {};
}

std::string MitsubaFile::text(pugi::xml_node object, std::string_view name, std::string_view otherwise) const {
  const pugi::xml_node node = property(object, name);
  return node ? attribute(node, "value") : std::string(otherwise);
}

bool MitsubaFile::boolean(pugi::xml_node object, std::string_view name, bool otherwise) const {
  const pugi::xml_node node = property(object, name);
  if (!node) return otherwise;
  const std::string value = attribute(node, "value");
  if (value != "true" && value != "false") fail(node, "is neither true nor false");
  return value == "true";
}

std::vector<double> MitsubaFile::numbers(pugi::xml_node node, const char* name) const {
  const std::string text = attribute(node, name);
  std::vector<double> values;
  for (const char *at = text.data(), *end = at + text.size(); at < end;) {
    if (*at == ' ' || *at == ',' || *at == '\t' || *at == '\n' || *at == '\r' || *at == '+') {
      ++at;
      continue;
    }
    double value = 0;
    const auto [after, error] = std::from_chars(at, end, value);
    if (error != std::errc{} || !std::isfinite(value)) fail(node, "has \"" + text + "\" where numbers are due");
    values.push_back(value);
    at = after;
  }
  return values;
}

double MitsubaFile::number(pugi::xml_node object, std::string_view name, double otherwise) const {
  const pugi::xml_node node = property(object, name);
  if (!node) return otherwise;
  const std::vector<double> values = numbers(node, "value");
  if (values.size() != 1) fail(node, "is not one number");
  return values[0];
}

int MitsubaFile::integer(pugi::xml_node object, std::string_view name, int otherwise) const {
  return static_cast<int>(std::clamp(number(object, name, otherwise), -2e9, 2e9));
}

glm::dvec3 MitsubaFile::vector(pugi::xml_node node, double otherwise) const {
  if (node.attribute("value")) {
    const std::vector<double> values = numbers(node, "value");
    if (values.size() == 1) return glm::dvec3(values[0]);
    if (values.size() != 3) fail(node, "is not of three numbers");
    return {values[0], values[1], values[2]};
  }
  glm::dvec3 result{otherwise};
  constexpr const char* names[]{"x", "y", "z"};
  for (int i = 0; i < 3; ++i)
    if (node.attribute(names[i])) {
      const std::vector<double> values = numbers(node, names[i]);
      if (values.size() != 1) fail(node, std::string("has no number for ") + names[i]);
      result[i] = values[0];
    }
  return result;
}

glm::dmat4 MitsubaFile::transform(pugi::xml_node object, std::string_view name) const {
  glm::dmat4 result{1};
  for (const pugi::xml_node step : property(object, name).children()) {
    const std::string_view kind = step.name();
    const auto point = [&](const char* key) {
      const std::vector<double> v = numbers(step, key);
      if (v.size() != 3) fail(step, std::string(key) + " is not of three numbers");
      return glm::dvec3{v[0], v[1], v[2]};
    };
    glm::dmat4 matrix{1};
    if (kind == "translate") {
      matrix = translate(matrix, vector(step, 0));
    } else if (kind == "scale") {
      matrix = scale(matrix, vector(step, 1));
    } else if (kind == "rotate") {
      const std::vector<double> angle = numbers(step, "angle");
      const glm::dvec3 axis = vector(step, 0);
      if (angle.size() != 1 || length(axis) == 0) fail(step, "turns about no axis, or by no angle");
      matrix = rotate(matrix, glm::radians(angle[0]), axis);
    } else if (kind == "lookat" || kind == "look_at") {
      const glm::dvec3 origin = point("origin"), z = normalize(point("target") - origin);
      const glm::dvec3 up = step.attribute("up") ? point("up") : glm::dvec3{0, 1, 0};
      const glm::dvec3 x = normalize(cross(up, z)), y = cross(z, x);
      matrix = glm::dmat4(glm::dvec4(x, 0), glm::dvec4(y, 0), glm::dvec4(z, 0), glm::dvec4(origin, 1));
    } else if (kind == "matrix") {
      const std::vector<double> values = numbers(step, "value");
      const std::size_t rows = values.size() == 16 ? 4 : values.size() == 9 ? 3 : 0;
      if (rows == 0) fail(step, "is no matrix of 16 or 9 numbers");
      for (std::size_t i = 0; i < values.size(); ++i)
        matrix[static_cast<int>(i % rows)][static_cast<int>(i / rows)] = values[i];
    } else if (step.type() == pugi::node_element) {
      fail(step, "transforms by " + std::string(kind) +
                     ", which is not known; allowed are translate, rotate, scale, matrix and lookat");
    }
    result = matrix * result;
  }
  for (int i = 0; i < 16; ++i)
    if (!std::isfinite(result[i / 4][i % 4])) fail(object, "has a transform that is not finite");
  return result;
}

pugi::xml_node MitsubaFile::resolved(pugi::xml_node node) const {
  if (std::string_view(node.name()) != "ref") return node;
  const auto found = ids_.find(attribute(node, "id"));
  if (found == ids_.end()) fail(node, "refers to \"" + attribute(node, "id") + "\", which is not there");
  return found->second;
}

fs::path MitsubaFile::path_of(const std::string& filename, pugi::xml_node node) const {
  return document_of(node).file.parent_path() / filename;
}

}  // namespace glimt
