#pragma once

#include <cstdint>
#include <filesystem>

/// What a render may take, so that it can be refused before it begins.
namespace glimt {

/// Bytes that this program can still take: what the machine has left, or the program's control group (cgroup, version 1
/// or 2), one above it, or the limit of its address space, whichever is least. The largest number where nothing is
/// known. `root` is where the system's files are.
std::uint64_t free_memory(const std::filesystem::path& root = "/");

/// How many of so many threads can run at once. Starts them and ends them again, some microseconds for each.
int startable_threads(int wanted);

}  // namespace glimt
