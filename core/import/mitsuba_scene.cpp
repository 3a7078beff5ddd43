#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>
#include <numbers>

#include "import/mitsuba_parts.h"
#include "scene/fields.h"
#include "scene/surroundings.h"

namespace glimt {
namespace {

using glm::dvec3;

constexpr int most_pixels_across = 16384;

/// The vertical field of view, degrees.
double vertical_fov(MitsubaImport& in, pugi::xml_node sensor, const ImageSize& image) {
  const double aspect = static_cast<double>(image.width) / image.height;
  double fov = in.file.number(sensor, "fov", 0);
  if (!in.file.property(sensor, "fov")) {
    const std::string text = in.file.text(sensor, "focal_length", "50mm");
    // On film of 36 x 24 mm, across its diagonal.
    const double focal = std::max(std::atof(text.c_str()), 1e-3);
    const double diagonal = std::hypot(36.0, 24.0) / (2 * focal);
    return 2 * std::atan(diagonal / std::sqrt(1 + aspect * aspect)) * 180 / std::numbers::pi;
  }
  std::string axis = in.file.text(sensor, "fov_axis", "x");
  if (axis == "smaller") axis = aspect < 1 ? "x" : "y";
  if (axis == "larger") axis = aspect < 1 ? "y" : "x";
  if (axis != "x" && axis != "y" && axis != "diagonal")
    in.file.fail(in.file.property(sensor, "fov_axis"), "is no axis; allowed are x, y, diagonal, smaller and larger");
  fov = std::clamp(fov, 0.001, 179.0);
  const double half = std::tan(0.5 * fov * std::numbers::pi / 180);
  const double half_y = axis == "y" ? half : axis == "x" ? half / aspect : half / std::sqrt(1 + aspect * aspect);
  return 2 * std::atan(half_y) * 180 / std::numbers::pi;
}

void import_film(MitsubaImport& in, pugi::xml_node film) {
  ImageSize& image = in.scene().image;
  image.width = std::clamp(in.file.integer(film, "width", 768), 1, most_pixels_across);
  image.height = std::clamp(in.file.integer(film, "height", 576), 1, most_pixels_across);
  if (in.file.property(film, "crop_width")) in.note(film, "a crop of the film", "the whole film");
  for (const pugi::xml_node child : film.children("rfilter"))
    if (const std::string type = in.file.attribute(child, "type"); type != "box")
      in.note(child, "rfilter " + type, "box");
}

void import_integrator(MitsubaImport& in, pugi::xml_node integrator) {
  const std::string type = in.file.attribute(integrator, "type");
  if (type != "path") in.note(integrator, "integrator " + type, "path");
  if (type == "direct") in.scene().render.max_depth = 2;
  const int depth = in.file.integer(integrator, "max_depth", -1);
  if (depth > 0) in.scene().render.max_depth = std::min(depth, 1000);
  if (depth == 0) in.note(integrator, "max_depth 0, a black picture", "paths of any length");
}

void import_object(MitsubaImport& in, pugi::xml_node node, bool& has_sensor) {
  const std::string kind = node.name(), type = in.file.attribute(node, "type");
  if (kind == "shape") {
    import_shape(in, node);
  } else if (kind == "sensor") {
    if (has_sensor) return in.note(node, "another sensor", "the first one");
    has_sensor = true;
    import_sensor(in, node);
  } else if (kind == "integrator") {
    import_integrator(in, node);
  } else if (kind == "emitter") {
    in.note(node, "emitter " + type, "nothing");
  } else if (kind != "bsdf" && kind != "texture" && kind != "rgb" && kind != "spectrum") {
    in.note(node, kind + (type.empty() ? "" : " " + type), "nothing");
  }
}

}  // namespace

void import_sensor(MitsubaImport& in, pugi::xml_node sensor) {
  in.scene().image = {768, 576};
  for (const pugi::xml_node child : sensor.children()) {
    const pugi::xml_node node = in.file.resolved(child);
    if (std::string_view(node.name()) == "film") import_film(in, node);
    if (std::string_view(node.name()) == "sampler")
      in.scene().render.spp = std::clamp(in.file.integer(node, "sample_count", 16), 1, max_spp);
  }
  const std::string type = in.file.attribute(sensor, "type");
  if (type != "perspective") in.note(sensor, "sensor " + type, "perspective");
  const glm::dmat4 to_world = in.file.transform(sensor, "to_world");
  if (determinant(glm::dmat3(to_world)) < 0) in.note(sensor, "a sensor that mirrors its picture", "one that does not");
  // It looks along its z, y up.
  const dvec3 eye(to_world[3]), along(to_world[2]), up(to_world[1]);
  in.scene().camera = {.eye = eye,
                       .look_at = eye + along,
                       .up = length(up) > 0 ? normalize(up) : up,
                       .fov_y = std::clamp(vertical_fov(in, sensor, in.scene().image), 0.001, 179.0)};
}

ImportedScene import_mitsuba(const std::filesystem::path& path) {
  const MitsubaFile file(path);
  MitsubaImport in{file};
  in.scene().name = path.stem().string();
  bool has_sensor = false;
  file.for_each([&](pugi::xml_node node) { import_object(in, node, has_sensor); });
  if (!has_sensor) in.scene().camera = framing(box_of(in.scene()));
  const bool lit = std::ranges::any_of(in.scene().materials, [](const Material& m) { return is_lamp(m); });
  const bool holds_something = box_of(in.scene()).size() >= 0;
  if (!lit && holds_something && std::isfinite(box_of(in.scene()).size())) {
    add_lit_room(in.scene());
    in.result.notes.push_back({path.filename().string(), "a scene without an area light", "a lit room around it"});
  }
  return std::move(in.result);
}

}  // namespace glimt
