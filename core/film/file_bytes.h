#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <string_view>

/// Whole files at once. The name "-" writes to standard output. All throw ImageFileError (image_file.h) with a message
/// that names the file.
namespace glimt {

/// Throws where `file` cannot be created or replaced; leaves no trace.
void check_replaceable(const std::filesystem::path& file);

/// Writes the pieces, one after the other, to a temporary file in the same folder. When it is on the disk, renames it.
/// So `file` is whole, or untouched where this throws or the program is killed. Follows symbolic links.
void replace_file(const std::filesystem::path& file, std::span<const std::string_view> pieces);
void replace_file(const std::filesystem::path& file, std::string_view bytes);

/// Removes the temporary files of programs that were killed while they wrote `file`.
void remove_unfinished(const std::filesystem::path& file);

std::string read_file(const std::filesystem::path& file);

}  // namespace glimt
