#include "unit/fuzz/targets.h"

#include <sys/stat.h>
#include <unistd.h>
#include <zlib.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "film/checkpoint.h"
#include "film/image_file.h"
#include "render/render.h"
#include "scene/file/scene_file.h"

namespace glimt::fuzz {
namespace {

[[noreturn]] void wrong(const char* what) {
  std::fprintf(stderr, "wrong: %s\n", what);
  std::abort();
}

/// A file of these bytes, as long as it lives.
class ScratchFile {
 public:
  ScratchFile(std::string_view bytes, const char* ending)
      : path(std::filesystem::temp_directory_path() / ("glimt_fuzz_" + std::to_string(getpid()) + ending)) {
    std::ofstream(path, std::ios::binary).write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  }
  ~ScratchFile() { std::filesystem::remove(path); }
  ScratchFile(const ScratchFile&) = delete;
  ScratchFile& operator=(const ScratchFile&) = delete;

  const std::filesystem::path path;
};

void render_one_sample(Scene scene) {
  scene.image = {6, 5};
  scene.render.shadow_rays = std::min(scene.render.shadow_rays, 2);
  CompiledScene compiled;
  try {
    compiled = compile(scene);
  } catch (const SceneError&) {
    return;
  }
  Film film = make_film(compiled);
  render_pass(compiled, film, 1, {.threads = 1});
  if (film.invalid() > 0) wrong("a sample is not finite");
}

void use(const Scene& scene) {
  const std::string text = write_scene(scene);
  if (parse_scene(text, "written.toml") != scene) wrong("a scene that is written and read back is another");
  render_one_sample(scene);
}

constexpr std::string_view with_everything = R"(
name = "everything"
[camera]
eye = [0, 0, 5]
look_at = [0, 0, 0]
up = [0, 1, 0]
fov_y = 45
[image]
width = 6
height = 5
[render]
spp = 1
[material.white]
type = "lambertian"
reflectance = [0.5, 0.5, 0.5]
[material.clay]
type = "oren-nayar"
reflectance = [0.5, 0.5, 0.5]
roughness = 0.6
[material.gold]
type = "conductor"
preset = "gold"
roughness = 0.3
[material.glass]
type = "glass"
ior = 1.5
[material.lamp]
type = "light"
radiance = [10, 10, 10]
[[sphere]]
name = "ball"
center = [0, 0, 0]
radius = 1
material = "glass"
[[sphere]]
name = "bulb"
center = [2, 2, 0]
radius = 0.5
material = "lamp"
[[polygon]]
name = "floor"
material = "clay"
vertices = [[-3, -2, 3], [3, -2, 3], [3, -2, -3], [-3, -2, -3]]
[[mesh]]
name = "block"
material = "gold"
vertices = [[2, 0, 0], [3, 0, 0], [2, 1, 0], [2, 0, 1]]
triangles = [[0, 2, 1], [0, 3, 2], [0, 1, 3], [1, 2, 3]]
)";

/// Where a checkpoint has its checksum: behind the signature and the format, over all that follows.
constexpr std::size_t checksum_at = 12;

}  // namespace

void scene(std::string_view bytes) {
  try {
    use(parse_scene(bytes, "fuzzed.toml"));
  } catch (const SceneError&) {
  }
}

void overrides(std::string_view bytes) {
  std::vector<std::string> lines(1);
  for (const char c : bytes) {
    if (c == '\n')
      lines.emplace_back();
    else
      lines.back() += c;
  }
  try {
    use(parse_scene(with_everything, "everything.toml", lines));
  } catch (const SceneError&) {
  }
}

void image(std::string_view bytes) {
  for (const char* ending : {".exr", ".pfm", ".png"}) {
    const ScratchFile file(bytes, ending);
    try {
      const Image image = read_image(file.path);
      if (image.rgb.size() !=
          std::size_t{3} * static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height))
        wrong("an image has another size than it says");
    } catch (const ImageFileError&) {
    }
    try {
      read_metadata(file.path);
    } catch (const ImageFileError&) {
    }
  }
}

void checkpoint(std::string_view bytes) {
  std::string text(bytes);
  if (text.size() >= checksum_at + 4) {
    const auto* const rest = reinterpret_cast<const Bytef*>(text.data() + checksum_at + 4);
    const auto sum = static_cast<std::uint32_t>(crc32_z(0, rest, text.size() - checksum_at - 4));
    std::memcpy(text.data() + checksum_at, &sum, sizeof sum);
  }
  const ScratchFile file(text, ".ckpt");
  try {
    const Checkpoint checkpoint = read_checkpoint(file.path);
    if (checkpoint.film.samples() < 0) wrong("a film has fewer samples than none");
  } catch (const CheckpointError&) {
  }
}

std::span<const Target> targets() {
  static constexpr std::array all{Target{"scene", scene}, Target{"overrides", overrides}, Target{"image", image},
                                  Target{"checkpoint", checkpoint}};
  return all;
}

}  // namespace glimt::fuzz
