#pragma once

#include <array>

#include "math/twice.h"

namespace glimt {

/// A vector or colour with one value per lane in each component.
template <class F>
struct Vec3 {
  F x, y, z;

  static Vec3 all(F v) { return {v, v, v}; }

  friend Vec3 operator+(const Vec3& a, const Vec3& b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
  friend Vec3 operator-(const Vec3& a, const Vec3& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
  friend Vec3 operator*(const Vec3& a, const Vec3& b) { return {a.x * b.x, a.y * b.y, a.z * b.z}; }
  friend Vec3 operator*(const Vec3& a, F s) { return {a.x * s, a.y * s, a.z * s}; }
};

/// The same vector in every lane.
template <class F>
Vec3<F> broadcast(float x, float y, float z) {
  return {F(x), F(y), F(z)};
}
template <class F>
Vec3<F> broadcast(const std::array<float, 3>& v) {
  return broadcast<F>(v[0], v[1], v[2]);
}

/// Never -0, so that division by it gives the sign that intersections with parallel planes need.
template <class F>
F dot(const Vec3<F>& a, const Vec3<F>& b) {
  return fma(a.x, b.x, fma(a.y, b.y, fma(a.z, b.z, F(0.0f))));
}

/// b - a s
template <class F>
Vec3<F> fnma(const Vec3<F>& a, F s, const Vec3<F>& b) {
  return {fnma(a.x, s, b.x), fnma(a.y, s, b.y), fnma(a.z, s, b.z)};
}

/// a s + b
template <class F>
Vec3<F> fma(const Vec3<F>& a, F s, const Vec3<F>& b) {
  return {fma(a.x, s, b.x), fma(a.y, s, b.y), fma(a.z, s, b.z)};
}

/// a b + c, component by component
template <class F>
Vec3<F> fma(const Vec3<F>& a, const Vec3<F>& b, const Vec3<F>& c) {
  return {fma(a.x, b.x, c.x), fma(a.y, b.y, c.y), fma(a.z, b.z, c.z)};
}

template <class F>
Vec3<F> cross(const Vec3<F>& a, const Vec3<F>& b) {
  return {fnma(a.z, b.y, a.y * b.z), fnma(a.x, b.z, a.z * b.x), fnma(a.y, b.x, a.x * b.y)};
}

template <class F>
Vec3<F> normalize(const Vec3<F>& a) {
  return a * inverse_sqrt(dot(a, a));
}

template <class F>
Vec3<F> select(const Mask<F>& m, const Vec3<F>& a, const Vec3<F>& b) {
  return {select(m, a.x, b.x), select(m, a.y, b.y), select(m, a.z, b.z)};
}

template <class F>
F max_component(const Vec3<F>& a) {
  return max(a.x, max(a.y, a.z));
}

}  // namespace glimt
