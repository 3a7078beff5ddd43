#pragma once

#include "compile/lowering.h"

/// Lamps near to what they light: sampled by area their light has much noise there, and none that is bounded where they
/// touch it.
namespace glimt {

/// A flat or round piece of what is in reach of light, in world space.
struct NearPiece {
  std::vector<glm::dvec3> outline;  ///< of a sphere its centre
  double radius;                    ///< of a sphere, else 0
  const Material* material;
  std::string_view name;

  double area() const;
  /// Of a ball about outline[0] that holds it.
  double bound() const;
};

std::vector<NearPiece> pieces_in_reach(const Lowering& l);

/// Of the albedo, the largest channel.
inline double brightest(const Material& m) {
  const glm::dvec3 albedo = material_info(m.type).albedo(m);
  return std::max({albedo.r, albedo.g, albedo.b});
}

/// A matt piece that the lamp lights and that comes nearer to it than `share` of the lamp's size, the root of its area.
/// Null where there is none, and where so many pieces are not compared, so that edits stay swift.
const NearPiece* nearly_touched(const Lowering& l, const LampPiece& lamp, const std::vector<NearPiece>& pieces,
                                double share);

/// Chooses how flat lamps are sampled: lower_lamps() has them by area.
void choose_lamp_sampling(Lowering& l);

}  // namespace glimt
