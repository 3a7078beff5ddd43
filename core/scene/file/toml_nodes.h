#pragma once

#include <toml++/toml.h>
#include <glm/vec3.hpp>
#include <span>
#include <string>
#include <string_view>
#include <vector>

/// What reading a scene needs of TOML: typed values, or a SceneError that names the place.
namespace glimt {

/// Nodes that an override put into the tree have this and the override's text as their source's path; all others have
/// the file's name.
inline constexpr std::string_view override_prefix = "--set ";

bool is_override(const toml::source_region& place);

/// Throws SceneError with the place in front, on one line.
[[noreturn]] void fail(const toml::source_region& place, const std::string& message);

// Each of these takes the value's key for the message.
const toml::table& as_table(const toml::node& node, const std::string& key);
const toml::array& as_array(const toml::node& node, const std::string& key, std::string_view of);
std::string as_string(const toml::node& node, const std::string& key);
bool as_boolean(const toml::node& node, const std::string& key);
double as_number(const toml::node& node, const std::string& key);
/// Within [min, max].
int as_integer(const toml::node& node, const std::string& key, int min, int max);
glm::dvec3 as_vector(const toml::node& node, const std::string& key);
/// The place of the value among `names`.
int as_choice(const toml::node& node, const std::string& key, std::span<const std::string_view> names);

/// Throws for the first key of the table, in the order of the text, that is not among `allowed`. `where` is what the
/// table is called:
/// "[camera]".
void check_known(const toml::table& table, const std::string& where, std::span<const std::string_view> allowed);

/// The value of a key that must be there.
const toml::node& required(const toml::table& table, const std::string& where, std::string_view key);

/// The table's entries in the order of the text, those of overrides last.
struct Entry {
  const toml::key* key;
  const toml::node* value;
};
std::vector<Entry> entries_in_order(const toml::table& table);

}  // namespace glimt
