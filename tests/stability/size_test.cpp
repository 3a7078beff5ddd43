// The same scene in other units and elsewhere.
#include <gtest/gtest.h>

#include "film/statistics.h"
#include "pictures.h"
#include "random_scene.h"
#include "scene/file/scene_file.h"

using namespace glimt;

namespace {

template <class F>
void for_all_points(Scene& scene, F f) {
  for (Polygon& p : scene.polygons) std::ranges::for_each(p.vertices, f);
  for (Mesh& m : scene.meshes) std::ranges::for_each(m.vertices.edit(), f);
  for (Sphere& s : scene.spheres) f(s.center);
  f(scene.camera.eye);
  f(scene.camera.look_at);
}

Scene scaled(Scene scene, double factor) {
  for_all_points(scene, [&](dvec3& v) { v *= factor; });
  for (Sphere& s : scene.spheres) s.radius *= factor;
  return scene;
}

Scene moved(Scene scene, const dvec3& by) {
  for_all_points(scene, [&](dvec3& v) { v += by; });
  return scene;
}

std::vector<Scene> some_scenes() {
  std::vector<Scene> scenes;
  for (const std::string name : {"cornell", "hexagon", "report"}) {
    scenes.push_back(read_scene(GLIMT_SCENES "/" + name + ".toml"));
    scenes.back().image = {60, 45};
  }
  for (unsigned seed = 0; seed < 10; ++seed) scenes.push_back(RandomScene(seed).scene);
  for (std::size_t i = 0; i < scenes.size(); ++i) {
    scenes[i].render.light_sampling = i % 2 ? LightSampling::solid_angle : LightSampling::automatic;
    scenes[i].render.mis = static_cast<Mis>(i % 2);
  }
  return scenes;
}

// Failure: an epsilon in metres, which a small or large scene turns into leaks or holes. A power of two changes only
// the exponents of floats, so a program without absolute lengths gives the picture bit for bit.
TEST(Scaled, ByAPowerOfTwoThePictureIsTheSameBitForBit) {
  for (const Scene& scene : some_scenes()) {
    const auto picture = trace_all(compile(scene), effort, Lanes::native);
    for (const double factor : {0x1p-10, 0x1p13}) {
      const CompiledScene compiled = compile(scaled(scene, factor));
      const std::ptrdiff_t i = first_difference(picture, trace_all(compiled, effort, Lanes::native));
      EXPECT_EQ(i, -1) << scene.name << " times " << factor << ", " << replay(compiled, i);
    }
  }
}

/// Number of the paths whose brightness differs by more than 1e-3 of it, and the means' relative difference.
struct Difference {
  double paths, mean;
};

Difference difference(const std::vector<float>& a, const std::vector<float>& b) {
  double other = 0, sum_a = 0, sum_b = 0;
  for (std::size_t i = 0; i < a.size(); i += 3) {
    const double x = static_cast<double>(a[i] + a[i + 1] + a[i + 2]),
                 y = static_cast<double>(b[i] + b[i + 1] + b[i + 2]);
    other += std::abs(x - y) > 1e-3 * std::max(x, y);
    sum_a += x, sum_b += y;
  }
  return {other, std::abs(sum_a - sum_b) / sum_a};
}

/// Probability that at least n of many rare and independent things happen where `mean` are expected (Poisson).
double at_least(double n, double mean) { return n < 1 ? 1 : 1 - chi_square_tail(2 * mean, 2 * n); }

// Failure: the same, and coordinates that lose their digits far from the origin. Vertices rounded otherwise send a few
// paths past an edge on its other side, and each sphere magnifies what a path is off: 1 path in 1000 may differ, and
// as those differ by chance, the mean by a fraction of that. False alarm: at most 52 times 1e-7.
TEST(Scaled, ByAThousandthOrTenThousandfoldOrMovedByTenKilometresThePictureIsTheSame) {
  for (const Scene& scene : some_scenes()) {
    const auto picture = trace_all(compile(scene), 2 * effort, Lanes::native);
    const std::vector<std::pair<const char*, Scene>> others{
        {"times 1e-3", scaled(scene, 1e-3)},
        {"times 1e4", scaled(scene, 1e4)},
        {"moved by 1e4 m", moved(scene, {1e4, -1e4, 1e4})},
        {"times 1e-3, moved by 10 m", moved(scaled(scene, 1e-3), dvec3{10})}};
    for (const auto& [what, other] : others) {
      const Difference d = difference(picture, trace_all(compile(other), 2 * effort, Lanes::native));
      const double paths = static_cast<double>(picture.size()) / 3;
      EXPECT_GT(at_least(d.paths, 1e-3 * paths), 1e-7)
          << d.paths << " of " << paths << " paths, " << scene.name << " " << what;
      EXPECT_LT(d.mean, effort > 1 ? 1e-3 : 1e-2) << scene.name << " " << what;
    }
  }
}

}  // namespace
