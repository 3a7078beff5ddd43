#include "film/file_bytes.h"

#include <sys/stat.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <cstdio>
#include <memory>
#include <system_error>
#include <utility>

#include "film/image_file.h"

namespace glimt {
namespace fs = std::filesystem;
namespace {

[[noreturn]] void fail(const fs::path& file, const std::string& what) {
  throw ImageFileError(file.string() + ": " + what);
}

std::string reason(int error) { return std::generic_category().message(error); }

/// The beginning of the names of all temporary files of `target`. A file name may have 255 bytes.
std::string temporary_prefix(const fs::path& target) {
  return "." + target.filename().string().substr(0, 200) + ".glimt-";
}

constexpr std::string_view temporary_ending = ".tmp";

/// A new empty file that is removed with this object unless it was renamed.
class TemporaryFile {
 public:
  explicit TemporaryFile(const fs::path& target) : target_(target) {
    static std::atomic<unsigned> count{0};
    do {
      path_ = target;
      path_.replace_filename(temporary_prefix(target) + std::to_string(getpid()) + "-" + std::to_string(count++) +
                             std::string(temporary_ending));
      stream_ = std::fopen(path_.c_str(), "wbx");
    } while (!stream_ && errno == EEXIST);
    if (!stream_) fail(target_, "cannot write in its folder: " + reason(errno));
  }
  ~TemporaryFile() {
    if (stream_) std::fclose(stream_);
    if (!renamed_) std::remove(path_.c_str());
  }
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;

  void write(std::string_view bytes) {
    if (std::fwrite(bytes.data(), 1, bytes.size(), stream_) != bytes.size())
      fail(target_, "cannot be written: " + reason(errno));
  }
  void rename_to_target() {
    if (std::fflush(stream_) != 0 || fsync(fileno(stream_)) != 0) fail(target_, "cannot be written: " + reason(errno));
    if (std::fclose(std::exchange(stream_, nullptr)) != 0) fail(target_, "cannot be written: " + reason(errno));
    if (std::rename(path_.c_str(), target_.c_str()) != 0) fail(target_, "cannot be replaced: " + reason(errno));
    renamed_ = true;
  }

 private:
  fs::path target_, path_;
  std::FILE* stream_ = nullptr;
  bool renamed_ = false;
};

/// Whether this program prints into the file: `--stats /dev/stdout > log` would replace the log.
bool takes_messages(const fs::path& file) {
  struct stat messages {
  }, wanted{};
  if (stat(file.c_str(), &wanted) != 0) return false;
  for (const int stream : {STDOUT_FILENO, STDERR_FILENO})
    if (fstat(stream, &messages) == 0 && messages.st_dev == wanted.st_dev && messages.st_ino == wanted.st_ino)
      return true;
  return false;
}

/// The file that symbolic links lead to.
fs::path resolved(const fs::path& file) {
  std::error_code error;
  const fs::path target = fs::weakly_canonical(fs::absolute(file, error), error);
  return error ? file : target;
}

}  // namespace

void check_replaceable(const fs::path& file) {
  if (file == "-") return;
  const fs::path target = resolved(file);
  if (!target.has_filename()) fail(file, "names no file");
  std::error_code error;
  const fs::file_status folder = fs::status(target.parent_path(), error);
  if (!fs::exists(folder)) fail(file, "the folder " + target.parent_path().string() + " does not exist");
  if (!fs::is_directory(folder)) fail(file, target.parent_path().string() + " is not a folder");

  const fs::file_status status = fs::status(target, error);
  if (status.type() == fs::file_type::none) fail(file, "cannot be written: " + error.message());
  if (fs::is_directory(status)) fail(file, "is a folder; the name of a file is needed");
  if (fs::exists(status) && !fs::is_regular_file(status)) fail(file, "is not a regular file and cannot be replaced");
  if (takes_messages(target)) fail(file, "takes this program's messages and cannot be replaced");
  if (fs::exists(status) && access(target.c_str(), W_OK) != 0) fail(file, "is write-protected");
  TemporaryFile trial(target);
}

void replace_file(const fs::path& file, std::span<const std::string_view> pieces) {
  if (file == "-") {
    for (const std::string_view bytes : pieces)
      if (std::fwrite(bytes.data(), 1, bytes.size(), stdout) != bytes.size() || std::fflush(stdout) != 0)
        fail("standard output", "cannot be written: " + reason(errno));
    return;
  }
  check_replaceable(file);
  TemporaryFile temporary(resolved(file));
  for (const std::string_view bytes : pieces) temporary.write(bytes);
  temporary.rename_to_target();
}

void replace_file(const fs::path& file, std::string_view bytes) { replace_file(file, std::span(&bytes, 1)); }

void remove_unfinished(const fs::path& file) {
  const fs::path target = resolved(file);
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(target.parent_path(), error)) {
    const std::string name = entry.path().filename().string();
    if (name.starts_with(temporary_prefix(target)) && name.ends_with(temporary_ending)) fs::remove(entry.path(), error);
  }
}

std::string read_file(const fs::path& file) {
  std::error_code error;
  if (fs::is_directory(file, error)) fail(file, "is a folder; the name of a file is needed");
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> stream(std::fopen(file.c_str(), "rb"), &std::fclose);
  if (!stream) fail(file, "cannot be read: " + reason(errno));
  std::string bytes;
  char buffer[1 << 16];
  while (const std::size_t count = std::fread(buffer, 1, sizeof buffer, stream.get())) bytes.append(buffer, count);
  if (std::ferror(stream.get())) fail(file, "cannot be read: " + reason(errno));
  return bytes;
}

}  // namespace glimt
