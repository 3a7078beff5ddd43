#include "render/limits.h"

#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <exception>
#include <fstream>
#include <latch>
#include <limits>
#include <optional>
#include <sstream>
#include <string>
#include <string_view>
#include <thread>
#include <vector>

#include "film/film.h"

namespace glimt {
namespace fs = std::filesystem;
namespace {

constexpr std::uint64_t unlimited = std::numeric_limits<std::uint64_t>::max();

/// The number in a file; none where the file says "max".
std::optional<std::uint64_t> number_in(const fs::path& file) {
  std::ifstream stream(file);
  std::uint64_t number = 0;
  return stream >> number ? std::optional(number) : std::nullopt;
}

/// The number after these words at the beginning of a line, as in "MemAvailable:  1234 kB".
std::optional<std::uint64_t> number_after(const fs::path& file, std::string_view words) {
  std::ifstream stream(file);
  for (std::string line; std::getline(stream, line);) {
    std::uint64_t number = 0;
    if (line.starts_with(words) && std::istringstream(line.substr(words.size())) >> number) return number;
  }
  return std::nullopt;
}

std::uint64_t rest(std::uint64_t limit, std::uint64_t used) { return limit - std::min(limit, used); }

/// Names of files in one version of control groups.
struct GroupFiles {
  const char *limit, *used;
  const char* cache;  ///< line of memory.stat: file pages that the system can drop
};

/// The least that is left in a group and in all groups above it, up to the mount point.
std::uint64_t left_in_groups(const fs::path& mount, const std::string& group, const GroupFiles& files) {
  std::uint64_t left = unlimited;
  for (fs::path path = fs::path(group).relative_path();; path = path.parent_path()) {
    const fs::path folder = mount / path;
    const auto limit = number_in(folder / files.limit), used = number_in(folder / files.used);
    if (limit && used) {
      const std::uint64_t cache = number_after(folder / "memory.stat", files.cache).value_or(0);
      left = std::min(left, rest(*limit, rest(*used, cache)));
    }
    if (path.empty()) return left;
  }
}

/// The least that is left in all groups of this program. Lines of /proc/self/cgroup are "0::/group" (version 2) and
/// "4:memory:/group" (version 1).
std::uint64_t left_in_groups(const fs::path& root) {
  constexpr GroupFiles version1{"memory.limit_in_bytes", "memory.usage_in_bytes", "total_inactive_file"};
  constexpr GroupFiles version2{"memory.max", "memory.current", "inactive_file"};
  const fs::path mounts = root / "sys/fs/cgroup";
  std::uint64_t left = unlimited;
  std::ifstream stream(root / "proc/self/cgroup");
  for (std::string line; std::getline(stream, line);) {
    const std::size_t controllers = line.find(':'), group = line.find(':', controllers + 1);
    if (group == line.npos) continue;
    const std::string kind = line.substr(controllers, group - controllers), path = line.substr(group + 1);
    if (kind == ":") left = std::min(left, left_in_groups(mounts, path, version2));
    if (kind == ":memory") left = std::min(left, left_in_groups(mounts / "memory", path, version1));
  }
  return left;
}

std::uint64_t left_of_address_space(const fs::path& root) {
  const auto limit = number_after(root / "proc/self/limits", "Max address space");  // none where it is "unlimited"
  const auto pages = number_in(root / "proc/self/statm");
  return limit && pages ? rest(*limit, *pages * static_cast<std::uint64_t>(sysconf(_SC_PAGESIZE))) : unlimited;
}

}  // namespace

std::uint64_t free_memory(const fs::path& root) {
  const auto machine = number_after(root / "proc/meminfo", "MemAvailable:");
  return std::min({machine ? *machine * 1024 : unlimited, left_in_groups(root), left_of_address_space(root)});
}

std::string memory_obstacle(const ImageSize& image, std::uint64_t beside_film) {
  const std::uint64_t pixels = static_cast<std::uint64_t>(image.width) * static_cast<std::uint64_t>(image.height);
  const std::uint64_t needed = Film::pixel_bytes * pixels + beside_film, free = free_memory();
  if (needed <= free) return {};
  char text[128];
  std::snprintf(text, sizeof text, "an image of %dx%d takes %.2f GB of memory, and %.2f GB are free", image.width,
                image.height, static_cast<double>(needed) / 1e9, static_cast<double>(free) / 1e9);
  return text;
}

int startable_threads(int wanted) {
  std::latch end(1);
  std::vector<std::jthread> threads;
  try {
    while (static_cast<int>(threads.size()) + 1 < wanted) threads.emplace_back([&end] { end.wait(); });
  } catch (const std::exception&) {  // no further thread, or no memory for its stack
  }
  end.count_down();
  return static_cast<int>(threads.size()) + 1;
}

}  // namespace glimt
