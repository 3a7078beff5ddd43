#pragma once

#include <algorithm>
#include <bit>
#include <vector>

#include "kernel/caustics/found_chain.h"
#include "kernel/caustics/sphere_chain.h"
#include "kernel/entry/features.h"
#include "kernel/lamps/sample_lamp.h"
#include "kernel/scattering/surfaces.h"
#include "kernel/transport/path_sums.h"
#include "kernel/transport/random.h"

/// Connections of a diffuse surface x to a point y of a lamp over one specular sphere (Walter, Zhao, Holzschuch and
/// Bala, "Single scattering in refractive media with triangle mesh boundaries", 2009; Hanika, Droske and Fascione,
/// "Manifold next event estimation", 2015). They find caustics that are seen in a mirror or through glass, which light
/// paths cannot reach. BSDF sampling finds the same chains; the balance heuristic combines the two (Veach 1997).
namespace glimt {

/// A diffuse surface to connect, as the path meets it.
template <class F>
struct ConnectionPoint {
  Interaction<F> at;
  Vec3<F> wo;
  Vec3<F> throughput;  ///< includes the reflectance of x
  PathKey<F> key;
  Int<F> depth, path;
};

template <class F, Features features>
class Connector {
  using I = Int<F>;
  using U = Uint<F>;
  using M = Mask<F>;
  using V = Vec3<F>;

 public:
  explicit Connector(const CompiledScene& scene) : scene_(scene), surfaces_(scene) {}

  /// Makes room for this many sums.
  void begin(std::size_t sums) {
    sums_.assign(3 * sums, 0.0f);
    ConnectionPoint<F> none;
    visit(none, [](auto&, auto& places) { places.fill({}); });
  }

  /// Connects the lanes in the mask, now or later: diffuse surfaces wait until they fill all lanes of a batch.
  void add(ConnectionPoint<F> p, const M& mask) {
    visit(p, [&]<class N>(N& value, auto& places) {
      compress<N, F>(value, mask, places.data() + static_cast<std::ptrdiff_t>(count_));
    });
    count_ += std::popcount(bits(mask));
    if (count_ < lane_count<F>) return;
    connect(lane_count<F>);
    count_ -= lane_count<F>;
    visit(p, [](auto&, auto& places) { std::copy_n(places.begin() + lane_count<F>, lane_count<F>, places.begin()); });
  }

  /// Adds to each sum what connections found, in the order of the path's surfaces. Other paths do not change this
  /// order.
  void finish(PathSums<F>& sums) {
    if (count_ > 0) connect(count_);
    count_ = 0;
    for (std::size_t i = 0; i < sums_.size() / 3; ++i)
      sums.add(static_cast<std::int32_t>(i), sums_[3 * i], sums_[3 * i + 1], sums_[3 * i + 2]);
  }

 private:
  template <class T>
  using Waiting = std::array<T, 3 * lane_count<F>>;

  /// Calls f(number, its places) for every number that is kept of a point.
  template <class Function>
  void visit(ConnectionPoint<F>& p, Function f) {
    auto numbers = numbers_.begin();
    for (V* v : {&p.at.point, &p.at.normal, &p.wo, &p.throughput})
      for (F* x : {&v->x, &v->y, &v->z}) f(*x, *numbers++);
    f(p.at.cos_o, *numbers);
    auto integers = integers_.begin();
    for (I* i : {&p.at.surface, &p.depth, &p.path}) f(*i, *integers++);
    auto keys = keys_.begin();
    for (U* u : {&p.key.a, &p.key.b, &p.key.index}) f(*u, *keys++);
  }

  struct ChosenPoint {
    LampPoint<F> on;
    V weight;         ///< radiance / pdf_a
    F inverse_pdf_a;  ///< m^2
    I first_surface, last_surface;
  };

  template <bool one>
  ChosenPoint chosen_point(const LampRow<F, one>& lamp, const Point2<F>& uv) const {
    const F area = lamp[LampColumn::area_factor];
    return {lamp_point<features.one_parallelogram>(scene_, lamp, uv.u, uv.v), lamp.vector(LampColumn::weight_r) * area,
            lamp[LampColumn::inverse_choice] * area, as_int(lamp[LampColumn::first_surface]),
            as_int(lamp[LampColumn::last_surface])};
  }

  ChosenPoint choose_point(const ConnectionPoint<F>& p, int rays, int k) const {
    const Sampler sampler = setting<features, &Settings::sampler>(scene_);
    const auto place = LatticePlace<F>::of(p.depth + I(1));
    const Point2<F> uv =
        random_pair<F>(sampler, p.key, place, static_cast<std::uint32_t>(HitDimension::lamp_u), rays, k);
    if (features.one_parallelogram || scene_.lamps.rows() == 1)
      return chosen_point(LampRow<F, true>{scene_.lamps, I(0)}, uv);
    const F which = random_number<F>(sampler, p.key, place, static_cast<std::uint32_t>(HitDimension::lamp), rays, k);
    return chosen_point(LampRow<F, false>{scene_.lamps, choose_lamp(scene_, which)}, uv);
  }

  /// One of the chains between two points, chosen in proportion to the light it brings if nothing hides it.
  struct Choice {
    F left;          ///< what is left of a uniform number in [0, 1), for further choices
    F sum;           ///< light of all chains
    V colour;        ///< reflectance of the chosen chain's sphere
    V from_x, exit;  ///< direction in which it leaves x; point where it leaves the sphere
    V to_y;
    F x_length, y_length;
    I surface;  ///< of the sphere

    /// Offers another chain (Chao, "A general purpose unequal probability sampling plan", 1982).
    void offer(const SphereChain<F>& chain, const M& lit, F light, const V& of_colour, const ChainSphere& sphere) {
      const F before = sum;
      sum = sum + select(lit, light, F(0.0f));
      const F place = left * sum;
      const M taken = lit & (place < light), kept = lit & !taken;
      left = select(taken, place * reciprocal(light), select(kept, (place - light) * reciprocal(before), left));
      left = min(left, F(1 - 0x1p-24f));
      colour = select(taken, of_colour, colour);
      from_x = select(taken, chain.from_x, from_x);
      exit = select(taken, fma(chain.y_normal, F(sphere.radius), broadcast<F>(sphere.center)), exit);
      to_y = select(taken, chain.from_y * F(-1.0f), to_y);
      x_length = select(taken, chain.x_length, x_length);
      y_length = select(taken, chain.y_length, y_length);
      surface = select(taken, I(sphere.surface), surface);
    }
  };

  /// Connects the first `count` waiting surfaces.
  [[gnu::noinline]] void connect(int count) {
    ConnectionPoint<F> p;
    visit(p, []<class N>(N& value, auto& places) { value = load<N>(places.data()); });
    if (surfaces_.has_rough_matt()) {
      surfaces_.find_row(p.at);
      surfaces_.look_up_kind(p.at);
    }
    const M active = less(lane_numbers<F>(), I(count));
    const int rays = setting<features, &Settings::shadow_rays>(scene_);
    V found = V::all(F(0.0f));
    for (int k = 0; k < rays; ++k) {
      const ChosenPoint lamp = choose_point(p, rays, k);
      Choice choice{};
      choice.left =
          random_number<F>(setting<features, &Settings::sampler>(scene_), p.key, LatticePlace<F>::of(p.depth + I(1)),
                           static_cast<std::uint32_t>(HitDimension::roulette), rays, k);
      for (const ChainSphere& sphere : scene_.chain_spheres) offer_chains(p, lamp, sphere, active, choice);
      found = found + arriving(p, lamp, choice);
    }
    found = found * p.throughput;
    std::array<float, lane_count<F>> r, g, b;
    std::array<std::int32_t, lane_count<F>> path;
    store(found.x, r.data()), store(found.y, g.data()), store(found.z, b.data()), store(p.path, path.data());
    for (std::size_t i = 0; i < static_cast<std::size_t>(count); ++i) {
      float* sum = sums_.data() + 3 * static_cast<std::ptrdiff_t>(path[i]);
      sum[0] += r[i];
      sum[1] += g[i];
      sum[2] += b[i];
    }
  }

  /// Whether max_depth allows this many more surfaces and a lamp.
  M has_depth(const ConnectionPoint<F>& p, int surfaces) const {
    const int limit = setting<features, &Settings::max_depth>(scene_);
    return limit > 0 ? less(p.depth, I(limit - 1 - surfaces)) : all_lanes<F>();
  }

  /// Offers the chains from x to the point of the lamp over one sphere.
  void offer_chains(const ConnectionPoint<F>& p, const ChosenPoint& lamp, const ChainSphere& sphere, const M& active,
                    Choice& choice) const {
    const V center = broadcast<F>(sphere.center);
    const V x_way = p.at.point - center, y_way = lamp.on.point - center;
    const F x2 = dot(x_way, x_way), y2 = dot(y_way, y_way);
    const F x_inverse = inverse_sqrt(x2), y_inverse = inverse_sqrt(y2);
    const F radius(sphere.radius);
    const ChainEnd<F> x = chain_end(x2 * x_inverse, radius), y = chain_end(y2 * y_inverse, radius);
    const ChainPlane<F> plane = chain_plane(x_way * x_inverse, y_way * y_inverse);
    const auto of_surface = [&](Column c) { return scene_.surfaces[c][sphere.surface]; };
    const V colour = broadcast<F>(of_surface(Column::reflectance_r), of_surface(Column::reflectance_g),
                                  of_surface(Column::reflectance_b));
    // `chosen`: the probability that a path by BSDF sampling keeps to the chain once it has begun.
    const auto offer = [&](const SphereChain<F>& chain, F chosen, int surfaces) {
      const F cos_x = dot(chain.from_x, p.at.normal), cos_y = dot(chain.from_y, lamp.on.normal);
      const M lit = active & has_depth(p, surfaces) & chain.exists & (cos_x > F(0.0f)) & (cos_y > F(0.0f));
      const F chance = cos_x * F(std::numbers::inv_pi_v<float>) * chosen;
      const F lamps =
          F(static_cast<float>(setting<features, &Settings::shadow_rays>(scene_))) * chain.tube * reciprocal(cos_y);
      const F light = chance * reciprocal(fma(chance, lamp.inverse_pdf_a, lamps));
      choice.offer(chain, lit & (light > F(0.0f)), light, colour, sphere);
    };
    const SphereChain<F> reflected = reflected_chain(plane, x, y);
    if (!sphere.glass) return offer(reflected, F(1.0f), 1);
    const F eta(of_surface(Column::eta));
    const M schlick = F(of_surface(smooth_glass_schlick)) > F(0.5f);
    const auto share = [&](F cos) { return fresnel(cos, eta, reciprocal(eta), schlick).reflected; };
    offer(reflected, share(reflected.cos_theta), 1);
    if (!sphere.refracts) return;
    for (const SphereChain<F>& chain : refracted_chains(plane, x, y, eta)) {
      const F passed = F(1.0f) - share(chain.cos_theta);
      offer(chain, passed * passed, 2);
    }
  }

  /// Light from the point of the lamp by the chosen chain, times the BRDF of x divided by reflectance / pi.
  V arriving(const ConnectionPoint<F>& p, const ChosenPoint& lamp, const Choice& choice) const {
    M lit = choice.sum > F(0.0f);
    if (!any(lit)) return V::all(F(0.0f));
    lit = lit & !occluded<F, features, true>(scene_, {p.at.point, choice.from_x, p.at.surface}, choice.x_length,
                                             choice.surface, choice.surface, lit);
    lit = lit & !occluded<F, features>(scene_, {choice.exit, choice.to_y, choice.surface}, choice.y_length,
                                       lamp.first_surface, lamp.last_surface, lit);
    V weight = lamp.weight * choice.colour * choice.sum;
    // Lanes without a chain may hold NaN.
    if (surfaces_.has_rough_matt())
      weight = weight * surfaces_.evaluate_matt(p.at, choice.from_x, p.wo, dot(choice.from_x, p.at.normal), p.at.cos_o);
    return select(lit, weight, V::all(F(0.0f)));
  }

  const CompiledScene& scene_;
  Surfaces<F, features> surfaces_;
  std::vector<float> sums_;  ///< as in PathSums, three channels
  std::array<Waiting<float>, 13> numbers_;
  std::array<Waiting<std::int32_t>, 3> integers_;
  std::array<Waiting<std::uint32_t>, 3> keys_;
  int count_ = 0;  ///< surfaces that wait
};

}  // namespace glimt
