#pragma once

#include "material/list.h"
#include "scene_parts.h"

/// Materials that the tests of glossy surfaces share.
namespace glimt {

/// Gold, as in scenes/glossy.toml.
inline Material metal(double roughness, const dvec3& eta = dvec3{0.143, 0.375, 1.442},
                      const dvec3& k = dvec3{3.983, 2.386, 1.603}) {
  return Material{.name = "model", .type = "conductor"}
      .with(Conductor::eta, eta)
      .with(Conductor::k, k)
      .with(Conductor::roughness, roughness);
}
/// A metal that reflects all light: its Fresnel factor is 1.
inline Material white_metal(double roughness) { return metal(roughness, dvec3{0}, dvec3{1}); }
inline Material frosted(double roughness, double ior = 1.5) {
  return glass("model", ior).with(Glass::roughness, roughness);
}

}  // namespace glimt
