#pragma once

#include <cstdint>
#include <filesystem>

/// The machine's limits, so that a render which exceeds them can be refused before it begins.
namespace glimt {

/// Bytes that this program can still take. It is the least of what is left of the machine's memory, of the program's
/// control group (cgroup, version 1 or 2) and the groups above it, and of its address space. The largest number where
/// nothing is known. `root` is where the system's files are.
std::uint64_t free_memory(const std::filesystem::path& root = "/");

/// How many of `wanted` threads can run at once. Starts them and ends them again, which takes some microseconds each.
int startable_threads(int wanted);

}  // namespace glimt
