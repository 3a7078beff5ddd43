#pragma once

#include <bit>
#include <numeric>

#include "kernel/entry/features.h"
#include "kernel/geometry/pinhole.h"
#include "kernel/lamps/emission.h"
#include "kernel/scattering/surfaces.h"
#include "kernel/transport/hit_numbers.h"
#include "kernel/transport/results.h"
#include "kernel/transport/trace.h"

/// Light paths, for caustics on what the camera sees directly: from a lamp to a specular or glossy surface, on through
/// others, and from each matt surface after that straight to the pinhole (Arvo, "Backward ray tracing", 1986; Dutre,
/// Lafortune and Willems, "Monte Carlo light tracing with direct computation of pixel intensities", 1993).
namespace glimt {

/// The state of one light path a lane, between two surfaces.
template <class F>
struct LightPathState {
  Ray<F> ray;
  Vec3<F> flux;    ///< that the path stands for, W
  PathKey<F> key;  ///< its dimension 0 is the first of the next hit
  Int<F> depth;    ///< surfaces hit before
  Int<F> target;   ///< what the path is aimed at
  Int<F> path;     ///< number in the pass; from the end of the block on, a lane without work
};

template <class F, Features features>
class LightPathTracer {
  using I = Int<F>;
  using U = Uint<F>;
  using M = Mask<F>;
  using V = Vec3<F>;

 public:
  LightPathTracer(const CompiledScene& scene, const LightBlock& block, std::vector<Splat>& splats)
      : scene_(scene), block_(block), splats_(splats), surfaces_(scene) {
    std::iota(rank_.begin(), rank_.end(), 0);
  }

  void run() {
    LightPathState<F> s{};
    s.path = I(end());
    int next = block_.first_path;
    for (;;) {
      const M idle = !less(s.path, I(end()));
      const int free = std::popcount(bits(idle));
      // Beginning a path costs about as much for one lane as for all.
      if (next < end() && 4 * free >= lane_count<F>) {
        begin_paths(s, idle, next);
        next += free;
      }
      if (!any(less(s.path, I(end())))) return done_.flush(writer());
      const M ended = step(s);
      s.path = select(ended, I(end()), s.path);
    }
  }

 private:
  int end() const { return block_.first_path + block_.paths; }

  HitNumbers<F> numbers_of(const LightPathState<F>& s) const {
    return {set<&Settings::sampler>(), s.key, LatticePlace<F>::of(s.depth + I(2))};
  }

  /// All passes of a half share one sequence, until its index would not fit.
  PathKey<F> first_key_of(const I& path) const {
    const std::uint32_t seed = static_cast<std::uint32_t>(set<&Settings::seed>()) + light_path_seeds;
    const Sampler sampler = set<&Settings::sampler>();
    if (!has_sequences(sampler)) return first_key<F>(sampler, seed, as_uint(path), U(block_.sample));
    const auto count = static_cast<std::uint32_t>(scene_.light_paths);
    const std::uint32_t passes = std::max(1u, longest_sequence / count);
    const std::uint32_t pass = block_.sample / 2, half = block_.sample % 2;
    const U index = as_uint(path) + U(pass % passes * count);
    return first_key<F>(sampler, seed, U(pass / passes), U(index + index + U(half)));
  }

  void begin_paths(LightPathState<F>& s, const M& idle, int next) const {
    s.path = select(idle, expand<I, F>(I(0), idle, rank_.data()) + I(next), s.path);
    s.depth = select(idle, I(-1), s.depth);
    const PathKey<F> key = first_key_of(s.path);
    s.key = {select(idle, key.a, s.key.a), select(idle, key.b, s.key.b), select(idle, key.index, s.key.index)};
    const HitNumbers<F> numbers = numbers_of(s);
    const I row = choose_aim<F, features>(scene_, numbers.number(HitDimension::lamp));
    const Point2<F> on_lamp = numbers.pair(HitDimension::lamp_u), to_target = numbers.pair(HitDimension::direction_u);
    const Emission<F> emission = emit<F, features>(scene_, row, on_lamp, to_target);
    s.ray = {select(idle, emission.origin, s.ray.origin), select(idle, emission.direction, s.ray.direction),
             select(idle, emission.surface, s.ray.from)};
    s.flux = select(idle, emission.flux, s.flux);
    s.target = select(idle, emission.target, s.target);
    s.key.a = select(idle, skip_dimensions<F>(s.key, hit_block).a, s.key.a);
    s.depth = select(idle, I(0), s.depth);
  }

  /// One surface for every lane; returns the lanes whose paths end there.
  M step(LightPathState<F>& s) {
    const Hit<F> hit = closest_hit<F, features>(scene_, s.ray, less(s.path, I(end())));
    Interaction<F> at = surfaces_.meet(s.ray, hit);
    const M aimed = equal(as_int(surfaces_.value(Column::target, at)), s.target) | less(I(0), s.depth);
    const M met = hit.t < F(std::numeric_limits<float>::infinity());
    M ended = surfaces_.is_lamp(at) | !(met & aimed);
    // The lamp is a surface too.
    const int max_depth = set<&Settings::max_depth>();
    if (max_depth > 0) ended = ended | !less(s.depth, I(max_depth - 1));
    const V colour = surfaces_.colour(at);
    s.flux = s.flux * colour;
    const V way_back = s.ray.direction * F(-1.0f);
    const M matt = surfaces_.is_matt(at) & !ended;
    if (any(matt)) splat(s, at, way_back, matt & less(s.path, I(end())));

    // BSDFs are symmetric but for the factor n^2, which flux does not have, so directions are chosen as on camera
    // paths.
    const HitNumbers<F> numbers = numbers_of(s);
    const Point2<F> uv = numbers.pair(HitDimension::direction_u);
    if (surfaces_.has_smooth()) {
      s.flux = s.flux * select(at.smooth & matt, adjoint_matt(at, way_back), F(1.0f));
      at.normal = select(at.smooth & matt, at.flat, at.normal);
    }
    ScatterSample<F> next = surfaces_.sample(at, way_back, uv, surfaces_.has_glossy() ? numbers.lobe() : F(0.0f));
    if (surfaces_.has_smooth())
      s.flux = s.flux * select(at.smooth & !matt, adjoint(at, way_back, next.direction), F(1.0f));
    surfaces_.keep_side(at, way_back, next);
    s.flux = s.flux * next.weight;
    s.ray = {at.point, next.direction, at.surface};
    const F survival = min(max_component(colour), F(largest_survival));
    const M plays = matt | !less(s.depth, I(set<&Settings::roulette_depth>()));
    ended = ended | (plays & !(numbers.number(HitDimension::roulette) < survival)) | !(max_component(s.flux) > F(0.0f));
    s.flux = s.flux * select(plays, reciprocal(survival), F(1.0f));
    s.key = skip_dimensions<F>(s.key, hit_block);
    s.depth = s.depth + I(1);
    return ended;
  }

  /// What a matt surface sends through the pinhole.
  void splat(const LightPathState<F>& s, const Interaction<F>& at, const V& wi, const M& matt) {
    const V way = broadcast<F>(scene_.camera.eye) - at.point;
    const F distance2 = dot(way, way);
    const F inverse = inverse_sqrt(distance2);
    const F distance = distance2 * inverse;
    const V wo = way * inverse;
    const F shading_cos = dot(wo, at.normal), cos = surfaces_.flat_cos(at, wo, shading_cos);
    const V from_eye = wo * F(-1.0f);
    const Projection<F> image = project(scene_, from_eye);
    M seen = matt & image.inside & (cos > F(0.0f));
    if (!any(seen)) return;
    seen = seen & !occluded<F, features, true>(scene_, {at.point, wo, at.surface}, distance, I(0), I(-1), seen);
    const F importance = pinhole_importance(scene_, from_eye, distance, cos);
    const F weight = importance * light_path_share(scene_, importance) * F(std::numbers::inv_pi_v<float>);
    V radiance = s.flux * weight;
    if (surfaces_.has_rough_matt())
      radiance = radiance * surfaces_.evaluate_matt(at, wi, wo, at.cos_o,
                                                    surfaces_.has_smooth() ? max(shading_cos, F(least_cosine)) : cos);
    if (surfaces_.has_smooth()) radiance = radiance * select(at.smooth, adjoint_matt(at, wi), F(1.0f));
    done_.add(radiance, image.pixel, seen, writer());
  }

  // Where a normal for shading stands in for the surface's own, what importance meets differs from what radiance does
  // by the ratios of the cosines to both (Veach, "Robust Monte Carlo methods for light transport simulation", 1997,
  // 5.3).

  /// Of a matt surface that light comes to from wi, where the way on is chosen by the surface's own normal.
  F adjoint_matt(const Interaction<F>& at, const V& wi) const {
    return surfaces_.folded_cos(at, wi) * reciprocal(max(dot(wi, at.flat), F(least_cosine)));
  }
  /// Of others, where it is chosen by the normal for shading.
  F adjoint(const Interaction<F>& at, const V& wi, const V& wo) const {
    const F over = abs(dot(wi, at.normal) * dot(wo, at.flat)), under = abs(dot(wi, at.flat) * dot(wo, at.normal));
    return over * reciprocal(max(under, F(least_cosine * least_cosine)));
  }

  auto writer() const {
    return [&splats = splats_](std::int32_t pixel, float r, float g, float b) { splats.push_back({pixel, r, g, b}); };
  }

  /// The value of a setting.
  template <auto member>
  auto set() const {
    return setting<features, member>(scene_);
  }

  static constexpr std::uint32_t light_path_seeds = 1u << 31;  ///< apart from all seeds of camera paths
  static constexpr std::uint32_t longest_sequence = 1u << 30;
  static constexpr std::uint32_t hit_block = hit_dimensions(1);
  static constexpr float least_cosine = 1e-4f;

  const CompiledScene& scene_;
  const LightBlock& block_;
  std::vector<Splat>& splats_;
  Surfaces<F, features> surfaces_;
  std::array<std::int32_t, 2 * lane_count<F>> rank_;
  Results<F> done_;
};

template <class F>
void trace_light_block(const CompiledScene& scene, const LightBlock& block, std::vector<Splat>& splats) {
  with_features(scene, [&](auto features) {
    if constexpr (features().caustics) LightPathTracer<F, features()>(scene, block, splats).run();
  });
}

}  // namespace glimt
