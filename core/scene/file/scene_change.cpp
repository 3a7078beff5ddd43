#include "scene/file/scene_change.h"

#include <algorithm>
#include <sstream>
#include <vector>

#include "scene/file/scene_file.h"
#include "scene/file/text.h"

namespace glimt {
namespace {

struct SettingText {
  const Settings& settings;

  std::string operator()(const Choice<Settings>& choice) const {
    return std::string(choice.names[static_cast<std::size_t>(choice.get(settings))]);
  }
  std::string operator()(const Value<Settings, glm::dvec3>& vector) const {
    const glm::dvec3 v = vector.get(settings);
    std::string text = "[";
    for (int c = 0; c < 3; ++c) text += number_text(v[c]) + (c < 2 ? ", " : "]");
    return text;
  }
  template <class T>
  std::string operator()(const Value<Settings, T>& number) const {
    return number_text(number.get(settings));
  }
};

std::vector<std::string> lines_of(const std::string& text) {
  std::istringstream stream(text);
  std::vector<std::string> lines;
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

/// "[material.clay]" for one of its lines; the name of a shape behind "[[sphere]]"; empty above the first section.
std::string section_of(const std::vector<std::string>& lines, std::size_t place) {
  while (place > 0 && !(lines[place].starts_with('[') && lines[place].ends_with(']'))) --place;
  if (!lines[place].starts_with('[')) return {};
  std::string section = lines[place];
  if (place + 1 < lines.size() && lines[place + 1].starts_with("name = ")) section += lines[place + 1].substr(6);
  return section;
}

/// Where two texts of scenes part.
std::string changed_line(const std::vector<std::string>& is, const std::vector<std::string>& should_be) {
  constexpr std::size_t long_line = 60;
  const auto [a, b] = std::ranges::mismatch(is, should_be);
  if (a == is.end() || b == should_be.end()) return "it has other shapes";
  const std::string section = section_of(is, static_cast<std::size_t>(a - is.begin()));
  const std::string key = a->substr(0, a->find(" = "));
  if (key.size() == a->size() || !b->starts_with(key + " = ")) return section + " differs";
  if (std::max(a->size(), b->size()) > long_line) return section + " has other " + key;
  if (section.empty()) return key + " is " + a->substr(key.size() + 3) + ", not " + b->substr(key.size() + 3);
  return section + " has " + *a + ", not " + b->substr(key.size() + 3);
}

}  // namespace

std::string setting_text(const Settings& settings, const Field<Settings>& field) {
  return std::visit(SettingText{settings}, field.member);
}

std::string first_change(const Scene& is, const Scene& should_be) {
  Scene a = is, b = should_be;
  a.render = without_target(a.render);
  b.render = without_target(b.render);
  // What a mesh file holds is compared, not where it lies.
  for (Scene* scene : {&a, &b})
    for (Mesh& mesh : scene->meshes)
      if (mesh.file) mesh.file->path = mesh.file->path.filename();
  if (write_scene(a) == write_scene(b)) return {};
  const auto size = [](const ImageSize& image) {
    return std::to_string(image.width) + "x" + std::to_string(image.height);
  };
  if (a.image != b.image) return "the image is " + size(a.image) + ", not " + size(b.image);
  for (const auto& field : settings_fields()) {
    const std::string value = setting_text(a.render, field), other = setting_text(b.render, field);
    if (value != other) return std::string(field.key) + " is " + value + ", not " + other;
  }
  a.render = b.render = {};
  return changed_line(lines_of(write_scene(a)), lines_of(write_scene(b)));
}

}  // namespace glimt
