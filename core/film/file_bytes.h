#pragma once

#include <filesystem>
#include <string>
#include <string_view>

/// Whole files at once. The name "-" writes to standard output. All throw ImageFileError (image_file.h) with a message
/// that names the file.
namespace glimt {

/// Throws where `file` cannot be created or replaced; leaves no trace.
void check_replaceable(const std::filesystem::path& file);

/// Writes a temporary file in the same folder and renames it, so that `file` is whole, or untouched where this throws.
/// Follows symbolic links.
void replace_file(const std::filesystem::path& file, std::string_view bytes);

std::string read_file(const std::filesystem::path& file);

}  // namespace glimt
