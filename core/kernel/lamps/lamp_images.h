#pragma once

#include <array>

#include "kernel/geometry/camera.h"
#include "kernel/geometry/cutaway.h"
#include "kernel/scattering/surfaces.h"
#include "kernel/transport/path_sums.h"

/// Small lamps that the camera sees, directly or by way of mirrors and glass, are specks that few camera rays meet.
/// They lie in known rectangles of the image. In these, camera paths do not count lamps that they meet before the first
/// diffuse surface. Extra rays through the rectangles count them instead.
namespace glimt {

/// Whether a direction from the eye, of unit length, goes through one of the rectangles.
template <class F>
Mask<F> in_lamp_image(const CompiledScene& scene, const Vec3<F>& direction) {
  const PinholeCamera& camera = scene.camera;
  const F scale = reciprocal(dot(direction, broadcast<F>(camera.forward)) * F(camera.pixel_area));
  const F x = fma(dot(direction, broadcast<F>(camera.right)), scale, F(0.5f * static_cast<float>(scene.width)));
  const F y = fma(dot(direction, broadcast<F>(camera.down)), scale, F(0.5f * static_cast<float>(scene.height)));
  Mask<F> inside = no_lanes<F>();
  for (const LampImage& image : scene.lamp_images)
    inside = inside | ((x >= F(static_cast<float>(image.x0))) & (x < F(static_cast<float>(image.x1))) &
                       (y >= F(static_cast<float>(image.y0))) & (y < F(static_cast<float>(image.y1))));
  return inside;
}

template <class F, Features features>
class LampImages {
  using I = Int<F>;
  using M = Mask<F>;
  using V = Vec3<F>;

 public:
  static constexpr int rays = 16;  ///< for each sample of a pixel

  LampImages(const CompiledScene& scene, const Squares<F>& squares)
      : scene_(scene), surfaces_(scene), squares_(squares) {}

  /// Adds the lamps that camera paths leave out.
  void add(PathSums<F>& sums) {
    const PathBlock& block = squares_.whole;
    const int right = std::min(block.x0 + block.width, scene_.width),
              bottom = std::min(block.y0 + block.height, scene_.height);
    for (const LampImage& image : scene_.lamp_images)
      for (int y = std::max(block.y0, static_cast<int>(std::floor(image.y0))); y < bottom && y < image.y1; ++y)
        for (int x = std::max(block.x0, static_cast<int>(std::floor(image.x0))); x < right && x < image.x1; ++x) {
          const LampImage part{std::max(image.x0, static_cast<double>(x)), std::max(image.y0, static_cast<double>(y)),
                               std::min(image.x1, x + 1.0), std::min(image.y1, y + 1.0)};
          for (int sample = 0; sample < block.samples; sample += lane_count<F>) look(part, x, y, sample, sums);
        }
  }

 private:
  /// Traces the rays through a part of a pixel, one sample per lane.
  void look(const LampImage& part, int x, int y, int first, PathSums<F>& sums) const {
    const I sample = I(first) + lane_numbers<F>();
    const I number = sample + I(static_cast<std::int32_t>(squares_.whole.first_sample));
    const PathKey<F> key = first_key<F>(scene_.settings.sampler, static_cast<std::uint32_t>(scene_.settings.seed),
                                        as_uint(I(y * scene_.width + x)), as_uint(number));
    const F width(static_cast<float>(part.x1 - part.x0)), height(static_cast<float>(part.y1 - part.y0));
    V sum = V::all(F(0.0f));
    for (int k = 0; k < rays; ++k) {
      const Point2<F> uv =
          random_pair<F>(scene_.settings.sampler, key, {I(0)}, static_cast<std::uint32_t>(Dimension::pixel_x), rays, k);
      const F px = fma(uv.u, width, F(static_cast<float>(part.x0))),
              py = fma(uv.v, height, F(static_cast<float>(part.y0)));
      const PinholeCamera& camera = scene_.camera;
      const V direction = normalize(
          fma(broadcast<F>(camera.right), px, fma(broadcast<F>(camera.down), py, broadcast<F>(camera.corner))));
      sum = sum + emission(direction, skip_dimensions<F>(key, static_cast<std::uint32_t>(Dimension::camera_count)), k);
    }
    sum = sum * (width * height * F(1.0f / rays));
    std::array<float, lane_count<F>> r, g, b;
    store(sum.x, r.data()), store(sum.y, g.data()), store(sum.z, b.data());
    const int count = std::min(squares_.whole.samples - first, lane_count<F>);
    for (int i = 0; i < count; ++i) {
      const auto lane = static_cast<std::size_t>(i);
      sums.add(squares_.place(x, y, first + i), r[lane], g[lane], b[lane]);
    }
  }

  /// Radiance of the lamp that a camera ray meets before any matt or glossy surface. `k` is the number of the ray.
  V emission(const V& direction, PathKey<F> key, int k) const {
    const int max_depth = setting<features, &Settings::max_depth>(scene_);
    Ray<F> ray{broadcast<F>(scene_.camera.eye), direction, I(-1)};
    V throughput = V::all(F(1.0f)), found = V::all(F(0.0f));
    M on = all_lanes<F>();
    for (int depth = 0; any(on); ++depth) {
      const Hit<F> hit = path_hit<F, features>(scene_, surfaces_, ray, depth == 0 ? all_lanes<F>() : no_lanes<F>(), on);
      on = on & (hit.t < F(std::numeric_limits<float>::infinity()));
      const Interaction<F> at = surfaces_.meet(ray, hit);
      const M shines = on & surfaces_.is_lamp(at) & at.front;
      if (any(shines)) found = select(shines, throughput * surfaces_.vector(Column::emission_r, at), found);
      on = on & !(surfaces_.is_lamp(at) | surfaces_.is_matt(at) | surfaces_.is_glossy(at));
      if (!any(on) || (max_depth > 0 && depth >= max_depth - 1)) return found;
      const auto number = [&](HitDimension dimension) {
        return random_number<F>(setting<features, &Settings::sampler>(scene_), key, LatticePlace<F>::of(I(depth + 1)),
                                static_cast<std::uint32_t>(dimension), rays, k);
      };
      const Point2<F> uv{number(HitDimension::direction_u), F(0.0f)};
      ScatterSample<F> next = surfaces_.sample(at, ray.direction * F(-1.0f), uv, F(0.0f));
      surfaces_.keep_side(at, ray.direction * F(-1.0f), next);
      throughput = throughput * surfaces_.colour(at) * next.weight * select(next.crosses, next.inverse_eta2, F(1.0f));
      ray = {at.point, next.direction, at.surface};
      if (depth >= setting<features, &Settings::roulette_depth>(scene_)) {
        on = on & (number(HitDimension::roulette) < F(largest_survival)) & (max_component(throughput) > F(0.0f));
        throughput = throughput * F(1 / largest_survival);
      }
      key = skip_dimensions<F>(key, hit_dimensions(1));
    }
    return found;
  }

  const CompiledScene& scene_;
  Surfaces<F, features> surfaces_;
  const Squares<F>& squares_;
};

}  // namespace glimt
