#include "film/metadata.h"

#include "scene/fields.h"
#include "scene/file/scene_file.h"
#include "scene/file/text.h"

namespace glimt {
namespace {

struct ValueText {
  const Settings& settings;

  std::string operator()(const Choice<Settings>& choice) const {
    return std::string(choice.names[static_cast<std::size_t>(choice.get(settings))]);
  }
  std::string operator()(const Value<Settings, glm::dvec3>& vector) const {
    const glm::dvec3 v = vector.get(settings);
    std::string text = "[";
    for (int c = 0; c < 3; ++c) text += number_text(v[c]) + (c < 2 ? ", " : "]");
    return text;
  }
  template <class T>
  std::string operator()(const Value<Settings, T>& number) const {
    return number_text(number.get(settings));
  }
};

}  // namespace

Metadata render_metadata(const Scene& scene, int samples, double seconds) {
  Scene rendered = scene;
  rendered.render.spp = samples;
  rendered.render.target_error = 0;
  Metadata metadata{{"scene", write_scene(rendered)},
                    {"samples", std::to_string(samples)},
                    {"seconds", number_text(seconds)},
                    {"version", GLIMT_VERSION}};
  for (const auto& field : settings_fields())
    metadata[std::string(field.key)] = std::visit(ValueText{rendered.render}, field.member);
  return metadata;
}

}  // namespace glimt
