#pragma once

#include <span>
#include <string>
#include <string_view>

/// Small pieces of text that scene files and messages about them are made of.
namespace glimt {

/// The shortest TOML number that reads back to exactly `value`; whole numbers plainly ("20").
std::string number_text(double value);

/// `text` as a TOML string in double quotes, on one line.
std::string toml_string(std::string_view text);

/// `text` as a TOML key: bare where that is possible, otherwise quoted.
std::string key_text(std::string_view text);

/// "0 to 1", "more than 0 and at most 10".
std::string range_text(double min, double max, bool min_excluded);

/// The words with ", " between them.
std::string joined(std::span<const std::string_view> words);

/// The word of `known` with the least edit distance to `word`, the first of them; empty where `known` is.
std::string_view nearest(std::string_view word, std::span<const std::string_view> known);

}  // namespace glimt
