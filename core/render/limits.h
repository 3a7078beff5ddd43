#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

#include "scene/scene.h"

/// The machine's limits, so that a render which exceeds them can be refused before it begins.
namespace glimt {

/// Bytes that this program can still take. It is the least of what is left of the machine's memory, of the program's
/// control group (cgroup, version 1 or 2) and the groups above it, and of its address space. The largest number where
/// nothing is known. `root` is where the system's files are.
std::uint64_t free_memory(const std::filesystem::path& root = "/");

/// Why the film of such an image, and so many bytes beside it, do not fit into free_memory(), for people; empty where
/// they do. The system would hand the memory out, and end the program when it writes to it, an hour later at worst.
std::string memory_obstacle(const ImageSize& image, std::uint64_t beside_film);

/// How many of so many threads can run at once. Starts them and ends them again, some microseconds for each.
int startable_threads(int wanted);

}  // namespace glimt
