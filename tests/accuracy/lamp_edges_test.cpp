// Edges of lamps in the picture. The probability of a false alarm is alpha for each test.
#include <gtest/gtest.h>

#include <cmath>

#include "same_picture.h"
#include "scene_parts.h"

using namespace glimt;

namespace {

constexpr double alpha = 1e-4;

/// A lamp 4 m in front of a camera that looks along -z; 16x16 pixels of 0.5 m there. All else is black.
Scene lamp_alone(std::vector<dvec3> vertices) {
  Scene scene;
  scene.name = "lamp alone";
  scene.materials = {lambertian("black", dvec3{0}), light("lamp", dvec3{20})};
  scene.polygons = box({-9, -9, -9}, {9, 9, 9}, "black");
  scene.polygons.push_back({"lamp", "lamp", std::move(vertices)});
  scene.camera = {{0, 0, 0}, {0, 0, -1}, {0, 1, 0}, 90};
  scene.image = {16, 16};
  return scene;
}

const std::vector<dvec3> rectangle{{-1.3, -0.9, -4}, {1.1, -0.9, -4}, {1.1, 1.65, -4}, {-1.3, 1.65, -4}};

double overlap(double low, double high, int cell) {
  return std::max(0.0, std::min(high, cell + 1.0) - std::max(low, cell * 1.0));
}

// The share f of a pixel that the lamp covers is exact: the lamp's sides are parallel to the pixel's. One ray a sample
// would have the variance f (1 - f) / n of the lamp's radiance squared; sixteen have a sixteenth of it.
TEST(LampEdges, HaveTheirShareOfThePixelAndASixteenthOfTheVariance) {
  Scene scene = lamp_alone(rectangle);
  scene.render.sampler = Sampler::independent;
  const int samples = 64 * effort;
  const Image picture = render(compile(scene), samples).mean();
  double sum = 0, pixels = 0;
  for (int y = 0; y < 16; ++y)
    for (int x = 0; x < 16; ++x) {
      const double f = overlap(8 - 1.3 * 2, 8 + 1.1 * 2, x) * overlap(8 - 1.65 * 2, 8 + 0.9 * 2, y);
      const auto value = static_cast<double>(picture.pixel(x, y)[0]) / 20;
      if (f < 1e-9 || f > 1 - 1e-9) {
        EXPECT_NEAR(value, f, 1e-6) << "pixel (" << x << ", " << y << ")";
      } else {
        sum += std::pow(value - f, 2) / (f * (1 - f) / (16 * samples));
        ++pixels;
      }
    }
  EXPECT_GT(pixels, 15);
  EXPECT_GT(chi_square_tail(sum, pixels), alpha / 2) << sum << " for " << pixels << " pixels";
  EXPECT_LT(chi_square_tail(sum, pixels), 1 - alpha / 2) << sum << " for " << pixels << " pixels";
}

// Things that hide a part of an edge, a lamp of each shape, one behind the camera and one that shows its back: the
// picture without what makes edges sharp.
TEST(LampEdges, KeepThePicture) {
  Scene scene = lamp_alone(rectangle);
  scene.name = "lamps and things before them";
  scene.polygons.push_back({"triangle", "lamp", {{1.5, -3, -4}, {3.5, -3, -5}, {2.5, -1.2, -4.5}}});
  scene.polygons.push_back({"behind", "lamp", {{-1, -1, 4}, {-1, 1, 4}, {1, 1, 4}}});
  scene.polygons.push_back({"its back", "lamp", {{-3, 2, -4}, {-3, 3, -4}, {-2, 3, -4}}});
  scene.polygons.push_back({"past the eye", "lamp", {{-2, -2.5, 3}, {2, -2.5, 3}, {2, -2.5, -8}, {-2, -2.5, -8}}});
  std::ranges::reverse(scene.polygons.back().vertices);
  scene.materials.push_back(lambertian("white", dvec3{0.6}));
  scene.spheres = {{"bulb", "lamp", {-2.5, 0.5, -4}, 0.4}, {"ball", "white", {0.8, 0.8, -2.5}, 0.4}};
  scene.image = {32, 32};
  std::vector<Named> all{{"edges", {}}, {"without", {}}};
  for (int seed = 1; seed <= 16; ++seed)
    for (std::size_t k = 0; k < 2; ++k) {
      scene.render.seed = seed + 1000 * static_cast<int>(k);
      CompiledScene compiled = compile(scene);
      EXPECT_GT(compiled.lamp_edges.size(), 100u);
      if (k == 1) compiled.lamp_edges.clear();
      all[k].series.blocks.push_back(block_means(render(compiled, 8 * effort).mean(), 8));
    }
  expect_same(all[0], all[1], sidak(alpha, comparisons(all[0].series)), scene.name);
}

// The four corners are in the middle of pixels, and the edges along rows and columns of them.
TEST(LampEdges, AreWhereTheEyeSeesThem) {
  const Scene scene = lamp_alone({{-1.25, -0.75, -4}, {1.25, -0.75, -4}, {1.25, 1.25, -4}, {-1.25, 1.25, -4}});
  const std::vector<int> edges = compile(scene).lamp_edges;
  const auto has = [&](int x, int y) { return std::ranges::binary_search(edges, y * 16 + x); };
  for (int x = 5; x <= 10; ++x) EXPECT_TRUE(has(x, 5) && has(x, 9)) << x;
  for (int y = 5; y <= 9; ++y) EXPECT_TRUE(has(5, y) && has(10, y)) << y;
  EXPECT_FALSE(has(7, 7));
  EXPECT_FALSE(has(2, 2));
  for (const Polygon& other : {Polygon{"behind", "lamp", {{-1, -1, 4}, {-1, 1, 4}, {1, 1, 4}}},
                               Polygon{"back", "lamp", {{-1, -1, -4}, {-1, 1, -4}, {1, 1, -4}}},
                               Polygon{"beside", "lamp", {{7, -1, -4}, {8, -1, -4}, {8, 1, -4}}}})
    EXPECT_TRUE(compile(lamp_alone(other.vertices)).lamp_edges.empty()) << other.name;
}

}  // namespace
