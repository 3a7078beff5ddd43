#pragma once

#include <algorithm>
#include <tuple>
#include <type_traits>

#include "compile/compiled_scene.h"
#include "material/lobes.h"

/// Which kernel a scene gets, and the one way in which kernels read settings.
namespace glimt {

/// What a kernel is compiled for. What it leaves out costs neither time nor registers.
struct Features {
  bool small_table = false;        ///< no more surfaces than lookup_small can hold
  bool one_parallelogram = false;  ///< the only lamp is a parallelogram, sampled by area
  LobeSet lobes = lobes_up_to(LobeUse::seldom);
  bool caustics = true;      ///< light paths, connections over spheres, small lamps in view, and `caustic_settings`
  bool rare_shapes = true;   ///< triangles, glass solids, spheres around the camera, lamps that reach out of the room,
                             ///< a cutaway
  bool glow = true;          ///< surfaces with emission that are no lamps
  bool any_settings = true;  ///< `usual_settings` may have any value
  bool tree = true;          ///< a tree of triangles, and smooth shading
};

/// Settings that have their defaults in kernels without `any_settings`. A setting that is in no list is read at run
/// time by every kernel.
inline constexpr std::tuple usual_settings{&Settings::light_sampling, &Settings::mis, &Settings::sampler,
                                           &Settings::max_depth};
/// Settings that have their defaults in kernels without `caustics`.
inline constexpr std::tuple caustic_settings{&Settings::caustics};

template <auto member, class... Members>
constexpr bool is_in(const std::tuple<Members...>& list) {
  const auto same = [](auto other) {
    if constexpr (std::is_same_v<decltype(other), decltype(member)>) return other == member;
    return false;
  };
  return std::apply([&](auto... others) { return (same(others) || ...); }, list);
}

/// Whether all settings of a list have their defaults.
template <class... Members>
bool has_defaults(const Settings& settings, const std::tuple<Members...>& list) {
  return std::apply([&](auto... members) { return ((settings.*members == Settings{}.*members) && ...); }, list);
}

/// The value of a setting for a kernel: setting<features, &Settings::mis>(scene).
template <Features features, auto member>
auto setting(const CompiledScene& scene) {
  constexpr bool fixed = (!features.any_settings && is_in<member>(usual_settings)) ||
                         (!features.caustics && is_in<member>(caustic_settings));
  if constexpr (fixed) {
    constexpr auto value = Settings{}.*member;
    return value;
  } else {
    return scene.settings.*member;
  }
}

#ifdef GLIMT_GENERAL_KERNEL
inline constexpr bool general_kernel_only = true;
#else
inline constexpr bool general_kernel_only = false;
#endif

/// Calls f(std::integral_constant<Features, features>{}) with the smallest kernel that has what the scene needs. Where
/// GLIMT_GENERAL_KERNEL is defined there is but one, which has all: for static analysis, which would read the same
/// source once for each. Sanitizers build it in a third of the time, but it is too slow for the tests of the worker.
template <class Function>
void with_features(const CompiledScene& scene, Function f) {
  const Settings& s = scene.settings;
  const bool glass_solid =
      std::any_of(scene.solids.begin(), scene.solids.end(), [](const Solid& x) { return x.glass; });
  const bool rare_shapes =
      !scene.triangles.empty() || !scene.shells.empty() || scene.room_hides_lamps || glass_solid || scene.cutaway;
  const bool one = scene.lamps.rows() == 1 && scene.has_lamp<ParallelogramLamp>();
  const bool caustics = scene.light_paths > 0 || !scene.chain_spheres.empty() || !scene.lamp_images.empty() ||
                        !scene.emitters.empty() || !has_defaults(s, caustic_settings);
  const bool usual =
      !rare_shapes && one && !scene.has_glow && has_defaults(s, usual_settings) && scene.surfaces.rows() <= small_table;
  const auto lacks = [&](LobeSet lobes) { return (scene.lobes & lobes) == 0; };
  constexpr LobeSet always = lobes_up_to(LobeUse::always), often = lobes_up_to(LobeUse::often);
  constexpr LobeSet all = lobes_up_to(LobeUse::seldom);
  const auto call_usual = [&]<LobeSet lobes, bool with_caustics>() {
    f(std::integral_constant<Features, Features{.small_table = true,
                                                .one_parallelogram = true,
                                                .lobes = lobes,
                                                .caustics = with_caustics,
                                                .rare_shapes = false,
                                                .glow = false,
                                                .any_settings = false,
                                                .tree = false}>{});
  };
  if (general_kernel_only || scene.tree) {
    f(std::integral_constant<Features, Features{}>{});
    return;
  }
  if constexpr (!general_kernel_only) {
    if (!usual) {
      f(std::integral_constant<Features, Features{.tree = false}>{});
    } else if (lacks(~always)) {
      caustics ? call_usual.template operator()<always, true>() : call_usual.template operator()<always, false>();
    } else if (lacks(~often)) {
      caustics ? call_usual.template operator()<often, true>() : call_usual.template operator()<often, false>();
    } else {
      call_usual.template operator()<all, true>();
    }
  }
}

}  // namespace glimt
