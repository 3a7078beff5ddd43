#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <numbers>

#include "compile/lowering.h"
#include "compile/near_lamps.h"
#include "scene/file/text.h"
#include "scene/geometry/mesh_measures.h"

/// Where the chosen estimators cannot hold. Each criterion is one that a person can check in the scene; the tests in
/// tests/stability/ show what happens beyond it.
namespace glimt {

using glm::dvec3;

namespace {

/// Reflectance from which on constant roulette has infinite variance: weights grow by rho / 0.75 at each hit, and rho^2
/// / 0.75 > 1 makes the sum of their squares diverge.
constexpr double constant_limit = 0.866;
/// The same for roulette by throughput, whose survival is at most 0.99.
constexpr double throughput_limit = 0.995;
/// Of all surfaces: chance finds smaller lamps about once in more than ten thousand tries.
constexpr double tiny_lamps = 1e-4;

/// Of a lamp's size: a reflecting surface nearer than this is as good as touched.
constexpr double as_good_as_touched = 0.01;

const Material& material_of(const Lowering& l, int index) { return l.scene.materials[static_cast<std::size_t>(index)]; }

void warn_of_near_lamps(Lowering& l, const std::vector<NearPiece>& pieces) {
  const Settings& s = l.out.settings;
  if (s.light_sampling == LightSampling::none || s.mis == Mis::on) return;
  for (const LampPiece& lamp : l.lamps) {
    if (!is_sampled_by_area(lamp.shape)) continue;
    const NearPiece* touched = nearly_touched(l, lamp, pieces, as_good_as_touched);
    if (touched == nullptr) continue;
    l.out.warnings.push_back("a lamp that is sampled by area touches or nearly touches " + toml_string(touched->name) +
                             ": the noise in the corner between them will not go away; choose light_sampling = "
                             "\"auto\" or \"solid-angle\", or mis = \"on\"");
    return;
  }
}

void warn_of_tiny_lamps(Lowering& l, const std::vector<NearPiece>& pieces) {
  if (l.out.settings.light_sampling != LightSampling::none || l.lamps.empty()) return;
  double lamps = 0, all = 0;
  for (const LampPiece& lamp : l.lamps) lamps += area_of(lamp.shape);
  for (const NearPiece& piece : pieces) all += piece.area();
  if (lamps < tiny_lamps * all)
    l.out.warnings.emplace_back(
        "without light sampling, lamps that make up less than 1/10000 of all surfaces are hardly ever found: the image "
        "will be dark with a few bright dots; choose light_sampling = \"auto\"");
}

void warn_of_roulette(Lowering& l) {
  if (l.out.settings.roulette == Roulette::constant) {
    const bool bright = std::any_of(l.surfaces.begin(), l.surfaces.end(), [](const Surface& s) {
      return is_diffuse(*s.material) && brightest(*s.material) > constant_limit;
    });
    if (bright)
      l.out.warnings.emplace_back(
          "constant roulette (survival 0.75) has infinite variance where a reflectance is above 0.866 = sqrt(0.75): "
          "the "
          "noise will not go away; choose roulette = \"throughput\"");
    return;
  }
  // What of the light that falls on the room's walls is reflected, if it comes from everywhere alike.
  double reflected = 0, all = 0;
  for (const RoomFace& face : l.reach.room) {
    const Material& m = material_of(l, face.material);
    const double area = glimt::area_of(face.outline);
    all += area;
    reflected += brightest(m) * area;
  }
  if (reflected > throughput_limit * all)
    l.out.warnings.emplace_back(
        "the room's walls reflect more than 0.995 of the light: roulette, by which at most 0.99 of the paths go on, "
        "has "
        "infinite variance there, and the noise will not go away");
}

}  // namespace

void warn(Lowering& l) {
  const Settings& s = l.out.settings;
  if (l.out.max_radiance == 0) l.out.warnings.emplace_back("nothing in reach emits light: the image will be black");
  const std::vector<NearPiece> pieces = pieces_in_reach(l);
  warn_of_near_lamps(l, pieces);
  warn_of_tiny_lamps(l, pieces);
  warn_of_roulette(l);
  if (s.mis == Mis::on && s.light_sampling == LightSampling::none)
    l.out.warnings.emplace_back("mis = \"on\" changes nothing without light sampling");
  const int side = static_cast<int>(std::ceil(std::sqrt(s.spp)));
  if (s.sampler == Sampler::centres && side * side != s.spp)
    l.out.warnings.push_back("sampler = \"centres\" with " + std::to_string(s.spp) +
                             " samples a pixel, no square number, leaves out some of its " + std::to_string(side) +
                             "x" + std::to_string(side) + " sub-pixels");
}

}  // namespace glimt
