#include "viewer/state/camera_moves.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <numbers>
#include <vector>

#include "kernel/entry/kernels.h"
#include "scene/clearance.h"
#include "scene/file/scene_file.h"
#include "scene/surroundings.h"

namespace glimt {
namespace {

using glm::dvec3;

/// Least angle of the view from straight up and straight down, radians.
constexpr double from_pole = 0.05;
constexpr double nearest = 1e-3;     ///< least distance of the eye from look_at, metres
constexpr double margin = 0.005;     ///< distance of moved cameras from surfaces, in sizes of the scene
constexpr double longest_arc = 0.1;  ///< of a step of an orbit, radians
constexpr double least_lit = 0.125;  ///< least share of the picture in which a moved camera sees light

}  // namespace

Camera orbit(const Camera& camera, const dvec3& pivot, double yaw, double pitch) {
  const dvec3 forward = normalize(camera.look_at - camera.eye), up = normalize(camera.up);
  const dvec3 right = normalize(cross(forward, up));
  const double from_up = std::acos(std::clamp(dot(forward, up), -1.0, 1.0));
  // Where the file's camera already looks steeper than that, it may come back but not go further.
  const double lowest = std::min(from_pole, from_up), highest = std::max(std::numbers::pi - from_pole, from_up);
  const double allowed = from_up - std::clamp(from_up - pitch, lowest, highest);
  const glm::dquat turn = glm::angleAxis(yaw, up) * glm::angleAxis(allowed, right);
  Camera turned = camera;
  turned.eye = pivot + turn * (camera.eye - pivot);
  turned.look_at = turned.eye + turn * (camera.look_at - camera.eye);
  return turned;
}

Camera pan(const Camera& camera, const dvec3& by) {
  Camera moved = camera;
  moved.eye += by;
  moved.look_at += by;
  return moved;
}

Camera dolly(const Camera& camera, double factor) {
  const dvec3 back = camera.eye - camera.look_at;
  Camera moved = camera;
  moved.eye = camera.look_at + back * std::max(factor, nearest / length(back));
  return moved;
}

double camera_margin(const Scene& scene) { return margin * size_of(scene); }

Camera approach(const Scene& scene, const Camera& to) {
  const Camera& from = scene.camera;
  Camera moved = to;
  if (to.eye != from.eye && to.cutaway == Cutaway::off)
    moved.eye = slide(scene, from.eye, to.eye, camera_margin(scene));
  if (moved.eye != to.eye) {
    const dvec3 forward = normalize(to.look_at - to.eye);
    const bool aimed = to.look_at == from.look_at;
    const double distance = aimed ? dot(to.look_at - moved.eye, forward) : length(to.look_at - to.eye);
    moved.look_at = moved.eye + forward * std::max(distance, nearest);
  }
  const auto lit = [&](const Camera& camera) {
    Scene seen = scene;
    seen.camera = camera;
    return lit_share(std::move(seen));
  };
  const double share = lit(moved);
  return share >= least_lit || share >= lit(from) ? moved : from;
}

Camera approach_orbit(Scene scene, const dvec3& pivot, double yaw, double pitch) {
  const int steps = 1 + static_cast<int>(std::max(std::abs(yaw), std::abs(pitch)) / longest_arc);
  for (int i = 0; i < steps; ++i)
    scene.camera = approach(scene, orbit(scene.camera, pivot, yaw / steps, pitch / steps));
  return scene.camera;
}

double lit_share(Scene scene) {
  constexpr int pixels = 16, samples = 2;
  const double shape = static_cast<double>(scene.image.height) / scene.image.width;
  scene.image = {pixels, std::clamp(static_cast<int>(std::lround(pixels * shape)), 1, 4 * pixels)};
  // Plain paths: the set-up of light paths, connections and sharing would take longer than tracing.
  scene.render = {};
  scene.render.light_paths = 0;
  scene.render.sphere_connections = SphereConnections::off;
  scene.render.path_sharing = PathSharing::off;
  PathBlock block{0, 0, scene.image.width, scene.image.height, 0, samples};
  std::vector<float> rgb(3 * static_cast<std::size_t>(block.paths()));
  try {
    trace(compile(scene), block, Lanes::native, rgb.data());
  } catch (const SceneError&) {
    return 0;
  }
  int lit = 0;
  for (std::size_t i = 0; i < rgb.size(); i += 3) lit += rgb[i] + rgb[i + 1] + rgb[i + 2] > 0 ? 1 : 0;
  return static_cast<double>(lit) / block.paths();
}

Camera back_in_room(const Scene& scene, const Camera& opened) {
  Scene back = scene;
  back.camera = opened;
  const auto place = place_in_room(scene, scene.camera.eye);
  if (!place || (opened != scene.camera && lit_share(back) >= least_lit)) return opened;
  back.camera = scene.camera;
  back.camera.eye = *place;
  back.camera.look_at += *place - scene.camera.eye;
  return back.camera;
}

void move_sphere(Scene& scene, std::size_t sphere, const dvec3& by) {
  Sphere& s = scene.spheres[sphere];
  const dvec3& eye = scene.camera.eye;
  const bool around = length(s.center - eye) < s.radius;
  s.center += by;
  const double room = camera_margin(scene), distance = length(s.center - eye);
  const dvec3 away = distance > 0 ? (s.center - eye) / distance : -normalize(by);
  const double allowed =
      around ? std::min(distance, std::max(0.0, s.radius - room)) : std::max(distance, s.radius + room);
  if (allowed != distance) s.center = eye + away * allowed;
}

}  // namespace glimt
