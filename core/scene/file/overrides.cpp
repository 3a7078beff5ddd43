#include "scene/file/overrides.h"

#include <algorithm>
#include <charconv>
#include <memory>
#include <optional>
#include <vector>

#include "scene/file/text.h"
#include "scene/file/toml_nodes.h"

namespace glimt {
namespace {

/// Where `wanted` first is outside quotes.
std::size_t find_unquoted(std::string_view text, std::string_view wanted) {
  char quote = 0;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (quote) {
      if (c == '\\' && quote == '"')
        ++i;
      else if (c == quote)
        quote = 0;
    } else if (wanted.find(c) != std::string_view::npos) {
      return i;
    } else if (c == '"' || c == '\'') {
      quote = c;
    }
  }
  return std::string_view::npos;
}

std::string_view trimmed(std::string_view text) {
  const std::size_t first = text.find_first_not_of(" \t"), last = text.find_last_not_of(" \t");
  return first == std::string_view::npos ? std::string_view{} : text.substr(first, last - first + 1);
}

/// The path as a dotted TOML key: "sphere[2].wall 1" -> sphere."[2]"."wall 1".
std::string dotted_key(std::string_view path) {
  std::string key;
  const auto add = [&](const std::string& part) { key += (key.empty() ? "" : ".") + part; };
  while (true) {
    const std::size_t end = std::min(find_unquoted(path, ".["), path.size());
    const std::string_view part = trimmed(path.substr(0, end));
    add(part.starts_with('"') || part.starts_with('\'') ? std::string(part) : key_text(part));
    path.remove_prefix(end);
    while (path.starts_with('[')) {
      const std::size_t length = std::min(path.find(']'), path.size() - 1) + 1;
      add(key_text(path.substr(0, length)));
      path.remove_prefix(length);
    }
    if (path.empty()) return key;
    if (path.starts_with('.')) path.remove_prefix(1);
  }
}

std::optional<std::size_t> index_of(const toml::array& array, std::string_view key) {
  const bool bracketed = key.size() > 2 && key.starts_with('[') && key.ends_with(']');
  if (!bracketed)
    for (std::size_t i = 0; i < array.size(); ++i)
      if (const toml::table* table = array[i].as_table())
        if (const auto* name = table->get_as<std::string>("name"); name && name->get() == key) return i;
  if (bracketed) key = key.substr(1, key.size() - 2);
  std::size_t index = 0;
  const auto [end, error] = std::from_chars(key.data(), key.data() + key.size(), index);
  if (error != std::errc{} || end != key.data() + key.size() || index >= array.size()) return std::nullopt;
  return index;
}

template <class Node>
Node* child(Node& node, std::string_view key) {
  if (auto* table = node.as_table()) return table->get(key);
  auto* array = node.as_array();
  const auto index = array ? index_of(*array, key) : std::nullopt;
  return index ? array->get(*index) : nullptr;
}

[[noreturn]] void no_such_element(const toml::array& array, const toml::key& key) {
  std::string message = "there is no element " + toml_string(key.str());
  if (array.empty()) fail(key.source(), message + "; the array is empty");
  std::vector<std::string_view> names;
  for (const toml::node& node : array)
    if (const toml::table* table = node.as_table())
      if (const auto* name = table->get_as<std::string>("name")) names.push_back(name->get());
  if (!names.empty()) message += "; the nearest is " + toml_string(nearest(key.str(), names));
  names.push_back("0 to ");
  fail(key.source(), message + " (allowed: " + joined(names) + std::to_string(array.size() - 1) + ")");
}

void merge(toml::node& target, toml::table& patch) {
  for (auto&& entry : patch) {
    const toml::key& key = entry.first;
    toml::node& value = entry.second;
    toml::node* old = child(target, key.str());
    if (old && value.is_table() && (old->is_table() || old->is_array())) {
      merge(*old, *value.as_table());
    } else if (toml::array* array = target.as_array()) {
      const auto index = index_of(*array, key.str());
      if (!index) no_such_element(*array, key);
      value.visit(
          [&](auto& v) { array->replace(array->cbegin() + static_cast<std::ptrdiff_t>(*index), std::move(v)); });
    } else {
      value.visit([&](auto& v) { target.as_table()->insert_or_assign(key, std::move(v)); });
    }
  }
}

toml::table parse_override(const std::string& text) {
  const auto source = std::make_shared<const std::string>(std::string(override_prefix) + text);
  const std::size_t equals = find_unquoted(text, "=");
  if (equals == std::string::npos)
    fail({.begin = {}, .end = {}, .path = source}, "there is no \"=\"; allowed is PATH=VALUE");
  const std::string key = dotted_key(std::string_view(text).substr(0, equals));
  const std::string_view value = trimmed(std::string_view(text).substr(equals + 1));
  try {
    return toml::parse(key + " = " + std::string(value), *source);
  } catch (const toml::parse_error& error) {
    // Words are strings. What begins like another kind of value is a mistake in that.
    if (!value.empty() && std::string_view("\"'[{+-.0123456789").find(value.front()) == std::string_view::npos) try {
        return toml::parse(key + " = " + toml_string(value), *source);
      } catch (const toml::parse_error&) {
      }
    fail(error.source(), std::string(error.description()) + "; allowed is PATH=VALUE with VALUE as in a scene file");
  }
}

}  // namespace

void apply_override(toml::table& root, const std::string& text) {
  toml::table patch = parse_override(text);
  merge(root, patch);
}

toml::source_region locate(const toml::table& root, const std::string& path) {
  const toml::table keys = toml::parse(dotted_key(path) + " = 0", path);
  const toml::node* node = &root;
  for (const toml::table* step = &keys; step;) {
    const auto entry = step->begin();
    const toml::node* next = child(*node, entry->first.str());
    if (!next) break;
    node = next;
    step = entry->second.as_table();
  }
  return node->source();
}

}  // namespace glimt
