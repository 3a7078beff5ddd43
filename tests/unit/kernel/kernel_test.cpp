#include "kernel/entry/kernels.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "kernel/transport/random.h"
#include "material/lobes.h"
#include "math/vec.h"
#include "pictures.h"
#include "random_scene.h"
#include "scene/file/scene_file.h"

using namespace glimt;

namespace {

const std::vector<std::string> scene_files{"cornell",         "furnace",       "hexagon",
                                           "hexagon_diffuse", "hexagon_empty", "report"};

Scene from_file(const std::string& name, int width, int height) {
  Scene scene = read_scene(GLIMT_SCENES "/" + name + ".toml");
  scene.image = {width, height};
  return scene;
}

/// The scenes that come with the program, and generated ones in which every feature of the kernel occurs.
std::vector<Scene> many_scenes() {
  std::vector<Scene> scenes;
  for (const std::string& name : scene_files) scenes.push_back(from_file(name, 40, 30));
  for (unsigned seed = 0; seed < 25; ++seed) {
    scenes.push_back(RandomScene(seed).scene);
    Settings& settings = scenes.back().render;
    set_method(settings, seed % 7 == 3 ? Method::naive : Method::path);
    settings.roulette_depth = static_cast<int>(seed % 4) * 2;
    settings.sampler = static_cast<Sampler>(seed % 4);
    if (seed % 7 != 3) settings.light_sampling = static_cast<LightSampling>(1 + seed % 3);
    settings.mis = static_cast<Mis>(seed % 2);
    settings.caustics = static_cast<Caustics>(seed % 5 != 4);
    settings.max_depth = seed % 6 == 5 ? 3 : 0;
  }
  for (const char* name : {"report", "cornell"}) {
    Scene& outside = scenes.emplace_back(from_file(name, 40, 30));
    outside.camera.eye += 20.0 * glm::dvec3(-0.5, 0.6, 0.2);
    outside.camera.cutaway = Cutaway::on;
  }
  return scenes;
}

template <class L>
bool has(const CompiledScene& scene) {
  return (scene.lobes & lobe_bit<L>) != 0;
}

TEST(Generated, ScenesHaveEveryFeature) {
  bool room = false, shell = false, triangles = false, convex_glass = false, mirror = false, oren_nayar = false,
       glow = false, many = false, schlick = false, report = false;
  for (unsigned seed = 0; seed < 25; ++seed) {
    const CompiledScene c = compile(RandomScene(seed).scene);
    room |= !c.room.empty(), shell |= !c.shells.empty(), triangles |= !c.triangles.empty(),
        mirror |= has<MirrorLobe>(c);
    oren_nayar |= has<OrenNayarLobe>(c), glow |= c.has_glow, many |= c.surfaces.rows() > small_table;
    for (const Solid& s : c.solids) convex_glass |= s.glass;
    for (std::size_t i = 0; i < static_cast<std::size_t>(c.surfaces.rows()); ++i) {
      schlick |= c.surfaces[lobe_column(first_column<SmoothGlassLobe>() + SmoothGlassLobe::schlick)][i] > 0;
      report |= c.surfaces[lobe_column(first_column<OrenNayarLobe>() + OrenNayarLobe::report)][i] > 0;
    }
  }
  EXPECT_TRUE(room && shell && triangles && convex_glass && mirror && oren_nayar && glow && many && schlick && report);
  std::array<bool, lamp_shapes> lamps{};
  for (const Scene& scene : many_scenes()) {
    const CompiledScene c = compile(scene);
    for (std::size_t i = 0; i < lamp_shapes; ++i) lamps[i] |= c.has_lamp_shape[i];
  }
  for (std::size_t i = 0; i < lamp_shapes; ++i) EXPECT_TRUE(lamps[i]) << "shape " << i << " of the list";
}

TEST(Kernel, LanesGiveTheScalarValuesBitForBit) {
  for (const Scene& scene : many_scenes()) {
    const CompiledScene compiled = compile(scene);
    const auto scalar = trace_all(compiled, effort, Lanes::scalar), native = trace_all(compiled, effort, Lanes::native);
    const std::ptrdiff_t i = first_difference(scalar, native);
    ASSERT_EQ(i, -1) << scene.name << ", " << replay(compiled, i) << ": " << scalar[static_cast<std::size_t>(i)]
                     << " and " << native[static_cast<std::size_t>(i)];
  }
}

TEST(Kernel, ValuesAreFiniteAndNotNegative) {
  for (const Scene& scene : many_scenes()) {
    const CompiledScene compiled = compile(scene);
    const auto rgb = trace_all(compiled, 4 * effort, Lanes::native);
    double sum = 0;
    for (std::size_t i = 0; i < rgb.size(); ++i) {
      ASSERT_TRUE(std::isfinite(rgb[i]) && rgb[i] >= 0)
          << scene.name << ", " << replay(compiled, static_cast<std::ptrdiff_t>(i)) << ": " << rgb[i];
      sum += static_cast<double>(rgb[i]);
    }
    EXPECT_TRUE(sum > 0 || compiled.max_radiance == 0) << scene.name;
  }
}

// Any rectangle and range of samples holds the values that the whole picture has there, so lanes that are refilled in
// another order, or stay idle at the end, change nothing.
TEST(Kernel, PathsDoNotDependOnTheirBlock) {
  std::mt19937 random(1);
  for (const Scene& scene : many_scenes()) {
    const CompiledScene compiled = compile(scene);
    constexpr int samples = 5;
    const auto whole = trace_all(compiled, samples, Lanes::native);
    for (int trial = 0; trial < 6; ++trial) {
      auto below = [&](int n) { return static_cast<int>(random() % static_cast<unsigned>(n)); };
      PathBlock block{
          below(compiled.width), below(compiled.height), 0, 0, static_cast<std::uint32_t>(below(samples)), 0};
      block.width = trial == 0 ? 1 : 1 + below(compiled.width - block.x0);
      block.height = trial == 0 ? 1 : 1 + below(compiled.height - block.y0);
      block.samples = trial == 0 ? 1 : 1 + below(samples - static_cast<int>(block.first_sample));
      const auto part = trace_all(compiled, block, trial % 3 == 2 ? Lanes::scalar : Lanes::native);
      std::size_t i = 0;
      for (int s = 0; s < block.samples; ++s)
        for (int y = 0; y < block.height; ++y)
          for (int x = 0; x < 3 * block.width; ++x, ++i) {
            const int sample = static_cast<int>(block.first_sample) + s;
            const auto k = static_cast<std::size_t>(((sample * compiled.height) + block.y0 + y) * compiled.width * 3 +
                                                    3 * block.x0 + x);
            ASSERT_EQ(part[i], whole[k]) << scene.name << ", " << replay(compiled, static_cast<std::ptrdiff_t>(k))
                                         << " in a block at (" << block.x0 << ", " << block.y0 << ") of " << block.width
                                         << "x" << block.height << "x" << block.samples;
          }
    }
  }
}

// The kernel leaves out what a scene does not use; a triangle out of everybody's sight makes it compile all in.
TEST(Kernel, WhatIsLeftOutChangesNothing) {
  for (const std::string name : {"cornell", "hexagon", "hexagon_diffuse", "report"}) {
    CompiledScene compiled = compile(from_file(name, 40, 30));
    const auto lean = trace_all(compiled, effort, Lanes::native);
    compiled.triangles.push_back({{1e6f, 1e6f, 1e6f}, {1e-3f, 0, 0}, {0, 1e-3f, 0}, 0});
    const auto full = trace_all(compiled, effort, Lanes::native);
    const std::ptrdiff_t i = first_difference(lean, full);
    EXPECT_EQ(i, -1) << name << ", " << replay(compiled, i);
  }
}

// The camera's ray through a pixel, from the definition of PinholeCamera and the path's first two random numbers.
TEST(Kernel, TraceRayReplaysACameraPath) {
  for (Scene scene : many_scenes()) {
    scene.render.light_paths = 0;  // which do not know of rays that are not the camera's
    scene.render.path_sharing = PathSharing::off;
    CompiledScene compiled = compile(scene);
    compiled.lamp_edges.clear(), compiled.lamp_images.clear();
    const auto rgb = trace_all(compiled, 2, Lanes::native);
    for (int path = 0; path < 2 * compiled.width * compiled.height; path += 7) {
      const int pixels = compiled.width * compiled.height, pixel = path % pixels, sample = path / pixels;
      const Sampler sampler = compiled.settings.sampler;
      const auto key = first_key<float>(sampler, static_cast<std::uint32_t>(compiled.settings.seed),
                                        static_cast<std::uint32_t>(pixel), static_cast<std::uint32_t>(sample));
      const Point2<float> in_pixel =
          random_pair<float>(sampler, key, {0}, static_cast<std::uint32_t>(Dimension::pixel_x));
      const float x = static_cast<float>(pixel % compiled.width) + in_pixel.u;
      const float y = static_cast<float>(pixel / compiled.width) + in_pixel.v;
      auto vec = [](const std::array<float, 3>& v) { return Vec3<float>{v[0], v[1], v[2]}; };
      const auto& camera = compiled.camera;
      const Vec3<float> d = normalize(fma(vec(camera.right), x, fma(vec(camera.down), y, vec(camera.corner))));
      GivenPath given;
      for (std::size_t k = 0; k < 3; ++k) given.origin[k] = static_cast<double>(camera.eye[k]) + compiled.origin[k];
      given.direction = {d.x, d.y, d.z};
      given.pixel = static_cast<std::uint32_t>(pixel), given.sample = static_cast<std::uint32_t>(sample);
      for (const Lanes lanes : {Lanes::scalar, Lanes::native}) {
        const Rgb value = trace_ray(compiled, given, lanes);
        const auto i = 3 * static_cast<std::size_t>(path);
        ASSERT_EQ((std::array{value.r, value.g, value.b}), (std::array{rgb[i], rgb[i + 1], rgb[i + 2]}))
            << scene.name << ", " << replay(compiled, static_cast<std::ptrdiff_t>(i));
      }
    }
  }
}

TEST(Kernel, SeedsGiveOtherPictures) {
  Scene scene = from_file("hexagon", 40, 30);
  const auto first = trace_all(compile(scene), 1, Lanes::native);
  scene.render.seed = 2;
  EXPECT_NE(first_difference(first, trace_all(compile(scene), 1, Lanes::native)), -1);
}

}  // namespace
