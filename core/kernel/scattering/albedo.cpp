#include "kernel/scattering/albedo.h"

#include <cmath>

#include "kernel/scattering/surfaces.h"

namespace glimt {

double directional_albedo(const Material& material, double angle) {
  Scene scene;
  scene.materials = {material};
  scene.spheres = {{"", material.name, {0, 0, 0}, 1}};
  const CompiledScene compiled = compile(scene);
  const Surfaces<float, Features{}> surfaces(compiled);

  // The top of the sphere, seen under this angle.
  const Vec3<float> towards{static_cast<float>(std::sin(angle)), 0, static_cast<float>(std::cos(angle))};
  Interaction<float> at{};
  at.point = at.normal = {0, 0, 1};
  at.front = true;
  at.surface = 0;
  at.cos_o = towards.z;
  surfaces.look_up_kind(at);

  // Points of an additive recurrence in three dimensions: multiples of powers of 1/g with g^4 = g + 1 (Roberts 2018).
  constexpr int samples = 1 << 14;
  constexpr double g = 1.2207440846057596;
  double sum = 0;
  for (int i = 1; i <= samples; ++i) {
    const auto number = [i](double step) {
      const double x = i * step;
      return std::min(static_cast<float>(x - std::floor(x)), 0x1.fffffep-1F);
    };
    const ScatterSample<float> s =
        surfaces.sample(at, towards, {number(1 / g), number(1 / (g * g))}, number(1 / (g * g * g)));
    sum += static_cast<double>(s.weight.y);
  }
  return sum / samples;
}

}  // namespace glimt
