#include "math/warp.h"

#include <gtest/gtest.h>

#include <random>
#include <vector>

#include "statistics_helpers.h"

using namespace glimt;

namespace {

using V = Vec3<float>;

double length_of(const V& v) {
  return std::sqrt(static_cast<double>(v.x) * v.x + static_cast<double>(v.y) * v.y + static_cast<double>(v.z) * v.z);
}

std::vector<V> normals() {
  std::vector<V> result{{0, 0, 1}, {0, 0, -1}, {1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}};
  std::mt19937 random(1);
  std::normal_distribution<float> gauss;
  while (result.size() < 12) result.push_back(normalize(V{gauss(random), gauss(random), gauss(random)}));
  return result;
}

// Every 2^-24 that is a multiple of 7 units, so all residues of smaller powers of two.
TEST(Warp, SineAndCosineOfTurnsKeepTheirBound) {
  double worst = 0;
  for (std::uint32_t i = 0; i < (1u << 24); i += 7) {
    const float u = static_cast<float>(i) * 0x1p-24f;
    const SinCos<float> turn = sincos_turns(u);
    const double angle = 2 * std::numbers::pi * static_cast<double>(u);
    worst = std::max({worst, std::abs(static_cast<double>(turn.sin) - std::sin(angle)),
                      std::abs(static_cast<double>(turn.cos) - std::cos(angle))});
  }
  EXPECT_LT(worst, 6.1e-7);
}

TEST(Warp, DirectionsHaveUnitLength) {
  std::mt19937 random(2);
  std::uniform_real_distribution<float> uniform_number;
  auto expect_unit = [](const V& v, float a, float b) {
    ASSERT_NEAR(length_of(v), 1, 1e-6) << "u " << std::hexfloat << a << ", v " << b;
  };
  std::vector<float> corners{0.0f, 0.25f, 0.5f, 0.75f, 1 - 0x1p-24f, 0x1p-24f};
  for (const V& n : normals())
    for (int i = 0; i < 20000; ++i) {
      const bool corner = i < 36;
      const auto k = static_cast<std::size_t>(i);
      const float a = corner ? corners[k % 6] : uniform_number(random),
                  b = corner ? corners[k / 6] : uniform_number(random);
      expect_unit(uniform_sphere(a, b), a, b);
      expect_unit(cosine_hemisphere(n, a, b), a, b);
      ASSERT_GE(dot(cosine_hemisphere(n, a, b), n), -1e-6f) << a << " " << b;
    }
}

/// Chi-square of directions over rings of equal probability (by `height`, uniform in [0, 1)) and sectors about an axis.
double chi_square(const std::vector<std::pair<double, double>>& height_and_turn, int rings, int sectors) {
  std::vector<double> count(static_cast<std::size_t>(rings * sectors));
  for (const auto& [height, turn] : height_and_turn) {
    const int ring = std::clamp(static_cast<int>(height * rings), 0, rings - 1);
    const int sector = std::clamp(static_cast<int>(turn * sectors), 0, sectors - 1);
    ++count[static_cast<std::size_t>(ring * sectors + sector)];
  }
  const double expected = static_cast<double>(height_and_turn.size()) / static_cast<double>(count.size());
  double chi2 = 0;
  for (const double c : count) chi2 += (c - expected) * (c - expected) / expected;
  return chi2;
}

/// Height along the axis and turn about it, the latter in [0, 1).
std::pair<double, double> cylindrical(const V& w, const V& axis) {
  const V other = std::abs(axis.x) < 0.6f ? V{1, 0, 0} : V{0, 1, 0};
  const V a = normalize(cross(axis, other)), b = cross(axis, a);
  const double turn =
      std::atan2(static_cast<double>(dot(w, b)), static_cast<double>(dot(w, a))) / (2 * std::numbers::pi);
  return {static_cast<double>(dot(w, axis)), turn < 0 ? turn + 1 : turn};
}

constexpr double alpha = 1e-4;  ///< of a false alarm, for each of the two tests below
constexpr int samples = 200000;

// Archimedes: a uniform point of the sphere has a uniform height h in [-1, 1] along any axis.
TEST(Warp, UniformSphereIsUniformAboutEveryAxis) {
  std::mt19937 random(3);
  std::uniform_real_distribution<float> u;
  for (const V& axis : normals()) {
    std::vector<std::pair<double, double>> points;
    for (int i = 0; i < samples; ++i) {
      const float a = u(random);
      const auto [h, turn] = cylindrical(uniform_sphere(a, u(random)), axis);
      points.emplace_back((h + 1) / 2, turn);
    }
    EXPECT_GT(chi_square_tail(chi_square(points, 16, 32), 16 * 32 - 1), sidak(alpha, 12));
  }
}

// pdf_w = cos / pi over the hemisphere: the probability of an angle below theta is the integral of cos sin / pi,
// sin^2(theta). So cos^2 is uniform in [0, 1].
TEST(Warp, CosineHemisphereFollowsTheCosineAboutEveryNormal) {
  std::mt19937 random(4);
  std::uniform_real_distribution<float> u;
  for (const V& n : normals()) {
    std::vector<std::pair<double, double>> points;
    for (int i = 0; i < samples; ++i) {
      const float a = u(random);
      const auto [h, turn] = cylindrical(cosine_hemisphere(n, a, u(random)), n);
      points.emplace_back(h * h, turn);
    }
    EXPECT_GT(chi_square_tail(chi_square(points, 16, 32), 16 * 32 - 1), sidak(alpha, 12));
  }
}

TEST(Warp, LanesWarpAsTheScalarFunctionsDo) {
  using F = KernelLanes;
  std::array<float, lane_count<F>> a, b, x, y, z;
  std::mt19937 random(5);
  std::uniform_real_distribution<float> u;
  for (const V& n : normals())
    for (int trial = 0; trial < 1000; ++trial) {
      for (std::size_t i = 0; i < a.size(); ++i) a[i] = u(random), b[i] = trial == 0 ? 0.0f : u(random);
      const Vec3<F> w = cosine_hemisphere(Vec3<F>{F(n.x), F(n.y), F(n.z)}, load<F>(a.data()), load<F>(b.data()));
      store(w.x, x.data()), store(w.y, y.data()), store(w.z, z.data());
      for (std::size_t i = 0; i < a.size(); ++i) {
        const V s = cosine_hemisphere(n, a[i], b[i]);
        ASSERT_EQ((std::array{x[i], y[i], z[i]}), (std::array{s.x, s.y, s.z})) << a[i] << " " << b[i];
      }
    }
}

}  // namespace
