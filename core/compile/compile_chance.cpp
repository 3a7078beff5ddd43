#include <algorithm>
#include <bit>
#include <cmath>
#include <glm/geometric.hpp>
#include <string>

#include "compile/lowering.h"
#include "material/lobes.h"
#include "scene/camera_view.h"

namespace glimt {

using glm::dvec3;

namespace {

constexpr std::size_t most_emitters = 64;  ///< each costs every block of paths some counters; the last stands for more

/// Whether camera rays may pass a piece of a lamp by because it looks narrower than a pixel.
bool looks_thin(const Lowering& l, const CameraView& view, const LampPiece& piece) {
  const LampBody body = body_of(piece.shape);
  const dvec3 way = body.middle() + l.origin - view.eye;
  const double distance = length(way);
  double width = body.radius, shown = 1;
  if (!body.round()) {
    double longest = 0;
    for (const dvec3& a : body.outline)
      for (const dvec3& b : body.outline) longest = std::max(longest, length(a - b));
    width = area_of(piece.shape) / longest;
    shown = -dot(way, body.normal) / distance;
  }
  return shown > 0 && width * shown < view.pixel * distance;
}

/// The light that no estimator but chance finds, in words.
void describe(const Lowering& l, std::vector<std::string>& lines) {
  const CompiledScene& out = l.out;
  const auto by_chance = [&](const std::string& light) { lines.push_back("by chance alone: " + light); };
  const Settings& s = out.settings;
  if (out.lamps.rows() == 0) return;
  if (s.light_sampling == LightSampling::none) by_chance("light straight from lamps to matt surfaces");
  if (l.targets.empty() || s.caustics == Caustics::off) return;
  if (out.light_paths == 0) by_chance("caustics on matt surfaces in view");
  by_chance(std::string("caustics seen in mirrors and through glass") +
            (out.chain_spheres.empty() ? "" : ", but for those over one sphere"));
}

}  // namespace

void lower_chance(Lowering& l) {
  CompiledScene& out = l.out;
  describe(l, out.compiled_in);
  const Settings& settings = out.settings;
  const CameraView view(l.scene.camera, l.scene.image);
  const bool smooth = (out.lobes & lobes_of(LobeClass::delta)) != 0;
  const bool caustics = !l.targets.empty() && settings.caustics != Caustics::off;
  // Connections find every way over the only mirror, if that is a ball.
  const bool connected = l.targets.size() == 1 && out.chain_spheres.size() == 1 && !out.chain_spheres[0].glass;
  std::vector<std::int32_t> row_of(static_cast<std::size_t>(out.surfaces.rows()), -1);
  for (const Emitting& object : l.emitting) {
    const auto is_its_own = [&](const LampPiece& piece) {
      return object.first_surface <= piece.row && piece.row <= object.last_surface;
    };
    const bool sampled = settings.light_sampling != LightSampling::none && std::ranges::any_of(l.lamps, is_its_own);
    bool looked_for = false, thin = false;
    for (const LampPiece& piece : l.lamps) {
      if (!is_its_own(piece)) continue;
      looked_for = piece.looked_for;
      thin = !looked_for && looks_thin(l, view, piece);
      if (!looked_for) break;
    }
    const bool goes_on = settings.max_depth != 1;
    Emitter emitter{(object.radiance.r + object.radiance.g + object.radiance.b) / 3};
    emitter.leave(ChanceWay::straight, thin);
    emitter.leave(ChanceWay::mirrored, goes_on && smooth && !looked_for);
    emitter.leave(ChanceWay::lit, goes_on && (!sampled || (caustics && out.light_paths == 0)));
    emitter.leave(ChanceWay::lit_and_mirrored, goes_on && smooth && (!sampled || (caustics && !connected)));
    if (emitter.ways == 0) continue;
    if (out.emitters.size() < most_emitters) {
      out.emitters.push_back(emitter);
    } else {
      Emitter& last = out.emitters.back();
      last.radiance = std::max(last.radiance, emitter.radiance);
      last.ways |= emitter.ways;
    }
    for (int s = object.first_surface; s <= object.last_surface; ++s)
      row_of[static_cast<std::size_t>(s)] = static_cast<std::int32_t>(out.emitters.size()) - 1;
  }
  for (int s = 0; s < out.surfaces.rows(); ++s)
    out.surfaces[Column::emitter][s] = std::bit_cast<float>(row_of[static_cast<std::size_t>(s)]);
}

}  // namespace glimt
