#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

/// Tail probabilities for statistical tests. Random numbers are seeded, so a test that passes goes on passing. The
/// stated probability of a false alarm is that of one choice of seeds.
namespace glimt {

/// Scales the number of samples: fewer with the address sanitizer, which is slow.
#ifdef __SANITIZE_ADDRESS__
inline constexpr int effort = 1;
#else
inline constexpr int effort = 8;
#endif

/// The significance level of each of `tests` independent tests, so that all together raise a false alarm with
/// probability `alpha` (Sidak).
inline double sidak(double alpha, double tests) { return -std::expm1(std::log1p(-alpha) / tests); }

/// Probability that a standard normal variable is at least as far from 0 as z.
inline double normal_tails(double z) { return std::erfc(std::abs(z) / std::sqrt(2.0)); }

/// Probability that a chi-square variable with k degrees of freedom is at least x. It is the upper regularised
/// incomplete gamma function of (k/2, x/2), computed by a series below the mean and a continued fraction above.
inline double chi_square_tail(double x, double k) {
  const double a = k / 2, y = x / 2;
  if (y <= 0) return 1;
  const double front = std::exp(a * std::log(y) - y - std::lgamma(a));
  if (y < a + 1) {
    double term = 1 / a, sum = term;
    for (double n = a + 1; term > sum * 1e-16; ++n) sum += term *= y / n;
    return 1 - front * sum;
  }
  double b = y + 1 - a, c = 1e300, d = 1 / b, h = d;
  for (int i = 1; i < 10000; ++i) {
    const double an = -i * (i - a);
    b += 2;
    d = 1 / (an * d + b);
    c = b + an / c;
    h *= d * c;
    if (std::abs(d * c - 1) < 1e-15) break;
  }
  return front * h;
}

/// Probability that Student's t with n degrees of freedom is at least as far from 0 as t. It is the regularised
/// incomplete beta function of (n/2, 1/2) at n / (n + t^2), computed by a continued fraction.
inline double student_tails(double t, double n) {
  const double x = n / (n + t * t);
  auto fraction = [](double a, double b, double z) {
    double c = 1, d = 1 / (1 - (a + b) * z / (a + 1)), h = d;
    for (int m = 1; m < 1000; ++m) {
      const double even = m * (b - m) * z / ((a + 2 * m - 1) * (a + 2 * m));
      d = 1 / (1 + even * d), c = 1 + even / c, h *= d * c;
      const double odd = -(a + m) * (a + b + m) * z / ((a + 2 * m) * (a + 2 * m + 1));
      d = 1 / (1 + odd * d), c = 1 + odd / c, h *= d * c;
      if (std::abs(d * c - 1) < 1e-15) break;
    }
    return h;
  };
  const double a = n / 2, b = 0.5;
  const double front =
      std::exp(std::lgamma(a + b) - std::lgamma(a) - std::lgamma(b) + a * std::log(x) + b * std::log1p(-x));
  return x < (a + 1) / (a + b + 2) ? front * fraction(a, b, x) / a : 1 - front * fraction(b, a, 1 - x) / b;
}

/// Mean of independent values and its standard error.
struct Estimate {
  double mean = 0;
  double error = 0;
  int values = 0;
};

inline Estimate estimate(const std::vector<double>& values) {
  const auto n = static_cast<double>(values.size());
  double mean = 0, squares = 0;
  for (const double v : values) mean += v / n;
  for (const double v : values) squares += (v - mean) * (v - mean);
  return {mean, std::sqrt(squares / (n - 1) / n), static_cast<int>(values.size())};
}

/// Probability that the estimate's mean is at least as far from the exact value.
inline double likelihood(const Estimate& e, double exact) {
  // Values that are all equal are right or wrong, up to the rounding of floats.
  if (e.error <= 1e-7 * std::abs(exact)) return std::abs(e.mean - exact) <= 2e-6 * std::abs(exact) ? 1 : 0;
  return student_tails((e.mean - exact) / e.error, e.values - 1);
}

/// Probability that two estimates of one value are at least as far from each other (Welch 1947).
inline double likelihood(const Estimate& a, const Estimate& b) {
  const double va = a.error * a.error, vb = b.error * b.error;
  if (va + vb == 0) return a.mean == b.mean ? 1 : 0;
  const double freedom = (va + vb) * (va + vb) / (va * va / (a.values - 1) + vb * vb / (b.values - 1));
  return student_tails((a.mean - b.mean) / std::sqrt(va + vb), freedom);
}

}  // namespace glimt
