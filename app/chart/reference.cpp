#include "chart/reference.h"

#include <stdexcept>

#include "film/image_file.h"
#include "film/statistics.h"
#include "scene/file/scene_file.h"

namespace glimt {

bool same_picture(const Scene& a, const Scene& b) {
  Scene same = a;
  same.render = b.render;
  same.name = b.name;
  return same == b;
}

Image read_reference(const std::filesystem::path& file, const Scene& scene) {
  Image reference = read_image(file);
  Image black{scene.image.width, scene.image.height, {}};
  black.rgb.resize(3 * static_cast<std::size_t>(black.width) * static_cast<std::size_t>(black.height));
  try {
    compare(black, reference);
  } catch (const std::invalid_argument& error) {
    throw std::runtime_error(file.string() + " cannot be the reference: " + error.what());
  }
  const Metadata metadata = file.extension() == ".exr" ? read_metadata(file) : Metadata{};
  if (const auto text = metadata.find("scene"); text != metadata.end()) {
    // Files hold rounded numbers, so the scene goes through its file's text too.
    if (!same_picture(parse_scene(text->second, file.string()), parse_scene(write_scene(scene), file.string())))
      throw std::runtime_error(file.string() +
                               " is of another scene: what it was rendered from differs in more than settings");
  }
  return reference;
}

}  // namespace glimt
