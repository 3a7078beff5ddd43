#include "cli/stats_file.h"

#include <nlohmann/json.hpp>

#include "film/statistics.h"
#include "scene/fields.h"

namespace glimt {
namespace {

using Json = nlohmann::ordered_json;

struct ValueJson {
  const Settings& settings;

  Json operator()(const Choice<Settings>& choice) const {
    return choice.names[static_cast<std::size_t>(choice.get(settings))];
  }
  Json operator()(const Value<Settings, glm::dvec3>& vector) const {
    const glm::dvec3 v = vector.get(settings);
    return {v.x, v.y, v.z};
  }
  template <class T>
  Json operator()(const Value<Settings, T>& number) const {
    return number.get(settings);
  }
};

}  // namespace

std::string stats_json(const Scene& scene, const Film& film, const Execution& execution, int ranks, double seconds) {
  const std::int64_t paths = std::int64_t{film.width()} * film.height() * film.samples();
  Json json;
  json["scene"] = scene.name;
  json["width"] = film.width();
  json["height"] = film.height();
  for (const auto& field : settings_fields())
    json[std::string(field.key)] = std::visit(ValueJson{scene.render}, field.member);
  json["spp"] = film.samples();
  json["sample_ranges"] = ranges_text(film.ranges());
  json["paths"] = paths;
  json["seconds"] = seconds;
  json["paths_per_second"] = static_cast<double>(paths) / seconds;
  json["mean"] = mean(film.mean());
  const ErrorEstimate error = estimate_error(film);
  json["relmse_estimate"] = error.relmse;
  json["relmse_scaled"] = error.relmse_scaled;
  json["relmse_scaled_interval"] = {error.low, error.high};
  json["relmse_bound"] = error.at_most();
  json["flux_unseen"] = error.unseen.flux;
  json["threads"] = execution.threads > 0 ? execution.threads : hardware_threads();
  json["lanes"] = execution.lanes == Lanes::scalar ? 1 : native_lane_count();
  json["ranks"] = ranks;
  json["invalid"] = film.invalid();
  json["saturated"] = film.saturated();
  json["version"] = GLIMT_VERSION;
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace glimt
