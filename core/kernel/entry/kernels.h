#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "compile/compiled_scene.h"

namespace glimt {

/// How many paths a thread traces side by side.
enum class Lanes { scalar, native };

/// Width of `Lanes::native` in this binary: 32, 8 or 4.
int native_lane_count();

/// A rectangle of pixels and a range of their samples: the paths that one call traces.
struct PathBlock {
  int x0 = 0, y0 = 0;         ///< upper left pixel
  int width = 0, height = 0;  ///< in pixels
  std::uint32_t first_sample = 0;
  int samples = 0;  ///< per pixel

  int paths() const { return width * height * samples; }
};

/// Counters for what is left to chance in a scene with so many emitters: for each and each ChanceWay the throughputs of
/// the paths that met it, in units of 1 / chance_unit; last, how many camera paths have met a smooth mirror or glass
/// first.
constexpr std::size_t chance_counters(std::size_t emitters) { return emitters == 0 ? 0 : emitters * chance_ways + 1; }
inline constexpr float chance_unit = 0x1p16f;

/// Radiance of every path of the block, into rgb[3 * paths()]: sample by sample, in each row by row. A path's value is
/// a pure function of (scene, seed, pixel, sample): the same for every block it is in and every lane width. With path
/// sharing the other paths of its square are traced for it, wherever the block ends. `by_chance` is empty or has the
/// scene's chance_counters(); to them is added how often the paths have found light that is left to chance.
void trace(const CompiledScene& scene, const PathBlock& block, Lanes lanes, float* rgb,
           std::span<std::uint64_t> by_chance = {});

/// Some of the light paths of one pass: those that belong to one sample of every pixel.
struct LightBlock {
  int first_path = 0, paths = 0;  ///< of CompiledScene::light_paths
  std::uint32_t sample = 0;
};

/// What a light path adds to one sample of a pixel.
struct Splat {
  std::int32_t pixel;
  float r, g, b;  ///< radiance, W/(m^2 sr)
};

/// Appends the splats of the block's light paths; each path's are a pure function of (scene, seed, sample, path). The
/// sum over a pass is what camera paths of that sample, as trace() traces them, leave out.
void trace_light(const CompiledScene& scene, const LightBlock& block, Lanes lanes, std::vector<Splat>& splats);

/// A path whose first ray is not the camera's, and which is alone: without sharing and light paths.
struct GivenPath {
  std::array<double, 3>
      origin{};  ///< scene coordinates, in the region that the camera sees: the rest may have been left out
  std::array<double, 3> direction{};  ///< of unit length
  std::uint32_t pixel = 0;            ///< with `sample`, names the random numbers
  std::uint32_t sample = 0;
};

/// Radiance that arrives at the path's origin from its direction; for tests that need rays of their own.
Rgb trace_ray(const CompiledScene& scene, const GivenPath& path, Lanes lanes);

}  // namespace glimt
