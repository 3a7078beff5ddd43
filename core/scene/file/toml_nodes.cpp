#include "scene/file/toml_nodes.h"

#include <algorithm>
#include <tuple>

#include "scene/file/scene_file.h"
#include "scene/file/text.h"

namespace glimt {
namespace {

std::string_view type_name(const toml::node& node) {
  switch (node.type()) {
    case toml::node_type::table:
      return "a table";
    case toml::node_type::array:
      return "an array";
    case toml::node_type::string:
      return "a string";
    case toml::node_type::integer:
      return "an integer";
    case toml::node_type::floating_point:
      return "a number";
    case toml::node_type::boolean:
      return "a boolean";
    default:
      return "a date or time";
  }
}

[[noreturn]] void wrong_type(const toml::node& node, const std::string& key, std::string_view expected) {
  fail(node.source(), key + ": expected " + std::string(expected) + ", found " + std::string(type_name(node)));
}

}  // namespace

bool is_override(const toml::source_region& place) { return place.path && place.path->starts_with(override_prefix); }

void fail(const toml::source_region& place, const std::string& message) {
  std::string text = place.path ? *place.path : std::string{};
  if (!is_override(place)) text += ":" + std::to_string(place.begin.line) + ":" + std::to_string(place.begin.column);
  text += ": " + message;
  std::ranges::replace_if(
      text, [](unsigned char c) { return c < 0x20; }, ' ');
  throw SceneError(text);
}

const toml::table& as_table(const toml::node& node, const std::string& key) {
  const toml::table* table = node.as_table();
  if (!table) wrong_type(node, key, "a table");
  return *table;
}

const toml::array& as_array(const toml::node& node, const std::string& key, std::string_view of) {
  const toml::array* array = node.as_array();
  if (!array) wrong_type(node, key, "an array of " + std::string(of));
  return *array;
}

std::string as_string(const toml::node& node, const std::string& key) {
  const auto* value = node.as_string();
  if (!value) wrong_type(node, key, "a string");
  return value->get();
}

bool as_boolean(const toml::node& node, const std::string& key) {
  const auto* value = node.as_boolean();
  if (!value) wrong_type(node, key, "true or false");
  return value->get();
}

double as_number(const toml::node& node, const std::string& key) {
  if (!node.is_number()) wrong_type(node, key, "a number");
  return node.is_integer() ? static_cast<double>(node.as_integer()->get()) : node.as_floating_point()->get();
}

int as_integer(const toml::node& node, const std::string& key, int min, int max) {
  const auto* value = node.as_integer();
  if (!value) wrong_type(node, key, "an integer");
  if (value->get() < min || value->get() > max)
    fail(node.source(), key + " is " + std::to_string(value->get()) + "; allowed is " + range_text(min, max, false));
  return static_cast<int>(value->get());
}

glm::dvec3 as_vector(const toml::node& node, const std::string& key) {
  const toml::array& array = as_array(node, key, "3 numbers");
  if (array.size() != 3)
    fail(node.source(), key + ": expected an array of 3 numbers, found " + std::to_string(array.size()) + " elements");
  const auto component = [&](std::size_t i) { return as_number(array[i], key + "[" + std::to_string(i) + "]"); };
  return {component(0), component(1), component(2)};
}

int as_choice(const toml::node& node, const std::string& key, std::span<const std::string_view> names) {
  const std::string value = as_string(node, key);
  const auto it = std::ranges::find(names, value);
  if (it == names.end())
    fail(node.source(), key + ": " + toml_string(value) + " is not known; the nearest is " +
                            toml_string(nearest(value, names)) + " (allowed: " + joined(names) + ")");
  return static_cast<int>(it - names.begin());
}

std::vector<Entry> entries_in_order(const toml::table& table) {
  std::vector<Entry> entries;
  for (const auto& [key, value] : table) entries.push_back({&key, &value});
  std::ranges::stable_sort(entries, {}, [](const Entry& e) {
    const toml::source_region& place = e.key->source();
    return std::tuple(is_override(place), place.begin.line, place.begin.column);
  });
  return entries;
}

void check_known(const toml::table& table, const std::string& where, std::span<const std::string_view> allowed) {
  for (const Entry& entry : entries_in_order(table)) {
    const std::string_view key = entry.key->str();
    if (std::ranges::find(allowed, key) == allowed.end())
      fail(entry.key->source(), "unknown key " + toml_string(key) + " in " + where + "; the nearest known key is " +
                                    toml_string(nearest(key, allowed)) + " (allowed: " + joined(allowed) + ")");
  }
}

const toml::node& required(const toml::table& table, const std::string& where, std::string_view key) {
  const toml::node* node = table.get(key);
  if (!node) fail(table.source(), where + " has no " + toml_string(key) + ", which must be there");
  return *node;
}

}  // namespace glimt
