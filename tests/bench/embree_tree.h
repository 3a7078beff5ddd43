#pragma once

#include <embree3/rtcore.h>

#include <algorithm>
#include <array>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>
#include <limits>
#include <random>
#include <stdexcept>
#include <vector>

#include "compile/compiled_scene.h"

/// Embree's tree of a scene, and rays to measure it with.
namespace glimt {

inline constexpr float infinite = std::numeric_limits<float>::infinity();

/// The scene in compiled space: flat shapes as one mesh of triangles, spheres as spheres.
class Tree {
  using vec3 = glm::vec3;

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

/// Origins, directions and ends of rays, in compiled space.
struct Rays {
  std::array<std::vector<float>, 3> origin, direction, to_light;  ///< `to_light`: unit directions of the shadow rays
  std::vector<float> light_distance;                              ///< metres
};

inline RTCRayHit single(const Rays& r, int i, bool shadow) {
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

inline RTCIntersectContext context(RTCIntersectContextFlags flags = RTC_INTERSECT_CONTEXT_FLAG_INCOHERENT) {
  RTCIntersectContext c;
  rtcInitIntersectContext(&c);
  c.flags = flags;
  return c;
}

/// The rays of a random walk from the camera. Each starts near the surface that the last one hit, in a uniform
/// direction away from it. A shadow ray joins two of the origins.
inline Rays random_walk(RTCScene tree, const CompiledScene& scene, int rays) {
  using glm::vec3;
  std::mt19937 random(1);
  std::normal_distribution<float> normal;
  auto uniform_direction = [&] { return glm::normalize(vec3(normal(random), normal(random), normal(random))); };
  const vec3 eye(scene.camera.eye[0], scene.camera.eye[1], scene.camera.eye[2]);
  vec3 origin = eye, direction = uniform_direction();
  Rays r;
  for (auto* v : {&r.origin, &r.direction, &r.to_light})
    for (auto& axis : *v) axis.resize(static_cast<std::size_t>(rays));
  r.light_distance.resize(static_cast<std::size_t>(rays));
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
  std::uniform_int_distribution<std::size_t> any_ray(0, r.light_distance.size() - 1);
  for (std::size_t i = 0; i < r.light_distance.size(); ++i) {
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

}  // namespace glimt
