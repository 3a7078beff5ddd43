#pragma once

#include "compile/compiled_scene.h"
#include "math/vec.h"

/// The pinhole seen from the scene: where light paths show in the image.
namespace glimt {

/// Radiance that a pixel (box filter) gets from a watt which leaves a diffuse surface evenly, over rho / pi: cos /
/// (distance^2 solid angle of the pixel), 1/(m^2 sr). `direction` is of unit length, from the eye to the surface.
template <class F>
F pinhole_importance(const CompiledScene& scene, const Vec3<F>& direction, F distance, F cos_surface) {
  const F cos = dot(direction, broadcast<F>(scene.camera.forward));
  return cos_surface * reciprocal(distance * distance * (cos * cos * cos) * F(scene.camera.pixel_area));
}

/// Light reaches the first surface of a camera path by way of mirrors or glass on light paths and, by chance, on paths
/// from the camera: two unbiased estimates of the same, each of which counts by this share. With light paths of flux w
/// that splat w importance rho / pi each, and chance that finds rho L or nothing, the variances are as w importance to
/// pi L, and weights by inverse variance are best. They depend on the first surface alone, which both kinds of path
/// know. `light_path_noise` is w / (pi L). The share keeps splats bounded where the importance is not, close to the
/// eye.
template <class F>
F light_path_share(const CompiledScene& scene, F importance) {
  return reciprocal(fma(importance, F(scene.light_path_noise), F(1.0f)));
}

/// A place in the image.
template <class F>
struct Projection {
  Int<F> pixel;
  Mask<F> inside;
};

/// `direction` is of unit length, from the eye.
template <class F>
Projection<F> project(const CompiledScene& scene, const Vec3<F>& direction) {
  const F cos = dot(direction, broadcast<F>(scene.camera.forward));
  const F scale = reciprocal(cos * F(scene.camera.pixel_area));
  const F x = fma(dot(direction, broadcast<F>(scene.camera.right)), scale, F(0.5f * static_cast<float>(scene.width)));
  const F y = fma(dot(direction, broadcast<F>(scene.camera.down)), scale, F(0.5f * static_cast<float>(scene.height)));
  const Mask<F> inside = (cos > F(0.0f)) & (x >= F(0.0f)) & (y >= F(0.0f)) & (x < F(static_cast<float>(scene.width))) &
                         (y < F(static_cast<float>(scene.height)));
  const Int<F> column = to_int(select(inside, x, F(0.0f))), row = to_int(select(inside, y, F(0.0f)));
  return {row * Int<F>(scene.width) + column, inside};
}

}  // namespace glimt
