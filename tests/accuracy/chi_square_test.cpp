#include <gtest/gtest.h>

#include <numbers>
#include <random>

#include "kernel/lamps/sample_lamp.h"
#include "math/sampler.h"
#include "scene_parts.h"
#include "statistics_helpers.h"

using namespace glimt;

// Samples of lamps follow the densities they claim. Cells of the lamp (or of the cone it is seen in) have probabilities
// in closed form; counts are tested by chi-square with a probability of a false alarm of alpha for each test. The
// hemisphere's are in unit/math/warp_test.cpp, glass's in scattering_test.cpp.
namespace {

constexpr double alpha = 1e-4;
constexpr int paths = 100000;
constexpr int cells = 16;  ///< along each of two coordinates

/// Counts in cells x cells, by two coordinates in [0, 1].
struct Grid {
  std::vector<double> count = std::vector<double>(cells * cells);

  void add(double a, double b) {
    const auto place = [](double x) { return static_cast<std::size_t>(std::clamp(x * cells, 0.0, cells - 0.5)); };
    ++count[place(a) * cells + place(b)];
  }
};

/// How likely the counts are; cells of which fewer than 5 are expected count as one.
double likelihood(const std::vector<double>& count, const std::vector<double>& probability) {
  double n = 0, chi2 = 0, freedom = -1, rest = 0, rest_expected = 0, sum = 0;
  for (const double c : count) n += c;
  for (std::size_t i = 0; i < count.size(); ++i) {
    const double expected = n * probability[i];
    sum += probability[i];
    if (expected < 5) {
      rest += count[i], rest_expected += expected;
      continue;
    }
    chi2 += (count[i] - expected) * (count[i] - expected) / expected, ++freedom;
  }
  EXPECT_NEAR(sum, 1, 1e-9) << "probabilities";
  if (rest_expected > 0.5) {
    chi2 += (rest - rest_expected) * (rest - rest_expected) / rest_expected, ++freedom;
  } else if (rest > 5) {
    return 0;  // a Poisson variable of mean 1/2 is above 5 with probability 1e-5
  }
  return chi_square_tail(chi2, freedom);
}

const std::vector<double> uniform_cells(cells* cells, 1.0 / (cells * cells));

/// The lamp alone; compiled space may be moved.
struct LampScene {
  CompiledScene compiled;

  explicit LampScene(Scene scene, LightSampling sampling) {
    scene.materials.push_back(light("lamp", {1, 2, 3}));
    scene.camera = {{0, 0, 50}, {0, 0, 0}, {0, 1, 0}, 50};
    scene.render.light_sampling = sampling;
    compiled = compile(scene);
  }
  Vec3<float> inside(const dvec3& p) const {
    const auto at = [&](int k) { return static_cast<float>(p[k] - compiled.origin[static_cast<std::size_t>(k)]); };
    return {at(0), at(1), at(2)};
  }
  /// A sampled point, in world space.
  struct Point {
    dvec3 x, direction;
    double distance, inverse_pdf;  ///< 1 / pdf_w
  };
  Point sample(const dvec3& from, std::mt19937& random) const {
    std::uniform_real_distribution<float> u(0, 1);
    const auto number = [&] { return std::min(u(random), 0x1.fffffep-1f); };
    const float a = number(), b = number();
    const LampSample<float> s = sample_lamp<float, false>(compiled, inside(from), number(), a, b);
    const dvec3 direction{s.direction.x, s.direction.y, s.direction.z};
    const auto distance = static_cast<double>(s.distance);
    return {from + distance * direction, direction, distance,
            static_cast<double>(s.inverse_pdf) * static_cast<double>(s.inverse_choice)};
  }
  double claimed(const dvec3& from, const Point& p, double cos_lamp) const {
    return static_cast<double>(lamp_inverse_pdf<float>(compiled, 0, inside(from), static_cast<float>(p.distance),
                                                       static_cast<float>(cos_lamp)));
  }
};

// A rectangle of 2 x 1 in a tilted plane; positions in its own frame: along its edges from its corner, and in front.
const double length_1 = 2, length_2 = 1;
const dvec3 corner{0.3, -0.2, 0.1}, axis_1 = normalize(dvec3{1, 0.5, -0.25}),
                                    axis_2 = normalize(cross(dvec3{0.1, -0.4, 1}, axis_1)),
                                    front = cross(axis_1, axis_2);

struct Position {
  const char* name;
  double a, b, h;
};
const std::vector<Position> positions{{"far", 0.9, 0.4, 30},
                                      {"as far as it is large", 0.7, 0.8, 1.5},
                                      {"near", 0.6, 0.3, 0.05},
                                      {"very near", 1.1, 0.7, 0.01},
                                      {"grazing", 2.8, 1.3, 0.15},
                                      {"grazing and far", 5, 2, 0.1},
                                      {"below an edge", 2, 0.4, 0.1},
                                      {"below a corner", 2, 1, 0.02},
                                      {"beside a corner", -0.2, -0.3, 0.3}};

/// Solid angle of a rectangle [x0, x1] x [y0, y1] seen from the height h above the origin.
double solid_angle(double x0, double x1, double y0, double y1, double h) {
  const auto g = [&](double x, double y) { return std::atan2(x * y, h * std::sqrt(x * x + y * y + h * h)); };
  return g(x1, y1) - g(x0, y1) - g(x1, y0) + g(x0, y0);
}

void expect_rectangle(LightSampling sampling, unsigned seed) {
  Scene scene;
  scene.polygons = {{"lamp",
                     "lamp",
                     {corner, corner + length_1 * axis_1, corner + length_1 * axis_1 + length_2 * axis_2,
                      corner + length_2 * axis_2}}};
  const LampScene lamp(scene, sampling);
  for (const Position& position : positions) {
    const char* name = position.name;
    const double a = position.a, b = position.b, h = position.h;
    const dvec3 from = corner + a * axis_1 + b * axis_2 + h * front;
    const double omega = solid_angle(-a, length_1 - a, -b, length_2 - b, h);
    // RectangleView::small says which are sampled by area all the same.
    const bool by_area = sampling == LightSampling::area || omega < 0.02;
    ASSERT_TRUE(std::abs(omega - 0.02) > 1e-4) << "neither";
    std::mt19937 random(seed);
    Grid grid;
    for (int i = 0; i < paths; ++i) {
      const LampScene::Point p = lamp.sample(from, random);
      const double s = dot(p.x - corner, axis_1) / length_1, t = dot(p.x - corner, axis_2) / length_2;
      const double cos_lamp = -dot(p.direction, front);
      ASSERT_NEAR(dot(p.x - corner, front), 0, 1e-5) << name << ", sample " << i << ", seed " << seed;
      grid.add(s, t);
      const double exact = by_area ? length_1 * length_2 * cos_lamp / (p.distance * p.distance) : omega;
      ASSERT_NEAR(p.inverse_pdf, exact, 2e-4 * exact) << name << ", sample " << i << ", seed " << seed;
      ASSERT_NEAR(lamp.claimed(from, p, cos_lamp), exact, 2e-4 * exact)
          << name << ", sample " << i << ", seed " << seed;
    }
    std::vector<double> probability;
    for (int i = 0; i < cells; ++i)
      for (int k = 0; k < cells; ++k) {
        const auto x = [&](int c) { return length_1 * c / cells - a; };
        const auto y = [&](int c) { return length_2 * c / cells - b; };
        probability.push_back(by_area ? uniform_cells[0] : solid_angle(x(i), x(i + 1), y(k), y(k + 1), h) / omega);
      }
    EXPECT_GT(likelihood(grid.count, probability), sidak(alpha, static_cast<double>(positions.size())))
        << name << ", seed " << seed;
  }
}

TEST(ChiSquare, RectangleByArea) { expect_rectangle(LightSampling::area, 1); }
TEST(ChiSquare, RectangleBySolidAngle) { expect_rectangle(LightSampling::solid_angle, 2); }

// The square folded: of a triangle p + a e1 + b e2, a < x has the probability 1 - (1 - x)^2, and given a, b is uniform
// in [0, 1 - a].
TEST(ChiSquare, Triangle) {
  Scene scene;
  const dvec3 e1 = 2.0 * axis_1, e2 = 0.5 * axis_1 + 1.5 * axis_2;
  scene.meshes = {{"lamp", "lamp", {corner, corner + e1, corner + e2}, {{0, 1, 2}}}};
  const LampScene lamp(scene, LightSampling::automatic);
  const double area = length(cross(e1, e2)) / 2;
  for (const Position& position : positions) {
    const dvec3 from = corner + position.a * axis_1 + position.b * axis_2 + position.h * front;
    std::mt19937 random(3);
    Grid grid;
    for (int i = 0; i < paths; ++i) {
      const LampScene::Point p = lamp.sample(from, random);
      const double b = dot(p.x - corner, axis_2) / 1.5, a = (dot(p.x - corner, axis_1) - 0.5 * b) / 2;
      grid.add(1 - (1 - a) * (1 - a), b / std::max(1 - a, 1e-12));
      const double exact = area * -dot(p.direction, front) / (p.distance * p.distance);
      ASSERT_NEAR(p.inverse_pdf, exact, 2e-4 * exact) << position.name << ", sample " << i;
      ASSERT_NEAR(lamp.claimed(from, p, -dot(p.direction, front)), exact, 2e-4 * exact)
          << position.name << ", sample " << i;
    }
    EXPECT_GT(likelihood(grid.count, uniform_cells), sidak(alpha, static_cast<double>(positions.size())))
        << position.name;
  }
}

/// Solid angle of the triangle that a point sees: the angles of the great circles through its corners, less pi.
double seen_triangle(const dvec3& from, const std::array<dvec3, 3>& corners) {
  std::array<dvec3, 3> way;
  for (std::size_t i = 0; i < 3; ++i) way[i] = normalize(corners[i] - from);
  double sum = -std::numbers::pi;
  for (std::size_t i = 0; i < 3; ++i) {
    const dvec3 a = cross(way[i], way[(i + 1) % 3]), b = cross(way[i], way[(i + 2) % 3]);
    sum += std::atan2(length(cross(a, b)), dot(a, b));
  }
  return sum;
}

// Cells that cut a triangle from its corner to the opposite edge and across; each has the share of the solid angle that
// its two triangles have.
TEST(ChiSquare, TriangleBySolidAngle) {
  Scene scene;
  const dvec3 e1 = 2.0 * axis_1, e2 = 0.5 * axis_1 + 1.5 * axis_2;
  scene.meshes = {{"lamp", "lamp", {corner, corner + e1, corner + e2}, {{0, 1, 2}}}};
  const LampScene lamp(scene, LightSampling::solid_angle);
  const auto at = [&](double s, double t) { return corner + s * ((1 - t) * e1 + t * e2); };
  for (const Position& position : positions) {
    const dvec3 from = corner + position.a * axis_1 + position.b * axis_2 + position.h * front;
    const double omega = seen_triangle(from, {corner, corner + e1, corner + e2});
    const bool by_area = omega < 0.02;
    ASSERT_TRUE(std::abs(omega - 0.02) > 1e-4) << "neither";
    std::mt19937 random(8);
    Grid grid;
    for (int i = 0; i < paths; ++i) {
      const LampScene::Point p = lamp.sample(from, random);
      const double b = dot(p.x - corner, axis_2) / 1.5, a = (dot(p.x - corner, axis_1) - 0.5 * b) / 2;
      ASSERT_NEAR(dot(p.x - corner, front), 0, 1e-5) << position.name << ", sample " << i;
      grid.add(a + b, b / std::max(a + b, 1e-12));
      const double cos_lamp = -dot(p.direction, front);
      const double exact = by_area ? length(cross(e1, e2)) / 2 * cos_lamp / (p.distance * p.distance) : omega;
      ASSERT_NEAR(p.inverse_pdf, exact, 2e-4 * exact) << position.name << ", sample " << i;
      ASSERT_NEAR(lamp.claimed(from, p, cos_lamp), exact, 2e-4 * exact) << position.name << ", sample " << i;
    }
    std::vector<double> probability;
    for (int i = 0; i < cells; ++i)
      for (int k = 0; k < cells; ++k) {
        const double s0 = 1.0 * i / cells, s1 = 1.0 * (i + 1) / cells, t0 = 1.0 * k / cells, t1 = 1.0 * (k + 1) / cells;
        const double seen = (i == 0 ? 0 : seen_triangle(from, {at(s0, t0), at(s1, t1), at(s0, t1)})) +
                            seen_triangle(from, {at(s0, t0), at(s1, t0), at(s1, t1)});
        probability.push_back(by_area ? (s1 * s1 - s0 * s0) / cells : seen / omega);
      }
    EXPECT_GT(likelihood(grid.count, probability), sidak(alpha, static_cast<double>(positions.size())))
        << position.name;
  }
}

// In the cone 1 - cos is uniform, and so is the turn about the axis.
TEST(ChiSquare, SphereByCone) {
  constexpr double radius = 0.5;
  const dvec3 centre{0.2, -0.3, 0.4};
  Scene scene;
  scene.spheres = {{"lamp", "lamp", centre, radius}};
  const LampScene lamp(scene, LightSampling::solid_angle);
  const std::vector<double> distances{0.501, 0.55, 1, 10, 300};
  for (const double distance : distances)
    for (const dvec3& way : {dvec3{0, 0, -1}, dvec3{0, 0, 1}, normalize(dvec3{1, -2, 0.5})}) {
      const dvec3 from = centre + distance * way;
      const auto [u, v] = tangents(-way);
      const double sin2 = std::pow(radius / distance, 2), top = sin2 / (1 + std::sqrt(1 - sin2));  // 1 - cos
      std::mt19937 random(4);
      Grid grid;
      for (int i = 0; i < paths; ++i) {
        const LampScene::Point p = lamp.sample(from, random);
        const double x = dot(p.direction, u), y = dot(p.direction, v), s2 = x * x + y * y;
        const double one_minus_cos = s2 / (1 + std::sqrt(std::max(1 - s2, 0.0)));
        grid.add(one_minus_cos / top, std::atan2(y, x) / (2 * std::numbers::pi) + 0.5);
        ASSERT_NEAR(length(p.x - centre), radius, 2e-3 * radius + 1e-6 * distance) << distance << ", sample " << i;
        const double exact = 2 * std::numbers::pi * top;
        ASSERT_NEAR(p.inverse_pdf, exact, 2e-4 * exact) << distance << ", sample " << i;
        ASSERT_NEAR(lamp.claimed(from, p, 1), exact, 2e-4 * exact) << distance << ", sample " << i;
      }
      EXPECT_GT(likelihood(grid.count, uniform_cells), sidak(alpha, 3.0 * static_cast<double>(distances.size())))
          << "distance " << distance << ", from (" << way.x << ", " << way.y << ", " << way.z << ")";
    }
}

// Archimedes: height and turn about any axis are uniform.
TEST(ChiSquare, SphereByArea) {
  constexpr double radius = 0.5, area = 4 * std::numbers::pi * radius * radius;
  const dvec3 centre{0.2, -0.3, 0.4};
  Scene scene;
  scene.spheres = {{"lamp", "lamp", centre, radius}};
  const LampScene lamp(scene, LightSampling::area);
  const std::vector<double> distances{0.51, 0.8, 3};
  for (const double distance : distances) {
    const dvec3 axis = normalize(dvec3{1, -2, 0.5}), from = centre + distance * axis;
    const auto [u, v] = tangents(axis);
    std::mt19937 random(5);
    Grid grid;
    for (int i = 0; i < paths; ++i) {
      const LampScene::Point p = lamp.sample(from, random);
      const dvec3 normal = (p.x - centre) / radius;
      ASSERT_NEAR(length(normal), 1, 1e-5);
      grid.add(dot(normal, axis) / 2 + 0.5, std::atan2(dot(normal, v), dot(normal, u)) / (2 * std::numbers::pi) + 0.5);
      const double cos = -dot(p.direction, normal), exact = area * std::max(cos, 0.0) / (p.distance * p.distance);
      ASSERT_NEAR(p.inverse_pdf, exact, 2e-4 * exact + 2e-5 * area / (p.distance * p.distance)) << "sample " << i;
      if (cos < 1e-2) continue;
      ASSERT_NEAR(lamp.claimed(from, p, cos), exact, 2e-4 * exact) << "sample " << i;
    }
    EXPECT_GT(likelihood(grid.count, uniform_cells), sidak(alpha, static_cast<double>(distances.size())))
        << "distance " << distance;
  }
}

// In proportion to power, which is area times the sum of the channels; what is claimed of a choice is its inverse.
TEST(ChiSquare, ChoiceAmongLamps) {
  Scene scene;
  scene.materials = {light("faint", {0.1, 0, 0}), light("bright", {3, 9, 2}), light("dark", {0, 0, 0})};
  scene.polygons = {disk("five corners", "lamp", {0, 0, 0}, {0, 1, 0}, 1, 5),
                    {"square", "bright", {{3, 0, 0}, {4, 0, 0}, {4, 1, 0}, {3, 1, 0}}},
                    {"unlit", "dark", {{5, 0, 0}, {6, 0, 0}, {6, 1, 0}, {5, 1, 0}}}};
  scene.meshes = {tetrahedron("solid", "faint", {-3, 0, 0}, 1)};
  scene.spheres = {{"bulb", "bright", {0, 3, 0}, 0.2}, {"large", "faint", {0, -5, 0}, 2}};
  for (const LightSampling sampling : {LightSampling::area, LightSampling::solid_angle}) {
    const LampScene lamp(scene, sampling);
    // Rows in the order of the objects: three triangles, a square, four sides, two spheres.
    const auto triangle = [](const dvec3& a, const dvec3& b, const dvec3& c) {
      return length(cross(b - a, c - a)) / 2;
    };
    std::vector<double> area;
    const auto& v = scene.polygons[0].vertices;
    for (std::size_t i = 2; i < 5; ++i) area.push_back(triangle(v[0], v[i - 1], v[i]));
    area.push_back(1);
    const auto& w = scene.meshes[0].vertices;
    for (int i = 0; i < 4; ++i) area.push_back(triangle(w[0], w[1], w[2]));
    for (const double r : {0.2, 2.0}) area.push_back(4 * std::numbers::pi * r * r);
    const std::vector<double> brightness{6, 6, 6, 14, 0.1, 0.1, 0.1, 0.1, 14, 0.1};
    ASSERT_EQ(lamp.compiled.lamps.rows(), 10);
    double total = 0;
    for (std::size_t i = 0; i < 10; ++i) total += area[i] * brightness[i];
    std::vector<double> probability, count(10);
    for (std::size_t i = 0; i < 10; ++i) {
      probability.push_back(area[i] * brightness[i] / total);
      const bool by_area = sampling == LightSampling::area;
      EXPECT_NEAR(static_cast<double>(lamp.compiled.lamps[LampColumn::inverse_choice][i]) * probability[i],
                  by_area ? area[i] : 1, 1e-5 * area[i])
          << "row " << i;
    }
    std::mt19937 random(6);
    std::uniform_int_distribution<std::uint32_t> bits;
    for (int i = 0; i < 1000000; ++i)
      ++count[static_cast<std::size_t>(choose_lamp<float>(lamp.compiled, unit_float<float>(bits(random))))];
    EXPECT_GT(likelihood(count, probability), sidak(alpha, 2));
  }
}

}  // namespace
