// embree_rate SCENE: rays per second of Embree's tree, of the kernel's walk through its own tree and of its flat list
// on the same geometry, the same rays (random_walk) and all threads, as JSON. No shading. embree_rate N: the same in a
// room with a bumpy ball of about N triangles, without the list; also how long the tree takes to build, its size, and
// rays per second of the whole kernel, shading included.
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <functional>
#include <limits>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "embree_tree.h"
#include "kernel/geometry/intersect.h"
#include "mesh_shapes.h"
#include "render/render.h"
#include "scene/file/scene_file.h"

namespace {

using namespace glimt;

constexpr int width = lane_count<NativeLanes>;
constexpr int rays = 1 << 17;

template <int lanes>
struct Packet;
template <>
struct Packet<16> {
  using RayHit = RTCRayHit16;
  static constexpr auto intersect = rtcIntersect16;
  static constexpr auto occluded = rtcOccluded16;
};
template <>
struct Packet<8> {
  using RayHit = RTCRayHit8;
  static constexpr auto intersect = rtcIntersect8;
  static constexpr auto occluded = rtcOccluded8;
};
template <>
struct Packet<4> {
  using RayHit = RTCRayHit4;
  static constexpr auto intersect = rtcIntersect4;
  static constexpr auto occluded = rtcOccluded4;
};

int trace_packet(RTCScene tree, const Rays& r, int first, bool shadow, RTCIntersectContextFlags flags) {
  alignas(64) static constexpr auto valid = [] {
    std::array<int, width> v{};
    v.fill(-1);
    return v;
  }();
  using P = Packet<width>;
  P::RayHit query;
  const auto& d = shadow ? r.to_light : r.direction;
  auto copy = [&](const std::vector<float>& from, float* to) { std::copy_n(from.begin() + first, width, to); };
  copy(r.origin[0], query.ray.org_x), copy(r.origin[1], query.ray.org_y), copy(r.origin[2], query.ray.org_z);
  copy(d[0], query.ray.dir_x), copy(d[1], query.ray.dir_y), copy(d[2], query.ray.dir_z);
  std::fill_n(query.ray.tnear, width, 0.0f);
  std::fill_n(query.ray.time, width, 0.0f);
  std::fill_n(query.ray.mask, width, ~0U);
  std::fill_n(query.ray.flags, width, 0U);
  std::fill_n(query.hit.geomID, width, RTC_INVALID_GEOMETRY_ID);
  RTCIntersectContext c = context(flags);
  if (shadow) {
    copy(r.light_distance, query.ray.tfar);
    P::occluded(valid.data(), tree, &c, &query.ray);
    return static_cast<int>(std::count(query.ray.tfar, query.ray.tfar + width, -infinite));
  }
  std::fill_n(query.ray.tfar, width, infinite);
  P::intersect(valid.data(), tree, &c, &query);
  return width - static_cast<int>(std::count(query.hit.geomID, query.hit.geomID + width, RTC_INVALID_GEOMETRY_ID));
}

int trace_singles(RTCScene tree, const Rays& r, int first, bool shadow) {
  int hits = 0;
  for (int i = first; i < first + width; ++i) {
    RTCRayHit query = single(r, i, shadow);
    RTCIntersectContext c = context();
    if (shadow) {
      rtcOccluded1(tree, &c, &query.ray);
      hits += query.ray.tfar < 0;
    } else {
      rtcIntersect1(tree, &c, &query);
      hits += query.hit.geomID != RTC_INVALID_GEOMETRY_ID;
    }
  }
  return hits;
}

template <Features features>
int trace_list(const CompiledScene& scene, const Rays& r, int first, bool shadow) {
  using F = NativeLanes;
  auto vector = [&](const std::array<std::vector<float>, 3>& v) {
    return Vec3<F>{load<F>(&v[0][static_cast<std::size_t>(first)]), load<F>(&v[1][static_cast<std::size_t>(first)]),
                   load<F>(&v[2][static_cast<std::size_t>(first)])};
  };
  const Ray<F> ray{vector(r.origin), vector(shadow ? r.to_light : r.direction), Int<F>(-1)};
  const Mask<F> hit =
      shadow ? occluded<F, features>(scene, ray, load<F>(&r.light_distance[static_cast<std::size_t>(first)]),
                                     Int<F>(-1), Int<F>(-1))
             : closest_hit<F, features>(scene, ray).t < F(infinite);
  return std::popcount(bits(hit));
}

/// One way to trace all rays, and how long it took.
struct Contender {
  std::string name;
  std::function<int(int first, bool shadow)> trace;  ///< rays first to first + width - 1; returns how many of them hit
  bool shadow;
  int passes = 1;                 ///< over all rays in one run
  std::vector<double> seconds{};  ///< of each run, for one pass
  double hit_share = 0;

  /// Runs on all threads.
  double run() {
    long hits = 0;
    const auto start = std::chrono::steady_clock::now();
#pragma omp parallel reduction(+ : hits)
    for (int pass = 0; pass < passes; ++pass)
#pragma omp for schedule(dynamic, 64) nowait
      for (int chunk = 0; chunk < rays; chunk += 8 * width)
        for (int i = chunk; i < chunk + 8 * width; i += width) hits += trace(i, shadow);
    hit_share = static_cast<double>(hits) / rays / passes;
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count() / passes;
  }
};

/// Rays per second of each contender: the median of runs of 30 ms and more, taken in turn.
nlohmann::json rates(std::vector<Contender>& contenders) {
  constexpr int runs = 7;
  for (Contender& c : contenders)
    while (c.passes < 256 && c.run() * c.passes < 0.03) c.passes *= 2;
  for (int i = 0; i < runs; ++i)
    for (Contender& c : contenders) c.seconds.push_back(c.run());
  nlohmann::json result;
  for (Contender& c : contenders) {
    std::nth_element(c.seconds.begin(), c.seconds.begin() + runs / 2, c.seconds.end());
    const char* kind = c.shadow ? "shadow" : "closest";
    result[c.name][kind] = rays / c.seconds[runs / 2];
    result[c.name][std::string(kind) + "_hit_share"] = c.hit_share;
  }
  return result;
}

/// A room with a lamp, and a ball that is not convex.
Scene room_with_ball(int triangles) {
  Scene scene;
  scene.camera = {{0, 0, 3.9}, {0, 0, 0}, {0, 1, 0}, 70};
  scene.image = {256, 256};
  scene.materials = {lambertian("white", glm::dvec3{0.7}), light("lamp", glm::dvec3{10})};
  scene.polygons = box(glm::dvec3{-4}, glm::dvec3{4}, "white");
  scene.polygons.push_back(square_lamp(2, 3.99));
  // 4 (rings - 1) rings triangles
  const int rings = static_cast<int>(std::lround(std::sqrt(triangles / 4.0)));
  scene.meshes = {bumpy_ball("ball", "white", {0, 0, 0}, 2.5, rings, 0.3)};
  return scene;
}

double seconds_of(const std::function<void()>& work) {
  const auto start = std::chrono::steady_clock::now();
  work();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

/// Rays a second of the kernel, each path of which has four surfaces, and light from the lamp at the first three.
double shaded_rate(Scene scene) {
  constexpr int surfaces = 4, samples = 16;
  scene.render.max_depth = surfaces;
  scene.render.roulette_depth = 64;
  scene.render.path_sharing = PathSharing::off;
  const CompiledScene compiled = compile(scene);
  Film film = make_film(compiled);
  const double seconds = seconds_of([&] { render_pass(compiled, film, samples, {}); });
  return scene.image.width * scene.image.height * samples * (2.0 * surfaces - 1) / seconds;
}

}  // namespace

int main(int argc, char** argv) try {
  if (argc != 2) throw std::runtime_error("usage: embree_rate SCENE | embree_rate TRIANGLES");
  const bool many = std::string_view(argv[1]).find_first_not_of("0123456789") == std::string_view::npos;
  const Scene scene = many ? room_with_ball(std::stoi(argv[1])) : read_scene(argv[1]);
  CompiledScene compiled;
  const double build = seconds_of([&] { compiled = compile(scene, 0); });
  const CompiledScene listed = many ? CompiledScene{} : compile(scene, std::numeric_limits<std::size_t>::max());
  const Tree tree(scene, compiled.origin);
  const Rays r = random_walk(tree, compiled, rays);
  // As the kernel chooses: the rare shapes cost registers, so it leaves them out where the scene has none.
  const bool rare = !listed.triangles.empty() || !listed.shells.empty() || listed.room_hides_lamps ||
                    std::ranges::any_of(listed.solids, &Solid::glass) || listed.lamps.rows() != 1;
  constexpr Features all{}, few{.one_parallelogram = true,
                                .lobes = lobes_up_to(LobeUse::always),
                                .caustics = false,
                                .rare_shapes = false,
                                .glow = false,
                                .any_settings = false,
                                .tree = false};
  std::vector<Contender> contenders;
  for (const bool shadow : {false, true}) {
    contenders.push_back(
        {"embree_packets",
         [&](int i, bool s) { return trace_packet(tree, r, i, s, RTC_INTERSECT_CONTEXT_FLAG_COHERENT); }, shadow});
    // With this flag Embree takes packets apart.
    contenders.push_back(
        {"embree_packets_split",
         [&](int i, bool s) { return trace_packet(tree, r, i, s, RTC_INTERSECT_CONTEXT_FLAG_INCOHERENT); }, shadow});
    contenders.push_back({"embree_single", [&](int i, bool s) { return trace_singles(tree, r, i, s); }, shadow});
    if (compiled.tree)
      contenders.push_back({"tree", [&](int i, bool s) { return trace_list<all>(compiled, r, i, s); }, shadow});
    if (!many)
      contenders.push_back(
          {"flat_list",
           [&](int i, bool s) { return rare ? trace_list<all>(listed, r, i, s) : trace_list<few>(listed, r, i, s); },
           shadow});
  }
  nlohmann::json result = rates(contenders);
  result["lanes"] = width;
  result["threads"] = hardware_threads();
  if (many) {
    result["triangles"] = compiled.tree->triangles;
    result["compile_seconds"] = build;
    result["compile_again_seconds"] = seconds_of([&] { compile(scene); });
    result["tree_bytes"] = compiled.tree->bytes();
    result["shaded"] = shaded_rate(scene);
  }
  std::puts(result.dump(1).c_str());
} catch (const std::exception& error) {
  std::fprintf(stderr, "embree_rate: %s\n", error.what());
  return 1;
}
