#pragma once

#include <bit>
#include <optional>

#include "kernel/caustics/connect.h"
#include "kernel/caustics/found_chain.h"
#include "kernel/geometry/camera.h"
#include "kernel/geometry/cutaway.h"
#include "kernel/geometry/pinhole.h"
#include "kernel/lamps/lamp_edges.h"
#include "kernel/scattering/shading.h"
#include "kernel/sharing/tail_sharing.h"
#include "kernel/transport/results.h"
#include "kernel/transport/trace.h"

/// The path loop: one path a lane, no recursion. A lane whose path has ended takes the next path at once.
namespace glimt {

/// The state of one path a lane, between two surfaces.
template <class F>
struct PathState {
  Ray<F> ray;
  Vec3<F> throughput;  ///< product of bsdf cos / pdf so far, radiance to radiance
  Vec3<F> radiance;    ///< gathered so far, W/(m^2 sr)
  F ior2;              ///< square of the refractive index here over that at the camera; 1 without glass
  F lamp_share;        ///< of the radiance of a lamp that is hit next: what counts, where MIS does not say so
  F caustic_share;     ///< the same for lamps that are hit from a mirror or glass
  F pdf_w;             ///< with which a diffuse surface chose the direction, if it was the last; else 0
  FoundChain<F> chain;
  Mask<F> connects;  ///< diffuse surfaces are connected to lamps over spheres: the first surface was specular
  PathKey<F> key;    ///< its dimension 0 is the first of the next hit
  Int<F> depth;      ///< surfaces hit before
  Int<F> path;       ///< where its radiance belongs in PathSums, or -1 for a lane without work
  Int<F> first;      ///< of the first diffuse surface, if it was the last, its class and side; first_none, first_past
  Vec3<F> first_throughput, first_wo;  ///< there, where it may be rough
};

template <class F, Features features>
class PathTracer {
  using I = Int<F>;
  using U = Uint<F>;
  using M = Mask<F>;
  using V = Vec3<F>;

 public:
  /// `light_traced`: the paths are the camera's, and light paths do their part. `sharing`: null where there is none.
  PathTracer(const CompiledScene& scene, PathSums<F>& sums, bool light_traced, TailSharing<F, features>* sharing)
      : scene_(scene),
        surfaces_(scene),
        sums_(sums),
        light_traced_(light_traced),
        sharing_(sharing),
        hit_block_(hit_dimensions(scene.settings.shadow_rays)),
        over_roulette_below_(static_cast<float>(1 / scene.settings.roulette_below)),
        next_event_(choices().light_sampling != LightSampling::none && scene.lamps.rows() > 0 &&
                    scene.settings.caustics != Caustics::only),
        mis_(next_event_ && choices().mis == Mis::on),
        connects_(!scene.chain_spheres.empty()),
        connector_(scene) {}

  /// Traces all paths of the source and adds up what each one gathers.
  void run(PathSource<F>& source) {
    PathQueue<F> queue;
    PathState<F> s{};
    s.path = I(-1);
    s.ior2 = F(1.0f);
    s.lamp_share = s.caustic_share = F(0.0f);
    s.connects = F(1.0f) < F(0.0f);
    s.chain = {I(chain_none), F(0.0f), F(0.0f)};
    if (connects()) connector_.begin(sums_.size());
    const V origin = source.origin();
    s.ray = {origin, {F(0.0f), F(0.0f), F(1.0f)}, I(-1)};
    for (;;) {
      const M idle = less(s.path, I(0));
      if (any(idle)) {
        begin_paths(source, origin, queue, s, idle);
        if (!any(less(I(-1), s.path))) break;
      }
      const M ended = step(s) & less(I(-1), s.path);
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
    s.path = expand<I, F>(s.path, idle, &q.path[place]);
    s.throughput = select(idle, V::all(F(1.0f)), s.throughput);
    s.radiance = select(idle, V::all(F(0.0f)), s.radiance);
    if (scene_.has_glass) s.ior2 = select(idle, F(1.0f), s.ior2);
    const F share(caustics() == Caustics::only ? 0.0f : 1.0f);
    s.lamp_share = select(idle, share, s.lamp_share);
    if (features.caustics) s.caustic_share = select(idle, share, s.caustic_share);
    s.depth = select(idle, I(0), s.depth);
    if (sharing_) s.first = select(idle, I(first_none), s.first);
    if (connects()) {
      s.chain.stage = select(idle, I(chain_none), s.chain.stage);
      s.connects = s.connects | idle;
    }
    q.next += wanted;
  }

  /// One surface for every lane; returns the lanes whose paths end there.
  M step(PathState<F>& s) {
    const Hit<F> hit = path_hit<F, features>(scene_, surfaces_, s.ray, equal(s.depth, I(0)));
    const M missed = !(hit.t < F(std::numeric_limits<float>::infinity()));
    const Shading<F> at = surfaces_.shade(s.ray, hit);
    const M light = equal(at.kind, I(kind_light));
    M ended = missed | light;

    add_emission(s, at, hit.t, light, missed);
    const M diffuse = equal(at.kind, I(kind_diffuse)) & !missed;
    const M glass = equal(at.kind, I(kind_glass)) & !missed;
    if (sharing_) begin_tails(s, at, diffuse);
    s.throughput = s.throughput * surfaces_.reflectance(at);
    const V wo = s.ray.direction * F(-1.0f), reflected = s.throughput;
    V direction = s.ray.direction;
    const Point2<F> uv = pair(s, HitDimension::direction_u);
    M enters = F(1.0f) < F(0.0f);
    if (any(diffuse)) scatter_diffuse(s, at, diffuse, uv, direction);
    if (scene_.has_mirror) {
      const M mirror = equal(at.kind, I(kind_mirror));
      direction = select(mirror, surfaces_.mirrored(s.ray.direction, at), direction);
    }
    if (scene_.has_glass && any(glass)) {
      const GlassScatter<F> scatter = surfaces_.scatter_glass(s.ray.direction, at, uv.u);
      direction = select(glass, scatter.direction, direction);
      // Radiance in the medium behind is eta^2 times as large as on this side, so this much of it arrives.
      enters = glass & scatter.enters;
      s.throughput = s.throughput * select(enters, scatter.inverse_eta2, F(1.0f));
      s.ior2 = s.ior2 * select(enters, scatter.eta2, F(1.0f));
    }
    if (connects()) s.chain.follow(surfaces_, s.ray, at, hit.t, diffuse & s.connects, enters);
    share_caustics(s, at, hit.t, diffuse);
    s.ray = {at.point, direction, at.surface};
    if (mis_) s.pdf_w = select(diffuse, s.pdf_w, F(0.0f));
    if (choices().max_depth > 0) ended = ended | !may_go_on(s);
    const F brightest = max_component(s.throughput);
    const F made_up = roulette(s, brightest, diffuse);
    s.throughput = s.throughput * made_up;
    ended = ended | !(brightest > F(0.0f)) | !(made_up > F(0.0f));
    if (sharing_) note_first(s, at, diffuse & !ended, wo, reflected * made_up);
    s.key = skip_dimensions<F>(s.key, hit_block_);
    s.depth = s.depth + I(1);
    return ended;
  }

  /// At the first diffuse surface.
  void note_first(PathState<F>& s, const Shading<F>& at, const M& diffuse, const V& wo, const V& throughput) const {
    const M first = diffuse & equal(s.first, I(first_none));
    // What a tail holds depends on whether the first surface was specular, and its length on where a limit leaves it.
    const I of_class = choices().max_depth > 0 ? s.depth : select(less(I(0), s.depth), I(1), I(0));
    s.first = select(first, of_class + of_class + select(at.front, I(1), I(0)), s.first);
    if (!surfaces_.has_rough()) return;
    s.first_throughput = select(first, throughput, s.first_throughput);
    s.first_wo = select(first, wo, s.first_wo);
  }

  /// At the surface after that.
  void begin_tails(PathState<F>& s, const Shading<F>& at, const M& diffuse) {
    const M second = less(I(first_none), s.first) & less(I(-1), s.path);
    if (!any(second)) return;
    const M tailed = second & diffuse & sharing_->is_matt(at);
    const bool rough = surfaces_.has_rough();
    const FirstDiffuse<F> x{s.ray, equal(s.first & I(1), I(1)), s.first >> 1, rough ? s.first_throughput : s.throughput,
                            s.first_wo};
    sharing_->add(x, at, tailed, s.path, second);
    s.first = select(second, I(first_past), s.first);
    if (!any(tailed)) return;
    done_.add(s.radiance, s.path, tailed, writer());
    s.path = s.path + select(tailed, I(sums_.places()), I(0));
    s.radiance = select(tailed, V::all(F(0.0f)), s.radiance);
    s.throughput = select(tailed, V::all(F(1.0f)), s.throughput);
  }

  /// What counts of the lamps that the path finds by chance from here on.
  void share_caustics(PathState<F>& s, const Shading<F>& at, F distance, const M& diffuse) const {
    if (caustics() == Caustics::off) s.caustic_share = select(diffuse, F(0.0f), s.caustic_share);
    if (caustics() == Caustics::only)
      s.caustic_share = select(diffuse & !(s.caustic_share > F(0.0f)), F(1.0f), s.caustic_share);
    if (light_traced()) {
      const F chance =
          F(1.0f) - light_path_share(scene_, pinhole_importance(scene_, s.ray.direction, distance, at.cos_o));
      s.caustic_share = select(diffuse & equal(s.depth, I(0)), chance, s.caustic_share);
    }
    const bool lamps = !next_event_ && caustics() != Caustics::only;
    const F after_specular = features.caustics ? s.caustic_share : F(1.0f);
    s.lamp_share = select(diffuse, F(lamps ? 1.0f : 0.0f), after_specular);
  }

  /// Where no limit of depth forbids another surface.
  M may_go_on(const PathState<F>& s) const { return less(s.depth, I(choices().max_depth - 1)); }

  /// Notes what the paths that ended have gathered.
  void finish(PathState<F>& s, const M& ended) {
    done_.add(s.radiance, s.path, ended, writer());
    s.path = select(ended, I(-1), s.path);
  }

  auto writer() const {
    return [&sums = sums_](std::int32_t path, float r, float g, float b) { sums.add(path, r, g, b); };
  }

  /// Random numbers of a hit; of several, number `k` of `count`.
  Point2<F> pair(const PathState<F>& s, HitDimension dimension, int count = 1, int k = 0) const {
    return random_pair<F>(choices().sampler, s.key, LatticePlace<F>::of(s.depth + I(1)),
                          static_cast<std::uint32_t>(dimension), count, k);
  }
  F number(const PathState<F>& s, HitDimension dimension, int count = 1, int k = 0) const {
    return random_number<F>(choices().sampler, s.key, LatticePlace<F>::of(s.depth + I(1)),
                            static_cast<std::uint32_t>(dimension), count, k);
  }

  void add_emission(PathState<F>& s, const Shading<F>& at, F t, const M& light, const M& missed) {
    M shines = light & at.front;
    const M counts = s.lamp_share > F(0.0f);
    shines = shines & (mis_ ? counts | (s.pdf_w > F(0.0f)) : counts);
    if (features.rare && scene_.has_glow && caustics() != Caustics::only) shines = shines | !light;
    shines = shines & !missed;
    if ((!features.small_table || mis_) && !any(shines)) return;
    V emission = select(shines, surfaces_.vector(Column::emission_r, at), V::all(F(0.0f)));
    if (mis_) {
      const I row = as_int(surfaces_.value(Column::lamp, at));
      const M shared = light & !counts & less(I(-1), row);
      const F q = s.pdf_w * lamp_inverse_pdf(scene_, select(shared, row, I(0)), s.ray.origin, t, at.cos_o);
      const F m(static_cast<float>(scene_.settings.shadow_rays));
      const F weight = max(fnma(m, reciprocal(q + m), F(1.0f)), F(0.0f));
      emission = emission * select(shared, weight, F(1.0f));
    }
    if (light_traced()) emission = emission * select(light & counts, s.lamp_share, F(1.0f));
    if (connects()) {
      M chained = shines & light & s.chain.complete();
      if (any(chained)) {
        const I row = as_int(surfaces_.value(Column::lamp, at));
        chained = chained & less(I(-1), row);
        const F share = chance_share(scene_, surfaces_, s.chain, s.ray, at, select(chained, row, I(0)));
        emission = emission * select(chained, share, F(1.0f));
      }
    }
    if (sharing_ && light_traced()) {
      // What counts by chance depends on the first surface, if that was diffuse, so no other can have it.
      const M alone = shines & light & counts & (s.caustic_share < F(1.0f)) & less(I(sums_.places() - 1), s.path);
      if (any(alone)) {
        done_.add(s.throughput * emission, s.path + I(sums_.places()), alone, writer());
        emission = select(alone, V::all(F(0.0f)), emission);
      }
    }
    s.radiance = fma(s.throughput, emission, s.radiance);
  }

  /// Next-event estimation, then a direction in proportion to the cosine. The throughput has the reflectance already.
  void scatter_diffuse(PathState<F>& s, const Shading<F>& at, const M& diffuse, const Point2<F>& uv, V& direction) {
    const V wo = s.ray.direction * F(-1.0f);
    if (next_event_) {
      const M asks = choices().max_depth > 0 ? diffuse & may_go_on(s) : diffuse;
      if (any(asks)) s.radiance = fma(s.throughput, direct_light(s, at, asks, wo), s.radiance);
    }
    const V wi = cosine_hemisphere(at.normal, uv.u, uv.v);
    const bool rough = surfaces_.has_rough();
    if (rough || mis_ || connects()) {
      const F cos_i = dot(wi, at.normal);
      s.pdf_w = cos_i * F(std::numbers::inv_pi_v<float>);
      if (connects()) connect(s, at, diffuse, wo);
      if (rough)
        s.throughput = s.throughput * select(diffuse, surfaces_.diffuse_factor(at, wi, wo, cos_i), V::all(F(1.0f)));
    }
    direction = select(diffuse, wi, direction);
  }

  void connect(PathState<F>& s, const Shading<F>& at, const M& diffuse, const V& wo) {
    s.connects = s.connects & !(diffuse & equal(s.depth, I(0)));
    s.chain.pdf_w = select(diffuse, s.pdf_w, s.chain.pdf_w);
    const M mask = diffuse & s.connects & less(I(-1), s.path);
    if (any(mask)) connector_.add({at, wo, s.throughput, s.key, s.depth, s.path}, mask);
  }

  /// Light that comes straight from the lamps, times the BRDF over the reflectance.
  V direct_light(const PathState<F>& s, const Shading<F>& at, const M& asks, const V& wo) const {
    const int rays = scene_.settings.shadow_rays;
    const F scale(std::numbers::inv_pi_v<float> / static_cast<float>(rays));
    const bool several = !features.one_parallelogram && scene_.lamps.rows() > 1;
    V direct = V::all(F(0.0f));
    for (int k = 0; k < rays; ++k) {
      const F which = several ? number(s, HitDimension::lamp, rays, k) : F(0.0f);
      const Point2<F> uv = pair(s, HitDimension::lamp_u, rays, k);
      const LampSample<F> lamp = sample_lamp<F, features.one_parallelogram>(scene_, at.point, which, uv.u, uv.v);
      const F cos_i = dot(lamp.direction, at.normal);
      const M lit = asks & (cos_i > F(0.0f)) & (lamp.inverse_pdf > F(0.0f));
      if (!any(lit)) continue;
      const Ray<F> shadow{at.point, lamp.direction, at.surface};
      const M seen = lit & !occluded<F, features>(scene_, shadow, lamp.distance, lamp.first_surface, lamp.last_surface);
      F weight = cos_i * (lamp.inverse_pdf * scale);
      if (mis_) {
        // M rays here and one direction there (the balance heuristic): M / (M + pdf_w there / pdf_w here).
        const F m(static_cast<float>(rays));
        const F there = cos_i * F(std::numbers::inv_pi_v<float>);
        weight = weight * (m * reciprocal(fma(there, lamp.inverse_pdf * lamp.inverse_choice, m)));
      }
      // Lanes that do not see the lamp may hold values that are no numbers.
      if (surfaces_.has_eon()) {
        const V factor = surfaces_.diffuse_factor(at, lamp.direction, wo, cos_i) * weight;
        direct = fma(lamp.weight, select(seen, factor, V::all(F(0.0f))), direct);
      } else {
        if (surfaces_.has_oren_nayar())
          weight = weight * oren_nayar_factor(surfaces_.oren_nayar(at), lamp.direction, wo, cos_i, at.cos_o);
        direct = fma(lamp.weight, select(seen, weight, F(0.0f)), direct);
      }
    }
    return direct;
  }

  /// Ends paths at random, whose factor is then 0, and makes up for it in those that go on.
  F roulette(const PathState<F>& s, F brightest, const M& diffuse) const {
    const bool constant = scene_.settings.roulette == Roulette::constant;
    const M trapped = !less(s.depth, I(trapped_depth));
    // The square of the index is left out: it comes back when the path leaves the glass.
    const F share = brightest * s.ior2 * F(over_roulette_below_);
    const M late = (share < F(1.0f)) & !less(s.depth, I(scene_.settings.roulette_depth));
    const M plays = trapped | (constant ? diffuse : late);
    if (!any(plays)) return F(1.0f);
    const F survival = constant ? F(constant_survival) : min(share, F(largest_survival));
    const M lives = number(s, HitDimension::roulette) < survival;
    return select(plays, select(lives, reciprocal(survival), F(0.0f)), F(1.0f));
  }

  bool light_traced() const { return features.caustics && light_traced_; }
  bool connects() const { return features.caustics && connects_; }
  Caustics caustics() const { return features.caustics ? scene_.settings.caustics : Caustics::on; }
  const Settings& choices() const { return settings_of<features>(scene_); }

  static constexpr std::int32_t first_none = -1, first_past = -2;
  static constexpr float constant_survival = 0.75f;  ///< the report's
  static constexpr int trapped_depth = 64;           ///< constant roulette is played by specular paths too from here on
  const CompiledScene& scene_;
  Surfaces<F, features> surfaces_;
  PathSums<F>& sums_;
  bool light_traced_;
  TailSharing<F, features>* sharing_;
  std::uint32_t hit_block_;  ///< dimensions of a hit
  float over_roulette_below_;
  bool next_event_;
  bool mis_;
  bool connects_;
  Connector<F, features> connector_;
  Results<F> done_;
};

template <class F>
void trace_block(const CompiledScene& scene, const PathBlock& block, float* rgb) {
  const Squares<F> squares(block);
  const int places = Squares<F>::members * squares.plane;
  // Fresh memory for every block would cost a tenth of the time.
  static thread_local PathSums<F> sums;
  static thread_local TailTable table;
  sums.begin(places);
  CameraRays<F> rays(scene, squares);
  with_features(scene, [&](auto features) {
    std::optional<TailSharing<F, features()>> sharing;
    if (scene.settings.path_sharing == PathSharing::on) {
      table.begin(places);
      sharing.emplace(scene, table);
    }
    PathTracer<F, features()>(scene, sums, scene.light_paths > 0, sharing ? &*sharing : nullptr).run(rays);
    if (sharing) sharing->share(squares, sums);
    if (!scene.lamp_edges.empty()) LampEdges<F, features()>(scene, squares).refine(sums);
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
  with_features(scene, [&](auto features) { PathTracer<F, features()>(scene, sums, false, nullptr).run(ray); });
  return {sums.channel(0)[0], sums.channel(1)[0], sums.channel(2)[0]};
}

}  // namespace glimt
