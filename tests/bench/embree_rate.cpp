// embree_rate SCENE: rays per second of Embree's tree and of the kernel's flat list on the same geometry, the same rays
// and all threads, as JSON. The rays are those of a random walk from the camera: each starts near the surface that the
// one before has hit, in a uniform direction off it. A shadow ray joins two of their origins. No shading.
#include <embree3/rtcore.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>
#include <limits>
#include <nlohmann/json.hpp>
#include <random>
#include <stdexcept>
#include <vector>

#include "kernel/intersect.h"
#include "render/render.h"
#include "scene/scene_file.h"

namespace {

using namespace glimt;
using glm::vec3;

constexpr int width = lane_count<NativeLanes>;
constexpr int rays = 1 << 17;
constexpr float infinite = std::numeric_limits<float>::infinity();

/// The scene in compiled space: flat shapes as one mesh of triangles, spheres as spheres.
class Tree {
 public:
  Tree(const Scene& scene, const std::array<double, 3>& origin)
      : device_(rtcNewDevice(nullptr)), scene_(rtcNewScene(device_)) {
    const glm::dvec3 middle(origin[0], origin[1], origin[2]);
    std::vector<vec3> vertices;
    std::vector<std::array<unsigned, 3>> triangles;
    auto first = [&] { return static_cast<unsigned>(vertices.size()); };
    for (const Polygon& polygon : scene.polygons) {
      for (unsigned k = 1; k + 1 < polygon.vertices.size(); ++k)
        triangles.push_back({first(), first() + k, first() + k + 1});
      for (const auto& v : polygon.vertices) vertices.emplace_back(v - middle);
    }
    for (const Mesh& mesh : scene.meshes) {
      for (const auto& t : mesh.triangles)
        triangles.push_back({first() + static_cast<unsigned>(t[0]), first() + static_cast<unsigned>(t[1]),
                             first() + static_cast<unsigned>(t[2])});
      for (const auto& v : mesh.vertices) vertices.emplace_back(v - middle);
    }
    std::vector<std::array<float, 4>> spheres;
    for (const Sphere& sphere : scene.spheres) {
      const vec3 c(sphere.center - middle);
      spheres.push_back({c.x, c.y, c.z, static_cast<float>(sphere.radius)});
    }
    add(RTC_GEOMETRY_TYPE_TRIANGLE, RTC_FORMAT_FLOAT3, vertices, triangles);
    add(RTC_GEOMETRY_TYPE_SPHERE_POINT, RTC_FORMAT_FLOAT4, spheres, std::vector<unsigned>{});
    rtcSetSceneBuildQuality(scene_, RTC_BUILD_QUALITY_HIGH);
    rtcCommitScene(scene_);
    if (rtcGetDeviceError(device_) != RTC_ERROR_NONE) throw std::runtime_error("Embree refuses the scene");
  }
  Tree(const Tree&) = delete;
  Tree& operator=(const Tree&) = delete;
  ~Tree() {
    rtcReleaseScene(scene_);
    rtcReleaseDevice(device_);
  }
  operator RTCScene() const { return scene_; }

 private:
  template <class Vertex, class Index>
  void add(RTCGeometryType type, RTCFormat format, const std::vector<Vertex>& vertices,
           const std::vector<Index>& indices) {
    if (vertices.empty()) return;
    RTCGeometry geometry = rtcNewGeometry(device_, type);
    std::copy(vertices.begin(), vertices.end(),
              static_cast<Vertex*>(rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, format, sizeof(Vertex),
                                                           vertices.size())));
    if (!indices.empty())
      std::copy(indices.begin(), indices.end(),
                static_cast<Index*>(rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                                                            sizeof(Index), indices.size())));
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(scene_, geometry);
    rtcReleaseGeometry(geometry);
  }

  RTCDevice device_;
  RTCScene scene_;
};

/// Origins, directions and ends of rays, compiled space.
struct Rays {
  std::array<std::vector<float>, 3> origin, direction, to_light;  ///< `to_light`: unit, of the shadow rays
  std::vector<float> light_distance;                              ///< metres
};

RTCRayHit single(const Rays& r, int i, bool shadow) {
  RTCRayHit query{};
  const auto k = static_cast<std::size_t>(i);
  const auto& d = shadow ? r.to_light : r.direction;
  query.ray.org_x = r.origin[0][k], query.ray.org_y = r.origin[1][k], query.ray.org_z = r.origin[2][k];
  query.ray.dir_x = d[0][k], query.ray.dir_y = d[1][k], query.ray.dir_z = d[2][k];
  query.ray.tfar = shadow ? r.light_distance[k] : infinite;
  query.ray.mask = ~0U;
  query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  return query;
}

RTCIntersectContext context(RTCIntersectContextFlags flags = RTC_INTERSECT_CONTEXT_FLAG_INCOHERENT) {
  RTCIntersectContext c;
  rtcInitIntersectContext(&c);
  c.flags = flags;
  return c;
}

Rays random_walk(RTCScene tree, const CompiledScene& scene) {
  std::mt19937 random(1);
  std::normal_distribution<float> normal;
  auto uniform_direction = [&] { return glm::normalize(vec3(normal(random), normal(random), normal(random))); };
  const vec3 eye(scene.camera.eye[0], scene.camera.eye[1], scene.camera.eye[2]);
  vec3 origin = eye, direction = uniform_direction();
  Rays r;
  for (auto* v : {&r.origin, &r.direction, &r.to_light})
    for (auto& axis : *v) axis.resize(rays);
  r.light_distance.resize(rays);
  for (int i = 0; i < rays; ++i) {
    const auto place = static_cast<std::size_t>(i);
    for (int k = 0; k < 3; ++k) r.origin[static_cast<std::size_t>(k)][place] = origin[k];
    for (int k = 0; k < 3; ++k) r.direction[static_cast<std::size_t>(k)][place] = direction[k];
    RTCRayHit query = single(r, i, false);
    RTCIntersectContext c = context();
    rtcIntersect1(tree, &c, &query);
    const bool hit = query.hit.geomID != RTC_INVALID_GEOMETRY_ID;
    if (!hit || i % 16 == 0) {
      origin = eye, direction = uniform_direction();
    } else {
      origin += direction * (query.ray.tfar * 0.999f);
      vec3 n(query.hit.Ng_x, query.hit.Ng_y, query.hit.Ng_z);
      if (glm::dot(n, direction) > 0) n = -n;
      direction = uniform_direction();
      if (glm::dot(n, direction) < 0) direction = -direction;
    }
  }
  std::uniform_int_distribution<std::size_t> any_ray(0, rays - 1);
  for (std::size_t i = 0; i < rays; ++i) {
    vec3 way(0);
    while (glm::length(way) < 0.1f) {
      const std::size_t j = any_ray(random);
      way = {r.origin[0][j] - r.origin[0][i], r.origin[1][j] - r.origin[1][i], r.origin[2][j] - r.origin[2][i]};
    }
    r.light_distance[i] = glm::length(way);
    for (int k = 0; k < 3; ++k) r.to_light[static_cast<std::size_t>(k)][i] = way[k] / r.light_distance[i];
  }
  return r;
}

/// Rays per second on all threads; `trace(i)` traces rays i to i + width - 1 and returns how many of them hit. The
/// median of nine runs.
template <class Trace>
double rate(Trace trace, double& hit_share) {
  std::vector<double> seconds;
  long hits = 0;
  for (int repeat = 0; repeat < 10; ++repeat) {
    hits = 0;
    const auto start = std::chrono::steady_clock::now();
#pragma omp parallel for schedule(dynamic, 64) reduction(+ : hits)
    for (int i = 0; i < rays; i += width) hits += trace(i);
    if (repeat > 0) seconds.push_back(std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
  }
  hit_share = static_cast<double>(hits) / rays;
  std::nth_element(seconds.begin(), seconds.begin() + 4, seconds.end());
  return rays / seconds[4];
}

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

nlohmann::json measure(auto trace) {
  nlohmann::json result;
  double share = 0;
  result["closest"] = rate([&](int i) { return trace(i, false); }, share);
  result["closest_hit_share"] = share;
  result["shadow"] = rate([&](int i) { return trace(i, true); }, share);
  result["shadow_hit_share"] = share;
  return result;
}

}  // namespace

int main(int argc, char** argv) try {
  if (argc != 2) throw std::runtime_error("usage: embree_rate SCENE");
  const Scene scene = read_scene(argv[1]);
  const CompiledScene compiled = compile(scene);
  const Tree tree(scene, compiled.origin);
  const Rays r = random_walk(tree, compiled);
  // As the kernel chooses: the rare shapes cost registers, so it leaves them out where the scene has none.
  const bool rare = !compiled.triangles.empty() || !compiled.shells.empty() || compiled.room_hides_lamps ||
                    std::ranges::any_of(compiled.solids, &Solid::glass) || compiled.lamps.rows() != 1;
  constexpr Features all{.small_table = false, .one_rectangle = false, .oren_nayar = true, .rare = true};
  constexpr Features few{.small_table = false, .one_rectangle = true, .oren_nayar = false, .rare = false};
  // With the flag for incoherent rays Embree takes packets apart.
  auto packets = [&](RTCIntersectContextFlags flags) {
    return measure([&](int i, bool shadow) { return trace_packet(tree, r, i, shadow, flags); });
  };
  const nlohmann::json result{
      {"lanes", width},
      {"threads", hardware_threads()},
      {"embree_packets", packets(RTC_INTERSECT_CONTEXT_FLAG_COHERENT)},
      {"embree_packets_split", packets(RTC_INTERSECT_CONTEXT_FLAG_INCOHERENT)},
      {"embree_single", measure([&](int i, bool shadow) { return trace_singles(tree, r, i, shadow); })},
      {"flat_list", measure([&](int i, bool shadow) {
         return rare ? trace_list<all>(compiled, r, i, shadow) : trace_list<few>(compiled, r, i, shadow);
       })}};
  std::puts(result.dump(1).c_str());
} catch (const std::exception& error) {
  std::fprintf(stderr, "embree_rate: %s\n", error.what());
  return 1;
}
