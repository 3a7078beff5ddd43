#pragma once

#include <glm/geometric.hpp>
#include <numbers>
#include <vector>

#include "scene_parts.h"

/// Light in a convex room with Lambertian walls, from a linear system: patches have constant radiance, and the form
/// factor from a point to a patch is exact.
namespace glimt {

/// The share of a point's cosine-weighted hemisphere that a polygon covers, where the polygon is wholly above the
/// horizon (Lambert 1760). Each edge and the point span a plane. Sum, over the edges, the angle under which the edge is
/// seen times the component of that plane's unit normal along `normal`; then divide by 2 pi.
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

/// A room with a lamp that lies in one of its faces, or so close to it that the rest of the room sees no difference.
struct Room {
  std::vector<Patch> patches;
  std::vector<dvec3> lamp;  ///< corners
  int lamp_face = 0;        ///< the face with the lamp, which gets no direct light
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
