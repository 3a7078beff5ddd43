#pragma once

#include <array>
#include <functional>
#include <string_view>
#include <vector>

#include "chart/runs.h"
#include "scene/scene.h"

/// Which light the remaining error of a picture comes from. There are four families: caustics or other light, in pixels
/// that see a mirror or glass first or in the others.
namespace glimt {

/// One family's figures over all seeds.
struct Family {
  double error = 0;          ///< mean of its part of relmse_scaled
  double share = 0;          ///< mean of its share of the error of all families; 0 where there is no error
  double low = 0, high = 0;  ///< quartiles of the share
  double pixels = 0;         ///< share of the pixels in which it is seen
};

struct Families {
  std::array<Family, 4> all;
  int samples = 0;  ///< per pixel
};

struct FamilyText {
  std::string_view name, tip;
};

/// In the order of Families::all.
inline constexpr std::array<FamilyText, 4> family_texts{{
    {"Caustics", "Light that reaches a matt surface by way of mirrors or glass. More light paths take noise off it."},
    {"Caustics in mirrors and glass",
     "Caustics that are seen in a mirror or through glass. Sphere connections find those over a single sphere; all "
     "others are left to chance: more samples."},
    {"Other light",
     "Lamps, and light off matt surfaces. More samples take noise off it, or more shadow rays where they pay."},
    {"Other light in mirrors and glass",
     "Lamps, and light off matt surfaces, seen in a mirror or through glass. More samples take noise off it."},
}};

/// Whether the centre of each pixel sees a mirror or glass first, row by row from the top.
std::vector<bool> sees_specular(const Scene& scene);

/// Renders the scene without caustics and with caustics only, in turn and to equal sample counts, with plan.seeds seeds
/// each, for plan.seconds or to plan.spp at most. Where the scene's own setting leaves one of the two out, so does
/// this. Errors are relmse_scaled as the halves of each picture estimate it, relative to the sum of both pictures.
/// Seeds begin with the scene's own. Calls `report` with the share done; it may throw to stop the work. Throws
/// std::runtime_error where the scene has no mirror and no glass.
Families measure_families(const Scene& scene, const Plan& plan, const std::function<void(double)>& report);

}  // namespace glimt
