#include "mesh/mesh_file.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cerrno>
#include <fstream>
#include <map>
#include <mutex>
#include <system_error>
#include <tuple>

namespace glimt {
namespace fs = std::filesystem;
namespace {

constexpr std::uintmax_t most_bytes = std::uintmax_t{1} << 32;

std::string ending(const fs::path& file) {
  std::string text = file.extension().string();
  std::ranges::transform(text, text.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return text;
}

MeshData read(const fs::path& file) {
  const std::string kind = ending(file);
  if (!is_mesh_file(file))
    throw MeshFileError(file.string() + ": is no mesh by its ending; allowed are .obj, .ply, .gltf and .glb");
  std::string bytes = read_mesh_bytes(file);
  if (kind == ".obj") return read_obj(std::move(bytes), file);
  if (kind == ".ply") return read_ply(bytes, file);
  return read_gltf(bytes, file);
}

/// Which state of which file.
struct FileState {
  fs::path file;
  std::uintmax_t size = 0;
  fs::file_time_type changed;

  auto key() const { return std::tie(file, size, changed); }
  bool operator<(const FileState& other) const { return key() < other.key(); }
};

FileState state_of(const fs::path& file) {
  std::error_code error;
  FileState state{fs::absolute(file, error), fs::file_size(file, error), {}};
  state.changed = fs::last_write_time(file, error);
  return state;
}

}  // namespace

bool is_mesh_file(const fs::path& file) {
  constexpr std::array<std::string_view, 4> endings{".obj", ".ply", ".gltf", ".glb"};
  return std::ranges::find(endings, ending(file)) != endings.end();
}

std::string read_mesh_bytes(const fs::path& file) {
  const auto fail = [&](const std::string& why) { throw MeshFileError(file.string() + ": cannot be read: " + why); };
  std::error_code error;
  const fs::file_status status = fs::status(file, error);
  if (!fs::exists(status)) fail(std::generic_category().message(ENOENT));
  if (!fs::is_regular_file(status)) fail(fs::is_directory(status) ? "it is a folder" : "it is no regular file");
  const std::uintmax_t size = fs::file_size(file, error);
  if (error) fail(error.message());
  if (size > most_bytes) fail("it is larger than 4 GiB");
  errno = 0;
  std::ifstream stream(file, std::ios::binary);
  std::string bytes(size, '\0');
  stream.read(bytes.data(), static_cast<std::streamsize>(size));
  if (!stream) fail(std::generic_category().message(errno ? errno : EIO));
  return bytes;
}

std::shared_ptr<const MeshData> load_mesh(const fs::path& file) {
  static std::mutex mutex;
  static std::map<FileState, std::weak_ptr<const MeshData>> in_use;
  const FileState state = state_of(file);
  const std::lock_guard lock(mutex);
  std::erase_if(in_use, [](const auto& entry) { return entry.second.expired(); });
  if (const auto known = in_use.find(state); known != in_use.end())
    if (auto data = known->second.lock()) return data;
  auto data = std::make_shared<const MeshData>(read(file));
  in_use[state] = data;
  return data;
}

}  // namespace glimt
