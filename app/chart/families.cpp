#include "chart/families.h"

#include <algorithm>
#include <numeric>
#include <stdexcept>

#include "chart/materials.h"
#include "scene/camera_view.h"
#include "scene/fields.h"
#include "scene/pick.h"

namespace glimt {
namespace {

using Errors = std::array<double, 4>;

/// The picture with some of its light.
struct Part {
  Caustics light;
  CompiledScene scene;
  Film film;
};

/// The picture without caustics and the picture of caustics only; one of them where the scene is set to it.
std::vector<Part> parts_of(Scene scene) {
  const Caustics shown = scene.render.caustics;
  std::vector<Part> parts;
  for (const Caustics light : {Caustics::off, Caustics::only}) {
    if (shown != Caustics::on && shown != light) continue;
    scene.render.caustics = light;
    parts.push_back({light, compile(scene), {}});
  }
  return parts;
}

/// Each family's part of relmse_scaled.
Errors errors_of(const std::vector<Part>& parts, const std::vector<bool>& specular) {
  std::array<Image, 2> halves;
  for (const int h : {0, 1}) {
    Image& half = halves.at(static_cast<std::size_t>(h));
    half = parts.front().film.half_mean(h);
    if (parts.size() > 1)
      std::ranges::transform(half.rgb, parts[1].film.half_mean(h).rgb, half.rgb.begin(), std::plus());
  }
  const Film& film = parts.front().film;
  const std::vector<double> weights =
      relative_weights(halves[0], halves[1], 1.0 * film.half_samples(0) / film.samples());
  Errors errors{};
  for (const Part& part : parts) {
    const Image deviation = part.film.standard_error();
    const std::size_t family = part.light == Caustics::only ? 0 : 2;
    for (std::size_t i = 0; i < weights.size(); ++i)
      errors.at(family + (specular[i / 3] ? 1 : 0)) +=
          static_cast<double>(deviation.rgb[i]) * deviation.rgb[i] * weights[i] / static_cast<double>(weights.size());
  }
  return errors;
}

Families summary(const std::vector<Errors>& runs, const std::vector<bool>& specular) {
  Families result;
  const auto seen = static_cast<double>(std::ranges::count(specular, true)) / static_cast<double>(specular.size());
  for (std::size_t i = 0; i < result.all.size(); ++i) {
    Family& family = result.all.at(i);
    std::vector<double> shares;
    for (const Errors& errors : runs) {
      const double total = std::accumulate(errors.begin(), errors.end(), 0.0);
      shares.push_back(total > 0 ? errors.at(i) / total : 0);
      family.error += errors.at(i) / static_cast<double>(runs.size());
      family.share += shares.back() / static_cast<double>(runs.size());
    }
    family.low = quantile(shares, 0.25);
    family.high = quantile(shares, 0.75);
    family.pixels = i % 2 == 1 ? seen : 1 - seen;
  }
  return result;
}

}  // namespace

std::vector<bool> sees_specular(const Scene& scene) {
  const CameraView view(scene.camera, scene.image);
  std::vector<bool> sees;
  for (int y = 0; y < scene.image.height; ++y)
    for (int x = 0; x < scene.image.width; ++x) {
      const auto first = pick_seen(scene, {view.eye, view.direction({x + 0.5, y + 0.5})});
      const Material* material = first ? find_material(scene, material_name_of(scene, first->object)) : nullptr;
      sees.push_back(material && is_specular(*material));
    }
  return sees;
}

Families measure_families(const Scene& scene, const Plan& plan, const std::function<void(double)>& report) {
  if (!has_specular(scene)) throw std::runtime_error("Without mirrors and glass all light is one family");
  const std::vector<bool> specular = sees_specular(scene);
  std::vector<Part> parts = parts_of(scene);
  std::vector<Errors> runs;
  int last = 0;  // samples at which a run ends; 0 while the first seed decides
  for (int run = 0; run < plan.seeds; ++run) {
    // Each part has its own random numbers, so that errors do not cancel.
    for (std::size_t i = 0; i < parts.size(); ++i) {
      parts[i].scene.settings.seed = scene.render.seed + run * static_cast<int>(parts.size()) + static_cast<int>(i);
      parts[i].film = make_film(parts[i].scene);
    }
    const int end = last > 0 ? last : std::max(plan.spp, 2);
    double seconds = 0;  // of the slower part
    for (int samples = 0; samples < end && (last > 0 || samples < 2 || 2 * seconds <= plan.seconds);
         samples = parts.front().film.samples()) {
      double pass = 0;
      for (Part& part : parts) {
        const double time =
            seconds_of_pass(part.scene, part.film, std::min(std::max(1, samples), end - samples), plan.execution);
        pass = std::max(pass, time);
      }
      seconds += pass;
      const double done = std::max(seconds / plan.seconds, static_cast<double>(parts.front().film.samples()) / end);
      if (report) report((run + std::min(done, 1.0)) / plan.seeds);
    }
    last = parts.front().film.samples();
    runs.push_back(errors_of(parts, specular));
  }
  Families result = summary(runs, specular);
  result.samples = last;
  if (report) report(1);
  return result;
}

}  // namespace glimt
