#pragma once

#include <gtest/gtest.h>

#include <cctype>
#include <string>

#include "pictures.h"
#include "scene/scene.h"

/// Compares pictures of one scene by several estimators.
namespace glimt {

/// What GoogleTest prints for a case.
inline void PrintTo(const Scene& scene, std::ostream* out) { *out << scene.name; }

/// What GoogleTest calls a case: letters and digits of the scene's name.
inline std::string case_name(const Scene& scene) {
  std::string name;
  for (const char c : scene.name)
    if (std::isalnum(static_cast<unsigned char>(c)) != 0) name += c;
  return name;
}

struct Named {
  std::string name;
  Series series;
};

/// Number of comparisons that expect_same() makes of two series.
inline double comparisons(const Series& series) { return static_cast<double>(series.size() + 1); }

/// Expects equal overall means and equal means of blocks in two series. Each comparison has significance `level`.
inline void expect_same(const Named& a, const Named& b, double level, const std::string& scene) {
  const auto check = [&](const Estimate& x, const Estimate& y, const std::string& where) {
    EXPECT_GT(likelihood(x, y), level) << scene << ", " << where << ": " << a.name << " " << x.mean << " +- " << x.error
                                       << ", " << b.name << " " << y.mean << " +- " << y.error;
  };
  check(a.series.overall(), b.series.overall(), "all pixels");
  for (std::size_t i = 0; i < a.series.size(); ++i)
    check(a.series.block(i), b.series.block(i),
          "block " + std::to_string(i / 3) + ", channel " + std::to_string(i % 3));
}

}  // namespace glimt
