#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <string_view>

/// Reads and writes whole files. The name "-" writes to standard output. Errors are ImageFileError (image_file.h) with
/// a message that names the file.
namespace glimt {

/// Throws where `file` cannot be created or replaced; leaves no trace.
void check_replaceable(const std::filesystem::path& file);

/// Writes the pieces one after the other to a temporary file in the same folder, and renames it once it is on the disk.
/// So `file` is complete, or unchanged where this throws or the program is killed. Follows symbolic links.
void replace_file(const std::filesystem::path& file, std::span<const std::string_view> pieces);
void replace_file(const std::filesystem::path& file, std::string_view bytes);

/// Removes the temporary files of programs that were killed while they wrote `file`.
void remove_unfinished(const std::filesystem::path& file);

std::string read_file(const std::filesystem::path& file);

}  // namespace glimt
