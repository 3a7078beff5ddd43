#pragma once

#include <bit>
#include <optional>

#include "kernel/caustics/connect.h"
#include "kernel/geometry/camera.h"
#include "kernel/geometry/cutaway.h"
#include "kernel/geometry/pinhole.h"
#include "kernel/lamps/lamp_edges.h"
#include "kernel/sharing/tail_sharing.h"
#include "kernel/transport/chance_hits.h"
#include "kernel/transport/lamp_weight.h"
#include "kernel/transport/results.h"
#include "kernel/transport/trace.h"

/// The path loop: one path a lane, no recursion. A lane whose path has ended takes the next path at once.
namespace glimt {

template <class F, Features features>
class PathTracer {
  using I = Int<F>;
  using U = Uint<F>;
  using M = Mask<F>;
  using V = Vec3<F>;

 public:
  /// `light_traced`: the paths are the camera's, and light paths do their part. `sharing`: null where there is none.
  /// `by_chance`: counters for ChanceHits, or nothing.
  PathTracer(const CompiledScene& scene, PathSums<F>& sums, bool light_traced, TailSharing<F, features>* sharing,
             std::span<std::uint64_t> by_chance)
      : scene_(scene),
        surfaces_(scene),
        lamps_(scene, surfaces_),
        sums_(sums),
        light_traced_(light_traced),
        sharing_(sharing),
        hit_block_(hit_dimensions(set<&Settings::shadow_rays>())),
        over_roulette_below_(static_cast<float>(1 / set<&Settings::roulette_below>())),
        connects_(!scene.chain_spheres.empty()),
        connector_(scene),
        chance_hits_(by_chance) {}

  /// Traces all paths of the source and adds up what each one gathers.
  void run(PathSource<F>& source) {
    PathQueue<F> queue;
    PathState<F> s{};
    s.place.at = I(PathPlace<F>::no_path);
    s.ior2 = F(1.0f);
    s.lamps.next = s.lamps.specular = F(0.0f);
    s.chain.connects = no_lanes<F>();
    s.chain.found = {I(chain_none), F(0.0f), F(0.0f)};
    if (connects()) connector_.begin(sums_.size());
    looks_apart_ = source.from_camera() && !scene_.lamp_images.empty();
    const V origin = source.origin();
    s.ray = {origin, {F(0.0f), F(0.0f), F(1.0f)}, I(-1)};
    for (;;) {
      const M idle = s.place.is_idle();
      if (any(idle)) {
        begin_paths(source, origin, queue, s, idle);
        if (!any(s.place.is_busy())) break;
      }
      const M ended = step(s) & s.place.is_busy();
      finish(s, ended);
    }
    done_.flush(writer());
    if (connects()) connector_.finish(sums_);
  }

 private:
  void begin_paths(PathSource<F>& source, const V& origin, PathQueue<F>& q, PathState<F>& s, const M& idle) {
    const int wanted = std::popcount(bits(idle));
    if (q.next + wanted > PathQueue<F>::capacity) {
      if (source.exhausted() && q.next >= PathQueue<F>::capacity) return;
      source.refill(q);
    }
    const auto place = static_cast<std::size_t>(q.next);
    s.ray.origin = select(idle, origin, s.ray.origin);
    s.ray.direction = {expand<F, F>(s.ray.direction.x, idle, &q.direction_x[place]),
                       expand<F, F>(s.ray.direction.y, idle, &q.direction_y[place]),
                       expand<F, F>(s.ray.direction.z, idle, &q.direction_z[place])};
    s.ray.from = select(idle, I(-1), s.ray.from);
    s.key.a = expand<U, F>(s.key.a, idle, &q.key_a[place]);
    s.key.b = expand<U, F>(s.key.b, idle, &q.key_b[place]);
    s.key.index = expand<U, F>(s.key.index, idle, &q.key_index[place]);
    s.place.at = expand<I, F>(s.place.at, idle, &q.path[place]);
    s.throughput = select(idle, V::all(F(1.0f)), s.throughput);
    s.radiance = select(idle, V::all(F(0.0f)), s.radiance);
    if (surfaces_.has_glass()) s.ior2 = select(idle, F(1.0f), s.ior2);
    F share(set<&Settings::caustics>() == Caustics::only ? 0.0f : 1.0f);
    if (looks_apart_) share = select(in_lamp_image(scene_, s.ray.direction), F(-1.0f), share);
    s.lamps.next = select(idle, share, s.lamps.next);
    if (features.caustics) s.lamps.specular = select(idle, share, s.lamps.specular);
    if (lamps_.shares()) s.lamps.pdf_w = select(idle, F(0.0f), s.lamps.pdf_w);
    s.depth = select(idle, I(0), s.depth);
    if (counts_chance()) s.way = select(idle, I(static_cast<std::int32_t>(ChanceWay::straight)), s.way);
    if (sharing_) s.first.class_and_side = select(idle, I(FirstMatt<F>::none), s.first.class_and_side);
    if (connects()) {
      s.chain.found.stage = select(idle, I(chain_none), s.chain.found.stage);
      s.chain.connects = s.chain.connects | idle;
    }
    q.next += wanted;
  }

  /// One surface for every lane; returns the lanes whose paths end there.
  M step(PathState<F>& s) {
    // The next surface, and its own light.
    const Hit<F> hit = path_hit<F, features>(scene_, surfaces_, s.ray, equal(s.depth, I(0)), s.place.is_busy());
    const M missed = !(hit.t < F(std::numeric_limits<float>::infinity()));
    const Interaction<F> at = surfaces_.meet(s.ray, hit);
    const M lamp = surfaces_.is_lamp(at);
    M ended = missed | lamp;
    add_emission(s, at, hit.t, lamp, missed);

    // The tail that the path's square shares begins here, where this is the second surface.
    const M matt = surfaces_.is_matt(at) & !missed;
    const M glossy = surfaces_.has_glossy() ? surfaces_.is_glossy(at) & !missed : no_lanes<F>();
    if (counts_chance()) note_way(s, matt | glossy, ended);
    if (sharing_) begin_tails(s, at, surfaces_.without_smooth(matt, at));
    if (looks_apart_) s.lamps.specular = select(matt | glossy, abs(s.lamps.specular), s.lamps.specular);

    // Light from the lamps.
    s.throughput = s.throughput * surfaces_.colour(at);
    const V wo = s.ray.direction * F(-1.0f), coloured = s.throughput;
    const HitNumbers<F> numbers{set<&Settings::sampler>(), s.key, LatticePlace<F>::of(s.depth + I(1))};
    if (lamps_.on()) add_direct_light(s, numbers, at, matt, glossy, wo);

    // A direction to go on in, and light from the lamps over spheres.
    const Point2<F> uv = numbers.pair(HitDimension::direction_u);
    const F lobe = surfaces_.has_glossy() ? numbers.lobe() : F(0.0f);
    ScatterSample<F> next = surfaces_.sample(at, wo, uv, lobe);
    surfaces_.keep_side(at, wo, next, lamps_.shares());
    const M crosses = next.crosses & !missed;
    // Ends of paths are shared and connected where a surface has one normal.
    const M plain = surfaces_.without_smooth(matt, at);
    if (connects() && any(plain)) connect(s, at, plain, wo, next.pdf_w);
    s.throughput = s.throughput * next.weight;
    if (surfaces_.has_glass()) {
      // Radiance in the medium behind is eta^2 times as large as on this side, so this much of it arrives.
      s.throughput = s.throughput * select(crosses, next.inverse_eta2, F(1.0f));
      s.ior2 = s.ior2 * select(crosses, next.eta2, F(1.0f));
    }

    // What each technique has to know at the next surface.
    if (connects()) s.chain.found.follow(surfaces_, s.ray, at, hit.t, plain & s.chain.connects, crosses);
    share_lamps(s, at, hit.t, matt, glossy, next.pdf_w);
    s.ray = {at.point, next.direction, at.surface};
    if (set<&Settings::max_depth>() > 0) ended = ended | !may_go_on(s);

    // Russian roulette.
    const F brightest = max_component(s.throughput);
    const F made_up = roulette(s, numbers, brightest, matt);
    s.throughput = s.throughput * made_up;
    ended = ended | !(brightest > F(0.0f)) | !(made_up > F(0.0f));
    if (sharing_) note_first(s, at, matt & !ended, wo, coloured * made_up);
    s.key = skip_dimensions<F>(s.key, hit_block_);
    s.depth = s.depth + I(1);
    return ended;
  }

  /// The light of lamps that the path has met by chance, and of surfaces that glow.
  void add_emission(PathState<F>& s, const Interaction<F>& at, F t, const M& lamp, const M& missed) {
    M shines = lamp & at.front & (s.lamps.next > F(0.0f));
    if (features.glow && scene_.has_glow && set<&Settings::caustics>() != Caustics::only) shines = shines | !lamp;
    shines = shines & !missed;
    if ((!features.small_table || lamps_.shares()) && !any(shines)) return;
    if (counts_chance() && any(shines))
      chance_hits_.meet(as_int(surfaces_.value(Column::emitter, at)), s.way, max_component(s.throughput),
                        shines & s.place.is_busy());
    V emission = select(shines, surfaces_.vector(Column::emission_r, at), V::all(F(0.0f)));
    if (lamps_.shares() || light_traced() || connects())
      emission = emission * lamp_weight(scene_, surfaces_, lamps_, s, at, t, shines & lamp, light_traced(), connects());
    add_radiance(s, emission, shines & lamp, s.lamps.next);
  }

  /// How the path has come this far, where it did not end; `scatters`: at matt and glossy surfaces.
  void note_way(PathState<F>& s, const M& scatters, const M& ended) {
    static_assert(static_cast<int>(ChanceWay::mirrored) == 1 && static_cast<int>(ChanceWay::lit) == 2 &&
                  static_cast<int>(ChanceWay::lit_and_mirrored) == 3);
    const M mirrored = equal(s.depth, I(0)) & !scatters & !ended & s.place.is_busy();
    if (any(mirrored)) chance_hits_.begin_mirrored(mirrored);
    s.way = select(scatters, s.way | I(2), select(mirrored, I(1), s.way));
  }

  /// Light from the lamps that surfaces send on, by shadow rays.
  void add_direct_light(PathState<F>& s, const HitNumbers<F>& numbers, const Interaction<F>& at, const M& matt,
                        const M& glossy, const V& wo) {
    M asks = matt | glossy;
    if (set<&Settings::max_depth>() > 0) asks = asks & may_go_on(s);
    if (!any(asks)) return;
    const V light = lamps_.direct_light(numbers, at, asks, wo);
    if (!lamps_.glossy_shares()) {
      s.radiance = fma(s.throughput, light, s.radiance);
      return;
    }
    // From a lamp by way of a glossy surface to a matt one it is a caustic, which light paths find too.
    const F share = features.caustics ? select(glossy, s.lamps.specular, F(1.0f)) : F(1.0f);
    add_radiance(s, light * share, asks, share);
  }

  /// Adds light that arrives here, over the throughput. In the lanes of the mask, `share` is what counts of it.
  void add_radiance(PathState<F>& s, V light, const M& mask, F share) {
    if (sharing_ && light_traced()) {
      // The share depends on the first surface, if that was matt, so no other path can have this part of the tail.
      const M alone = mask & (share < F(1.0f)) & s.place.in_tail(sums_.places());
      if (any(alone)) {
        done_.add(s.throughput * light, s.place.at + I(sums_.places()), alone, writer());
        light = select(alone, V::all(F(0.0f)), light);
      }
    }
    s.radiance = fma(s.throughput, light, s.radiance);
  }

  /// Connects matt surfaces to lamps over spheres, where light paths do not come.
  void connect(PathState<F>& s, const Interaction<F>& at, const M& matt, const V& wo, F pdf_w) {
    s.chain.connects = s.chain.connects & !(matt & equal(s.depth, I(0)));
    s.chain.found.pdf_w = select(matt, pdf_w, s.chain.found.pdf_w);
    const M mask = matt & s.chain.connects & s.place.is_busy();
    if (any(mask)) connector_.add({at, wo, s.throughput, s.key, s.depth, s.place.at}, mask);
  }

  /// At the first matt surface.
  void note_first(PathState<F>& s, const Interaction<F>& at, const M& matt, const V& wo, const V& throughput) const {
    FirstMatt<F>& x = s.first;
    const M first = matt & equal(x.class_and_side, I(FirstMatt<F>::none));
    // What a tail holds depends on whether the first surface was specular, and its length on where a limit leaves it.
    const I of_class = set<&Settings::max_depth>() > 0 ? s.depth : select(less(I(0), s.depth), I(1), I(0));
    x.class_and_side = select(first, of_class + of_class + select(at.front, I(1), I(0)), x.class_and_side);
    if (surfaces_.has_smooth()) x.class_and_side = select(first & at.smooth, I(FirstMatt<F>::past), x.class_and_side);
    if (!surfaces_.has_rough_matt()) return;
    x.throughput = select(first, throughput, x.throughput);
    x.wo = select(first, wo, x.wo);
  }

  /// At the surface after that.
  void begin_tails(PathState<F>& s, const Interaction<F>& at, const M& matt) {
    const M second = less(I(FirstMatt<F>::none), s.first.class_and_side) & s.place.is_busy();
    if (!any(second)) return;
    const M tailed = second & matt & surfaces_.is_even(at);
    const I& noted = s.first.class_and_side;
    const FirstDiffuse<F> x{s.ray, equal(noted & I(1), I(1)), noted >> 1,
                            surfaces_.has_rough_matt() ? s.first.throughput : s.throughput, s.first.wo};
    sharing_->add(x, at, tailed, s.place.at, second);
    s.first.class_and_side = select(second, I(FirstMatt<F>::past), s.first.class_and_side);
    if (!any(tailed)) return;
    done_.add(s.radiance, s.place.at, tailed, writer());
    s.place.at = s.place.at + select(tailed, I(sums_.places()), I(0));
    s.radiance = select(tailed, V::all(F(0.0f)), s.radiance);
    s.throughput = select(tailed, V::all(F(1.0f)), s.throughput);
  }

  /// What counts of the lamps that the path finds by chance from here on.
  void share_lamps(PathState<F>& s, const Interaction<F>& at, F distance, const M& matt, const M& glossy,
                   F pdf_w) const {
    F& specular = s.lamps.specular;
    const Caustics caustics = set<&Settings::caustics>();
    if (caustics == Caustics::off) specular = select(matt, F(0.0f), specular);
    if (caustics == Caustics::only) specular = select(matt & !(specular > F(0.0f)), F(1.0f), specular);
    if (light_traced()) {
      const F cos_o = surfaces_.flat_cos(at, s.ray.direction * F(-1.0f), at.cos_o);
      const F chance = F(1.0f) - light_path_share(scene_, pinhole_importance(scene_, s.ray.direction, distance, cos_o));
      specular = select(matt & equal(s.depth, I(0)), chance, specular);
    }
    const bool by_chance = (!lamps_.on() || lamps_.matt_shares()) && caustics != Caustics::only;
    s.lamps.next = select(matt, F(by_chance ? 1.0f : 0.0f), features.caustics ? specular : F(1.0f));
    if (!lamps_.shares()) return;
    const M shared = lamps_.matt_shares() ? (lamps_.glossy_shares() ? matt | glossy : matt) : glossy;
    s.lamps.pdf_w = select(shared, pdf_w, F(0.0f));
  }

  /// Where no limit of depth forbids another surface.
  M may_go_on(const PathState<F>& s) const { return less(s.depth, I(set<&Settings::max_depth>() - 1)); }

  /// Notes what the paths that ended have gathered.
  void finish(PathState<F>& s, const M& ended) {
    done_.add(s.radiance, s.place.at, ended, writer());
    s.place.at = select(ended, I(PathPlace<F>::no_path), s.place.at);
  }

  auto writer() const {
    return [&sums = sums_](std::int32_t path, float r, float g, float b) { sums.add(path, r, g, b); };
  }

  /// Ends paths at random, whose factor is then 0, and makes up for it in those that go on.
  F roulette(const PathState<F>& s, const HitNumbers<F>& numbers, F brightest, const M& matt) const {
    const bool constant = set<&Settings::roulette>() == Roulette::constant;
    const M trapped = !less(s.depth, I(trapped_depth));
    // The square of the index is left out: it comes back when the path leaves the glass.
    const F share = brightest * s.ior2 * F(over_roulette_below_);
    const M late = (share < F(1.0f)) & !less(s.depth, I(set<&Settings::roulette_depth>()));
    const M plays = trapped | (constant ? matt : late);
    if (!any(plays)) return F(1.0f);
    const F survival = constant ? F(constant_survival) : min(share, F(largest_survival));
    const M lives = numbers.number(HitDimension::roulette) < survival;
    return select(plays, select(lives, reciprocal(survival), F(0.0f)), F(1.0f));
  }

  bool light_traced() const { return features.caustics && light_traced_; }
  bool connects() const { return features.caustics && connects_; }
  bool counts_chance() const { return features.caustics && chance_hits_.on(); }
  /// The value of a setting.
  template <auto member>
  auto set() const {
    return setting<features, member>(scene_);
  }

  static constexpr float constant_survival = 0.75f;  ///< the report's
  static constexpr int trapped_depth = 64;           ///< constant roulette is played by specular paths too from here on
  const CompiledScene& scene_;
  Surfaces<F, features> surfaces_;
  NextEvent<F, features> lamps_;
  PathSums<F>& sums_;
  bool light_traced_;
  TailSharing<F, features>* sharing_;
  std::uint32_t hit_block_;  ///< dimensions of a hit
  float over_roulette_below_;
  bool connects_;
  bool looks_apart_ = false;  ///< small lamps that the camera sees are counted by LampImages
  Connector<F, features> connector_;
  ChanceHits<F> chance_hits_;
  Results<F> done_;
};

template <class F>
void trace_block(const CompiledScene& scene, const PathBlock& block, float* rgb, std::span<std::uint64_t> by_chance) {
  const Squares<F> squares(block);
  const int places = Squares<F>::members * squares.plane;
  // Fresh memory for every block would cost a tenth of the time.
  static thread_local PathSums<F> sums;
  static thread_local TailTable table;
  sums.begin(places);
  CameraRays<F> rays(scene, squares);
  with_features(scene, [&](auto features) {
    std::optional<TailSharing<F, features()>> sharing;
    if (setting<features(), &Settings::path_sharing>(scene) == PathSharing::on) {
      table.begin(places);
      sharing.emplace(scene, table);
    }
    PathTracer<F, features()>(scene, sums, scene.light_paths > 0, sharing ? &*sharing : nullptr, by_chance).run(rays);
    if (sharing) sharing->share(squares, sums);
    if (!scene.lamp_edges.empty()) LampEdges<F, features()>(scene, squares).refine(sums);
    if (!scene.lamp_images.empty()) LampImages<F, features()>(scene, squares).add(sums);
  });
  for (int sample = 0; sample < block.samples; ++sample)
    for (int y = block.y0; y < block.y0 + block.height; ++y)
      for (int x = block.x0; x < block.x0 + block.width; ++x) {
        const int place = squares.place(x, y, sample);
        for (int c = 0; c < 3; ++c) *rgb++ = sums.channel(c)[place];
      }
}

template <class F>
Rgb trace_given_ray(const CompiledScene& scene, const GivenPath& path) {
  GivenRay<F> ray(scene, path);
  PathSums<F> sums;
  sums.begin(1);
  with_features(scene, [&](auto features) { PathTracer<F, features()>(scene, sums, false, nullptr, {}).run(ray); });
  return {sums.channel(0)[0], sums.channel(1)[0], sums.channel(2)[0]};
}

}  // namespace glimt
