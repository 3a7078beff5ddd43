#pragma once

#include <array>
#include <functional>
#include <string_view>
#include <vector>

#include "chart/runs.h"
#include "scene/scene.h"

/// Which light the remaining error of a picture is of: caustics or other light, where the pixel sees a mirror or glass
/// or anything else.
namespace glimt {

/// Over seeds.
struct Family {
  double error = 0;          ///< its part of relmse_scaled, mean
  double share = 0;          ///< of the error of all families, mean; 0 where there is no error
  double low = 0, high = 0;  ///< quartiles of the share
  double pixels = 0;         ///< share of the pixels it is seen in
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

/// Renders the scene without caustics and with nothing else in turn, each with plan.seeds seeds to equal sample counts,
/// plan.seconds or plan.spp at most. Errors are relmse_scaled as each one's halves estimate it, relative to the sum of
/// both. Seeds are the scene's own and those that follow. What the scene's own setting of caustics leaves out is left
/// out. `report` is called with the share done, and may throw to end it. Throws std::runtime_error where the scene has
/// no mirrors and no glass.
Families measure_families(const Scene& scene, const Plan& plan, const std::function<void(double)>& report);

}  // namespace glimt
