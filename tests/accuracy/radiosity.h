#pragma once

#include <glm/geometric.hpp>
#include <numbers>
#include <vector>

#include "scene_parts.h"

/// Light in a convex room of Lambertian walls by a linear system: patches of constant radiance, with the exact share of
/// each patch in what a point sees.
namespace glimt {

/// Share of the cosine-weighted hemisphere of a point that a polygon covers which is wholly above its horizon: half the
/// sum over the edges of the angle they are seen under times the component of the edge's plane's normal (Lambert 1760),
/// over pi.
inline double form_factor(const std::vector<dvec3>& polygon, const dvec3& point, const dvec3& normal) {
  double sum = 0;
  dvec3 a = normalize(polygon.back() - point);
  for (const dvec3& v : polygon) {
    const dvec3 b = normalize(v - point), c = cross(a, b);
    const double sin = length(c);
    if (sin > 1e-14) sum += std::atan2(sin, dot(a, b)) / sin * dot(c, normal);
    a = b;
  }
  return std::abs(sum) / (2 * std::numbers::pi);
}

struct Patch {
  std::vector<dvec3> corners;
  dvec3 centre, normal;  ///< inwards
  int face;
  dvec3 reflectance;
  dvec3 radiance{0};
};

/// A room with a lamp that is flush with a face as far as the rest of the room can tell.
struct Room {
  std::vector<Patch> patches;
  std::vector<dvec3> lamp;  ///< corners
  int lamp_face = 0;        ///< sees no light of the lamp
  dvec3 emitted{0};         ///< radiance of the lamp

  /// Radiance that a point of a face reflects.
  dvec3 reflected(const dvec3& point, const dvec3& normal, int face, const dvec3& reflectance) const {
    dvec3 sum = face == lamp_face ? dvec3{0} : form_factor(lamp, point, normal) * emitted;
    for (const Patch& p : patches)
      if (p.face != face) sum += form_factor(p.corners, point, normal) * p.radiance;
    return reflectance * sum;
  }

  /// Finds the radiance of all patches, to a millionth, by repeated reflection.
  void solve() {
    const std::size_t n = patches.size();
    std::vector<float> share(n * n);
    std::vector<dvec3> direct(n);
    for (std::size_t i = 0; i < n; ++i) {
      const Patch& p = patches[i];
      if (p.face != lamp_face) direct[i] = p.reflectance * form_factor(lamp, p.centre, p.normal) * emitted;
      for (std::size_t k = 0; k < n; ++k)
        if (patches[k].face != p.face)
          share[i * n + k] = static_cast<float>(form_factor(patches[k].corners, p.centre, p.normal));
    }
    for (int bounce = 0; bounce < 60; ++bounce)
      for (std::size_t i = 0; i < n; ++i) {
        dvec3 sum{0};
        for (std::size_t k = 0; k < n; ++k) sum += static_cast<double>(share[i * n + k]) * patches[k].radiance;
        patches[i].radiance = direct[i] + patches[i].reflectance * sum;
      }
  }
};

}  // namespace glimt
