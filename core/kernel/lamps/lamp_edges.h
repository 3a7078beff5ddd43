#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <vector>

#include "kernel/geometry/camera.h"
#include "kernel/geometry/cutaway.h"
#include "kernel/lamps/lamp_images.h"
#include "kernel/scattering/surfaces.h"
#include "kernel/transport/path_sums.h"

/// Pixels that an edge of a lamp crosses. A lamp is much brighter than what it lights, so nearly all of the error there
/// comes from how many samples of the pixel see the lamp. So each sample sends many rays to find out.
namespace glimt {

template <class F, Features features>
class LampEdges {
  using I = Int<F>;
  using M = Mask<F>;
  using V = Vec3<F>;

 public:
  static constexpr int rays = 16;  ///< for each sample

  LampEdges(const CompiledScene& scene, const Squares<F>& squares)
      : scene_(scene), surfaces_(scene), squares_(squares) {}

  /// Replaces what each path's one camera ray sees of the lamp by the mean over many rays.
  void refine(PathSums<F>& sums) const {
    const PathBlock& block = squares_.whole;
    std::array<std::int32_t, lane_count<F>> xs{}, ys{}, samples{};
    std::size_t count = 0;
    const auto trace = [&] {
      refine(load<I>(xs.data()), load<I>(ys.data()), load<I>(samples.data()), static_cast<int>(count), sums);
      count = 0;
    };
    for (int y = block.y0; y < std::min(block.y0 + block.height, scene_.height); ++y) {
      const int end = y * scene_.width + std::min(block.x0 + block.width, scene_.width);
      for (auto pixel = std::ranges::lower_bound(scene_.lamp_edges, y * scene_.width + block.x0);
           pixel != scene_.lamp_edges.end() && *pixel < end; ++pixel)
        for (int sample = 0; sample < block.samples; ++sample) {
          xs[count] = *pixel - y * scene_.width, ys[count] = y, samples[count] = sample;
          if (++count == lane_count<F>) trace();
        }
    }
    if (count > 0) trace();
  }

 private:
  /// Refines the paths of pixels (x, y) in the first `count` lanes.
  void refine(const I& x, const I& y, const I& sample, int count, PathSums<F>& sums) const {
    const I number = sample + I(static_cast<std::int32_t>(squares_.whole.first_sample));
    V change = emission(camera_sample<F>(scene_, x, y, number).direction) * F(-1.0f);
    for (int k = 0; k < rays; ++k)
      change = fma(emission(camera_sample<F>(scene_, x, y, number, rays, k).direction), F(1.0f / rays), change);
    std::array<std::int32_t, lane_count<F>> place;
    std::array<float, lane_count<F>> r, g, b;
    store(squares_.place(x, y, sample), place.data());
    store(change.x, r.data()), store(change.y, g.data()), store(change.z, b.data());
    for (std::size_t i = 0; i < static_cast<std::size_t>(count); ++i) sums.add(place[i], r[i], g[i], b[i]);
  }

  /// Radiance of the lamp that a camera ray meets first; 0 in the rectangles that LampImages handles.
  V emission(const V& direction) const {
    const Ray<F> ray{broadcast<F>(scene_.camera.eye), direction, I(-1)};
    const Hit<F> hit = path_hit<F, features>(scene_, surfaces_, ray, all_lanes<F>());
    const Interaction<F> at = surfaces_.meet(ray, hit);
    M shines = (hit.t < F(std::numeric_limits<float>::infinity())) & surfaces_.is_lamp(at) & at.front;
    if (!scene_.lamp_images.empty()) shines = shines & !in_lamp_image(scene_, direction);
    return select(shines, surfaces_.vector(Column::emission_r, at), V::all(F(0.0f)));
  }

  const CompiledScene& scene_;
  Surfaces<F, features> surfaces_;
  const Squares<F>& squares_;
};

}  // namespace glimt
