#pragma once

#include <glm/glm.hpp>
#include <limits>

namespace glimt {

/// An axis-aligned bounding box. At first it holds no points, and `low` is above `high`.
struct Box {
  glm::dvec3 low{std::numeric_limits<double>::infinity()};
  glm::dvec3 high{-std::numeric_limits<double>::infinity()};

  void add(const glm::dvec3& p) { low = min(low, p), high = max(high, p); }
  double size() const { return length(high - low); }
};

/// Whether the boxes are within the tolerance of each other along every axis.
inline bool meet(const Box& a, const Box& b, double tolerance) {
  return all(lessThanEqual(a.low, b.high + tolerance)) && all(lessThanEqual(b.low, a.high + tolerance));
}

}  // namespace glimt
