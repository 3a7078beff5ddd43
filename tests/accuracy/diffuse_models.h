#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>

/// The diffuse models as their papers print them, with angles and in double precision, and integrals over the
/// hemisphere. Values are BRDFs times pi, for reflectance 1.
namespace glimt {

/// Two directions by their angles to the normal; `phi` is the angle between them about the normal.
struct Angles {
  double in, out, phi;
};

inline double lambertian_model(const Angles&) { return 1; }

/// Oren and Nayar 1994, eq. 30. With `report`, the report's eq. 7, which has sin(beta) instead of tan(beta).
inline double oren_nayar_model(const Angles& w, double sigma, bool report) {
  const double s2 = sigma * sigma, a = 1 - 0.5 * s2 / (s2 + 0.33), b = 0.45 * s2 / (s2 + 0.09);
  const double alpha = std::max(w.in, w.out), beta = std::min(w.in, w.out);
  return a + b * std::max(0.0, std::cos(w.phi)) * std::sin(alpha) * (report ? std::sin(beta) : std::tan(beta));
}

/// The single-scattering part of EON, Fujii's model (Portsmouth, Kutz and Hill 2025, eqs. 4 to 6).
inline double fon_model(const Angles& w, double roughness) {
  const double a = 1 / (1 + (0.5 - 2 / (3 * std::numbers::pi)) * roughness);
  const double s = std::sin(w.in) * std::sin(w.out) * std::cos(w.phi);
  const double t = s > 0 ? std::max(std::cos(w.in), std::cos(w.out)) : 1;
  return a * (1 + roughness * s / t);
}

/// The directional albedo of the model f for reflectance 1: the integral of f cos / pi over the hemisphere of incoming
/// light. It uses the midpoint rule in the angle about the normal and in x, the root of the cosine. So grazing
/// directions, where the models change fast, have many points. Cosines below x^2 have the share x^4 of the
/// cosine-weighted hemisphere.
template <class Model>
double albedo(const Model& f, double out, int steps = 400) {
  double sum = 0;
  const int turns = steps / 4;
  for (int i = 0; i < steps; ++i) {
    const double x = (i + 0.5) / steps, in = std::acos(x * x);
    const double share = (std::pow(i + 1, 4) - std::pow(i, 4)) / std::pow(steps, 4);
    for (int k = 0; k < turns; ++k) sum += share / turns * f(Angles{in, out, (k + 0.5) / turns * std::numbers::pi});
  }
  return sum;
}

/// The directional albedo of all of EON: what single scattering loses, 1 - E, is reflected several times (their eqs. 18
/// to 21). E and its mean are integrated here, not taken from their closed forms.
inline double eon_albedo_model(double out, double roughness, double reflectance) {
  const auto single = [&](double angle, int steps) {
    return albedo([&](const Angles& w) { return fon_model(w, roughness); }, angle, steps);
  };
  double mean = 0;
  constexpr int steps = 100;
  for (int i = 0; i < steps; ++i) mean += single(std::asin(std::sqrt((i + 0.5) / steps)), 100) / steps;
  const double e = single(out, 400);
  return reflectance * e + reflectance * reflectance * mean / (1 - reflectance * (1 - mean)) * (1 - e);
}

}  // namespace glimt
