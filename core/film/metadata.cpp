#include "film/metadata.h"

#include "scene/file/scene_change.h"
#include "scene/file/scene_file.h"
#include "scene/file/text.h"

namespace glimt {

Metadata render_metadata(const Scene& scene, int samples, double seconds) {
  Scene rendered = scene;
  rendered.render.spp = samples;
  rendered.render.target_error = 0;
  Metadata metadata{{"scene", write_scene(rendered)},
                    {"samples", std::to_string(samples)},
                    {"seconds", number_text(seconds)},
                    {"version", GLIMT_VERSION}};
  for (const auto& field : settings_fields()) metadata[std::string(field.key)] = setting_text(rendered.render, field);
  return metadata;
}

Metadata render_metadata(const Scene& scene, const Film& film, double seconds) {
  Metadata metadata = render_metadata(scene, film.samples(), seconds);
  metadata["sample_ranges"] = ranges_text(film.ranges());
  return metadata;
}

}  // namespace glimt
