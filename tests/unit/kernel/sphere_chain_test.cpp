#include "kernel/caustics/sphere_chain.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>
#include <random>
#include <vector>

#include "statistics_helpers.h"

using namespace glimt;
using glm::dvec3;

namespace {

constexpr double pi = std::numbers::pi;
constexpr double mirror = 0;  ///< for an index: reflection off the outside

dvec3 exact(const Vec3<float>& v) { return {v.x, v.y, v.z}; }

/// Two points outside a sphere of radius `radius` about the origin.
struct Ends {
  double index = mirror;  ///< of the sphere, relative
  double radius = 1;
  Vec3<float> to_x{}, to_y{};  ///< directions from the centre
  float x_distance = 0, y_distance = 0;

  dvec3 x() const { return normalize(exact(to_x)) * static_cast<double>(x_distance); }
  dvec3 y() const { return normalize(exact(to_y)) * static_cast<double>(y_distance); }
  /// Angle at the centre, in [0, pi].
  double phi() const {
    const dvec3 a = normalize(exact(to_x)), b = normalize(exact(to_y));
    return 2 * std::atan2(length(a - b), length(a + b));
  }
  double angle_end() const { return index != mirror && index < 1 ? std::asin(index) : pi / 2; }
  /// Angle at the centre by which a ray from x at angle of incidence theta has turned when it is as far as y.
  double turned(double theta) const {
    const double b = std::sin(theta);
    const double outside = 2 * theta - std::asin(radius / static_cast<double>(x_distance) * b) -
                           std::asin(radius / static_cast<double>(y_distance) * b);
    return index == mirror ? outside : outside + pi - 2 * std::asin(std::min(b / index, 1.0));
  }
};

std::ostream& operator<<(std::ostream& o, const Ends& e) {
  return o << std::hexfloat << "index " << e.index << ", radius " << e.radius << ", x (" << e.to_x.x << ", " << e.to_x.y
           << ", " << e.to_x.z << ") * " << e.x_distance << ", y (" << e.to_y.x << ", " << e.to_y.y << ", " << e.to_y.z
           << ") * " << e.y_distance << std::defaultfloat;
}

using Chain = SphereChain<float>;

/// The chains that exist.
std::vector<Chain> chains(const Ends& e) {
  const auto radius = static_cast<float>(e.radius);
  const ChainPlane<float> plane = chain_plane(e.to_x, e.to_y);
  const ChainEnd<float> x = chain_end(e.x_distance, radius), y = chain_end(e.y_distance, radius);
  std::vector<Chain> found;
  if (e.index == mirror) {
    found.push_back(reflected_chain(plane, x, y));
  } else {
    const auto all = refracted_chains(plane, x, y, static_cast<float>(e.index));
    found.assign(all.begin(), all.end());
  }
  std::erase_if(found, [](const Chain& c) { return !c.exists; });
  return found;
}

/// Ends of all kinds: near the sphere down to a millionth of its radius, far off, opposite, together, anywhere.
class RandomEnds {
 public:
  explicit RandomEnds(unsigned seed) : random_(seed) {}

  double number() { return uniform_(random_); }
  /// 10 to the power of a number between `low` and `high`.
  double magnitude(double low, double high) { return std::pow(10, low + (high - low) * number()); }

  Ends operator()(double index, bool hot) {
    Ends e{.index = static_cast<double>(static_cast<float>(index))};
    e.radius = static_cast<double>(static_cast<float>(magnitude(-3, 3)));
    const auto distance = [&] {
      const double kind = hot ? number() : 0.5;
      const double d = kind < 0.25 ? 1 + magnitude(-6, 0) : kind < 0.75 ? 1.05 + 4 * number() : magnitude(0.1, 4);
      return static_cast<float>(e.radius * d);
    };
    e.x_distance = distance(), e.y_distance = distance();
    double apart = pi * number();
    if (hot && number() < 0.3) apart = pi * magnitude(-5, 0);
    if (number() < 0.5) apart *= 0.3;
    if (e.index != mirror) apart = pi - apart;
    const auto gauss = [&] { return std::normal_distribution<>()(random_); };
    const dvec3 a = normalize(dvec3{gauss(), gauss(), gauss()});
    const dvec3 b = normalize(cross(a, dvec3{gauss(), gauss(), gauss()}));
    const dvec3 c = a * std::cos(apart) + b * std::sin(apart);
    const auto rounded = [](const dvec3& v) {
      return Vec3<float>{static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)};
    };
    e.to_x = rounded(a), e.to_y = rounded(c);
    return e;
  }

 private:
  std::mt19937_64 random_;
  std::uniform_real_distribution<> uniform_;
};

constexpr std::array<double, 9> indices{mirror, 1.005, 1.05, 1.33, 1.5, 2.4, 3, 0.97, 0.7};
constexpr int configurations = 400 * effort;  ///< for each index

/// `turned` at angles of incidence that lie so dense that it is monotone between them.
struct Scan {
  std::vector<double> angle, turned;
  int changes = 0;  ///< of direction

  explicit Scan(const Ends& e) {
    constexpr int steps = 1500;
    const double end = e.angle_end();
    for (int i = 0; i <= steps; ++i) add(e, end * i / steps);
    const std::vector<double> a = angle;
    for (std::size_t i = 1; i + 1 < a.size(); ++i) {
      const double before = turned[i] - turned[i - 1], after = turned[i + 1] - turned[i];
      if (before * after >= 0) continue;
      ++changes;
      // Golden section for the extremum between.
      const double sign = after > 0 ? 1 : -1, g = (std::sqrt(5.0) - 1) / 2;
      double low = a[i - 1], high = a[i + 1];
      for (int k = 0; k < 60; ++k) {
        const double p = high - g * (high - low), q = low + g * (high - low);
        (sign * e.turned(p) < sign * e.turned(q) ? high : low) = sign * e.turned(p) < sign * e.turned(q) ? q : p;
      }
      extrema.push_back((low + high) / 2);
    }
    for (const double x : extrema) add(e, x);
    std::vector<std::pair<double, double>> both;
    for (std::size_t i = 0; i < angle.size(); ++i) both.emplace_back(angle[i], turned[i]);
    std::ranges::sort(both);
    for (std::size_t i = 0; i < both.size(); ++i) std::tie(angle[i], turned[i]) = both[i];
  }

  /// Angles where the ray has turned by `target`.
  std::vector<double> roots(const Ends& e, double target) const {
    std::vector<double> found;
    for (std::size_t i = 0; i + 1 < angle.size(); ++i) {
      if ((turned[i] < target) == (turned[i + 1] < target)) continue;
      double low = angle[i], high = angle[i + 1];
      const bool rises = turned[i] < target;
      for (int k = 0; k < 60; ++k) ((e.turned((low + high) / 2) < target) == rises ? low : high) = (low + high) / 2;
      found.push_back((low + high) / 2);
    }
    return found;
  }

  /// How far `target` is from where the number of roots changes.
  double margin(const Ends& e, double target) const {
    double least = std::min(std::abs(e.turned(0) - target), std::abs(e.turned(e.angle_end()) - target));
    for (const double x : extrema) least = std::min(least, std::abs(e.turned(x) - target));
    return least;
  }

  std::vector<double> extrema;

 private:
  void add(const Ends& e, double x) {
    angle.push_back(x);
    turned.push_back(e.turned(x));
  }
};

/// The angle at the centre by which the chain's ray turns, and the error it may have.
struct Turned {
  double angle, tolerance;
};

Turned turned_by(const Ends& e, const Chain& c) {
  // sin(theta) from the nearer end, whose direction has it with more digits.
  const bool from_x = e.x_distance < e.y_distance;
  const dvec3 end = from_x ? normalize(e.x()) : normalize(e.y());
  const dvec3 way = normalize(exact(from_x ? c.from_x : c.from_y));
  const double distance = static_cast<double>(from_x ? e.x_distance : e.y_distance) / e.radius;
  const double b = std::min(length(cross(end, way)) * distance, std::sin(e.angle_end()));
  const double step = 4e-7 * distance;
  const auto at = [&](double sine) { return e.turned(std::asin(std::clamp(sine, 0.0, std::sin(e.angle_end())))); };
  return {at(b), 4e-6 + std::max(std::abs(at(b + step) - at(b)), std::abs(at(b - step) - at(b)))};
}

/// Whether the chain ends at y as nearly as floats can tell.
bool is_refined(const Ends& e, const Chain& c) {
  const Turned t = turned_by(e, c);
  return std::min(std::abs(t.angle - e.phi()), std::abs(t.angle - (2 * pi - e.phi()))) < t.tolerance;
}

// Against a dense scan of the angle of incidence in double. A target within 4e-6 of where the number of roots changes
// // (a fold, a grazing ray) may have more or fewer of them; all others must be found, and no more. A few, near a
// double root at a focus, are not refined to the last digit.
TEST(SphereChain, FindsEveryRootOfADenseScanAndNoOther) {
  RandomEnds random(1);
  int many = 0, roots_found = 0, unclear = 0, rough = 0;
  for (const double index : indices)
    for (int i = 0; i < configurations; ++i) {
      const Ends e = random(index, true);
      const Scan scan(e);
      ASSERT_LE(scan.changes, index > 1 ? 1 : 0) << e;
      std::vector<double> targets{e.phi()};
      if (index != mirror) targets.push_back(2 * pi - e.phi());
      std::size_t expected = 0;
      double margin = 1;
      for (const double target : targets) {
        expected += scan.roots(e, target).size();
        margin = std::min(margin, scan.margin(e, target));
      }
      const std::vector<Chain> found = chains(e);
      if (margin < 4e-6) {
        ++unclear;
        continue;
      }
      ASSERT_EQ(found.size(), expected) << e << ", margin " << margin;
      roots_found += static_cast<int>(expected);
      many += expected == 3 ? 1 : 0;
      for (const Chain& c : found) {
        double off = 10;
        for (const double target : targets) off = std::min(off, std::abs(turned_by(e, c).angle - target));
        ASSERT_LT(off, 0.01) << e;
        rough += is_refined(e, c) ? 0 : 1;
      }
    }
  const int all = configurations * static_cast<int>(indices.size());
  EXPECT_GT(roots_found, all / 2);
  EXPECT_GT(many, all / 50) << "too few with three roots";
  EXPECT_LT(unclear, all / 20);
  EXPECT_LT(rough, all / 2000);
}

// All roots of one pair of ends differ.
TEST(SphereChain, ThreeChainsAreThree) {
  RandomEnds random(2);
  for (int i = 0; i < configurations; ++i) {
    const Ends e = random(1.5, false);
    const std::vector<Chain> found = chains(e);
    for (std::size_t k = 0; k < found.size(); ++k)
      for (std::size_t j = 0; j < k; ++j)
        ASSERT_GT(
            length(exact(found[k].from_x) - exact(found[j].from_x)) * static_cast<double>(e.x_distance) / e.radius,
            1e-6)
            << e;
  }
}

// The parts of a chain fit together: its rays meet the sphere where it says, under the angle it says; a reflection has
// the angle of incidence on both sides; a refraction has n sin(theta_t) = sin(theta) at both ends of its chord, in
// vector form n (chord x normal) = ray x normal.
TEST(SphereChain, RaysObeyReflectionAndSnell) {
  RandomEnds random(3);
  for (const double index : indices)
    for (int i = 0; i < configurations; ++i) {
      const Ends e = random(index, true);
      for (const Chain& c : chains(e)) {
        if (!is_refined(e, c)) continue;
        const dvec3 nx = exact(c.x_normal), ny = exact(c.y_normal), in = exact(c.from_x), out = exact(c.from_y);
        for (const dvec3& v : {nx, ny, in, out}) ASSERT_NEAR(length(v), 1, 2e-6) << e;
        const double reach_x = std::max(1.0, static_cast<double>(e.x_distance) / e.radius),
                     reach_y = std::max(1.0, static_cast<double>(e.y_distance) / e.radius);
        ASSERT_LT(length(e.x() + in * static_cast<double>(c.x_length) - nx * e.radius), 3e-6 * e.radius * reach_x) << e;
        ASSERT_LT(length(e.y() + out * static_cast<double>(c.y_length) - ny * e.radius), 3e-6 * e.radius * reach_y)
            << e;
        const double cos = static_cast<double>(c.cos_theta);
        ASSERT_GE(cos, 0) << e;
        ASSERT_NEAR(-dot(in, nx), cos, 5e-6) << e;
        ASSERT_NEAR(-dot(out, ny), cos, 5e-6) << e;
        if (index == mirror) {
          ASSERT_LT(length(in - 2 * dot(in, nx) * nx + out), 1e-5) << e;
        } else {
          const double chord_length = length(ny - nx);
          const dvec3 chord = (ny - nx) / chord_length;
          const double tolerance = 5e-6 + 2e-6 / chord_length;
          ASSERT_LT(length(e.index * cross(chord, nx) - cross(in, nx)), tolerance) << e;
          ASSERT_LT(length(e.index * cross(chord, ny) + cross(out, ny)), tolerance) << e;
        }
      }
    }
}

/// A ray.
struct Line {
  dvec3 origin, direction;
};

/// Where a ray leaves the sphere after reflection or refraction in and out.
Line through(const Ends& e, const Line& ray) {
  const auto half_chord = [&](const dvec3& o, const dvec3& d, double& middle) {
    middle = -dot(o, d);
    const dvec3 miss = o + d * middle;
    return std::sqrt(e.radius * e.radius - dot(miss, miss));
  };
  double middle;
  const double half = half_chord(ray.origin, ray.direction, middle);
  const dvec3 p = ray.origin + ray.direction * (middle - half), n = p / e.radius;
  const double c = -dot(ray.direction, n);
  if (e.index == mirror) return {p, ray.direction + 2 * c * n};
  const double c_t = std::sqrt(1 - (1 - c * c) / (e.index * e.index));
  const dvec3 inside = ray.direction / e.index + n * (c / e.index - c_t);
  const dvec3 q = p - 2 * dot(p, inside) * inside;
  return {q, inside * e.index + q / e.radius * (c - e.index * c_t)};
}

/// Area at the distance of y over solid angle at x, from rays beside the chain's, by central differences.
double measured_tube(const Ends& e, const Chain& c) {
  const dvec3 d = normalize(exact(c.from_x)), x = e.x();
  const dvec3 u = normalize(cross(d, std::abs(d.x) < 0.6 ? dvec3{1, 0, 0} : dvec3{0, 1, 0})), v = cross(d, u);
  const Line ray = through(e, {x, d});
  // On to the sphere about the centre that y is on.
  const double middle = -dot(ray.origin, ray.direction);
  const dvec3 miss = ray.origin + middle * ray.direction;
  const double y2 = static_cast<double>(e.y_distance) * static_cast<double>(e.y_distance);
  const dvec3 y = miss + ray.direction * std::sqrt(y2 - dot(miss, miss));
  const double step = 1e-5 * e.radius / static_cast<double>(e.x_distance);
  const auto beside = [&](const dvec3& w) {
    const auto end = [&](double s) {
      const Line r = through(e, {x, normalize(d + s * w)});
      return r.origin + r.direction * (dot(y - r.origin, ray.direction) / dot(r.direction, ray.direction));
    };
    return (end(step) - end(-step)) / (2 * step);
  };
  return std::abs(dot(cross(beside(u), beside(v)), ray.direction));
}

// Where the tube is narrow beside its mean over the sphere, distance_x^2 distance_y^2 / radius^2, it changes too fast
// along the sphere to compare to more digits.
TEST(SphereChain, TubeIsTheAreaThatASolidAngleGrowsTo) {
  RandomEnds random(4);
  int compared = 0;
  for (const double index : indices)
    for (int i = 0; i < configurations; ++i) {
      const Ends e = random(index, false);
      for (const Chain& c : chains(e)) {
        if (c.cos_theta < 0.3f ||
            (index < 1 && 1 - std::pow(static_cast<double>(c.cos_theta), 2) > 0.9 * index * index))
          continue;
        const double expected = measured_tube(e, c);
        const double scale =
            std::pow(static_cast<double>(e.x_distance) * static_cast<double>(e.y_distance) / e.radius, 2);
        ASSERT_NEAR(static_cast<double>(c.tube), expected, 1e-3 * expected + 2e-5 * scale) << e;
        ++compared;
      }
    }
  EXPECT_GT(compared, configurations * 4);
}

// Through a sphere of index 1 light goes straight on, and a solid angle grows as the square of the distance.
TEST(SphereChain, TubeThroughNothingIsTheSquareOfTheDistance) {
  RandomEnds random(5);
  int compared = 0;
  for (int i = 0; i < configurations; ++i) {
    const Ends e = random(1, false);
    for (const Chain& c : chains(e)) {
      const double distance = length(e.x() - e.y());
      ASSERT_LT(length(normalize(e.y() - e.x()) - exact(c.from_x)), 1e-5) << e;
      if (c.cos_theta < 0.05f) continue;
      ASSERT_NEAR(static_cast<double>(c.tube) / (distance * distance), 1, 1e-3) << e;
      ++compared;
    }
  }
  EXPECT_GT(compared, configurations / 4);
}

// On the axis, a ball lens as two thin surfaces of power (n - 1)/r with 2 r/n between (reduced distance): the ray
// (height, angle) from x is (0, 1), and its height at y is the root of the tube. On the axis of a convex mirror of
// power -2/r in the same way.
TEST(SphereChain, OnTheAxisItIsParaxialOptics) {
  for (const double index : indices)
    for (const double radius : {0.01, 1.0, 50.0})
      for (const double dx : {1.0625, 1.5, 3.0, 40.0})
        for (const double dy : {1.125, 2.1, 7.0}) {
          const float r = static_cast<float>(radius);
          const Vec3<float> axis{0, 0, 1}, other{0, 0, index == mirror ? 1.0f : -1.0f};
          const Ends e{.index = static_cast<double>(static_cast<float>(index)),
                       .radius = static_cast<double>(r),
                       .to_x = axis,
                       .to_y = other,
                       .x_distance = static_cast<float>(dx) * r,
                       .y_distance = static_cast<float>(dy) * r};
          const double x = static_cast<double>(e.x_distance), y = static_cast<double>(e.y_distance);
          const double power = (index == mirror ? -2 : e.index - 1) / e.radius;
          double height = x - e.radius, angle = 1;
          angle -= power * height;
          if (index != mirror) {
            height += 2 * e.radius / e.index * angle;
            angle -= power * height;
          }
          height += (y - e.radius) * angle;
          bool found = false;
          for (const Chain& c : chains(e)) {
            if (c.cos_theta < 1 - 1e-6f) continue;  // of the ring around the axis
            found = true;
            EXPECT_NEAR(static_cast<double>(c.tube), height * height, 1e-5 * (x * y / e.radius) * (x * y / e.radius))
                << e;
            EXPECT_LT(length(exact(c.from_x) + exact(axis)), 1e-3) << e;
          }
          EXPECT_TRUE(found) << e;
        }
}

// Seen from far closer than its radius, a sphere is a plane mirror: the tube is the square of the way by the image of
// x.
TEST(SphereChain, HugeSphereIsAPlaneMirror) {
  for (const double along : {0.0, 0.5, 3.0}) {
    const double radius = 10000, hx = 1, hy = 2, angle = along / radius;
    const Ends e{.index = mirror,
                 .radius = radius,
                 .to_x = {0, 0, 1},
                 .to_y = {static_cast<float>(std::sin(angle)), 0, static_cast<float>(std::cos(angle))},
                 .x_distance = static_cast<float>(radius + hx),
                 .y_distance = static_cast<float>(radius + hy)};
    const auto found = chains(e);
    ASSERT_EQ(found.size(), 1u);
    const double way2 = along * along + (hx + hy) * (hx + hy);
    EXPECT_NEAR(static_cast<double>(found[0].tube) / way2, 1, 5e-3) << along;
    EXPECT_NEAR(static_cast<double>(found[0].x_length) / (std::sqrt(way2) * hx / (hx + hy)), 1, 5e-3) << along;
  }
}

TEST(SphereChain, NoneFromInsideOrOnTheSphere) {
  RandomEnds random(6);
  for (const double index : indices)
    for (int i = 0; i < 500; ++i) {
      Ends e = random(index, true);
      const auto r = static_cast<float>(e.radius);
      (i % 2 == 0 ? e.x_distance : e.y_distance) = i % 3 == 0 ? r : r * static_cast<float>(random.number());
      ASSERT_TRUE(chains(e).empty()) << e;
    }
}

/// Every number of a chain, with a name.
template <class F>
std::vector<std::pair<const char*, F>> numbers_of(const SphereChain<F>& c) {
  return {{"from_x.x", c.from_x.x},     {"from_x.y", c.from_x.y},
          {"from_x.z", c.from_x.z},     {"from_y.x", c.from_y.x},
          {"from_y.y", c.from_y.y},     {"from_y.z", c.from_y.z},
          {"x_length", c.x_length},     {"y_length", c.y_length},
          {"x_normal.x", c.x_normal.x}, {"x_normal.y", c.x_normal.y},
          {"x_normal.z", c.x_normal.z}, {"y_normal.x", c.y_normal.x},
          {"y_normal.y", c.y_normal.y}, {"y_normal.z", c.y_normal.z},
          {"cos_theta", c.cos_theta},   {"tube", c.tube}};
}

TEST(SphereChain, LanesFindWhatTheScalarCodeFinds) {
  using F = KernelLanes;
  constexpr std::size_t width = lane_count<F>;
  RandomEnds random(7);
  for (int trial = 0; trial < 150 * effort; ++trial) {
    const double index = indices[static_cast<std::size_t>(trial) % indices.size()];
    std::array<Ends, width> e;
    std::array<std::array<float, width>, 9> v;
    for (std::size_t i = 0; i < width; ++i) {
      e[i] = random(index, true);
      const std::array values{e[i].to_x.x,     e[i].to_x.y,     e[i].to_x.z,
                              e[i].to_y.x,     e[i].to_y.y,     e[i].to_y.z,
                              e[i].x_distance, e[i].y_distance, static_cast<float>(e[i].radius)};
      for (std::size_t k = 0; k < values.size(); ++k) v[k][i] = values[k];
    }
    const auto lanes = [&](std::size_t k) { return load<F>(v[k].data()); };
    const ChainPlane<F> plane =
        chain_plane(Vec3<F>{lanes(0), lanes(1), lanes(2)}, Vec3<F>{lanes(3), lanes(4), lanes(5)});
    const ChainEnd<F> x = chain_end(lanes(6), lanes(8)), y = chain_end(lanes(7), lanes(8));
    std::array<SphereChain<F>, 3> found{};
    if (index == mirror) {
      found[0] = reflected_chain(plane, x, y);
      found[1].exists = found[2].exists = no_lanes<F>();
    } else {
      found = refracted_chains(plane, x, y, F(static_cast<float>(index)));
    }
    std::array<std::size_t, width> next{};
    std::array<std::vector<Chain>, width> expected;
    for (std::size_t i = 0; i < width; ++i) expected[i] = chains(e[i]);
    for (const SphereChain<F>& c : found) {
      const auto numbers = numbers_of(c);
      for (std::size_t i = 0; i < width; ++i) {
        if ((bits(c.exists) >> i & 1) == 0) continue;
        ASSERT_LT(next[i], expected[i].size()) << e[i];
        const auto scalar = numbers_of(expected[i][next[i]++]);
        for (std::size_t k = 0; k < numbers.size(); ++k) {
          std::array<float, width> lane;
          store(numbers[k].second, lane.data());
          ASSERT_EQ(std::bit_cast<std::uint32_t>(lane[i]), std::bit_cast<std::uint32_t>(scalar[k].second))
              << numbers[k].first << " in lane " << i << ": " << lane[i] << " for " << scalar[k].second << ", " << e[i];
        }
      }
    }
    for (std::size_t i = 0; i < width; ++i) ASSERT_EQ(next[i], expected[i].size()) << e[i];
  }
}

}  // namespace
