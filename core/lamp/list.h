#pragma once

#include "lamp/parallelogram.h"
#include "lamp/rectangle.h"
#include "lamp/sphere.h"
#include "lamp/triangle.h"

namespace glimt {

inline double area_of(const LampShape& shape) {
  return std::visit([](const auto& s) { return s.area(); }, shape);
}
inline LampBody body_of(const LampShape& shape) {
  return std::visit([](const auto& s) { return s.body(); }, shape);
}
inline bool is_sampled_by_area(const LampShape& shape) {
  return std::visit([](const auto& s) { return s.by_area; }, shape);
}

}  // namespace glimt
