#pragma once

#include <cmath>
#include <numbers>
#include <sstream>
#include <string>

namespace glimt {

/// The bumpy sphere of tests/data/meshes.toml as OBJ: 50 rows of 100 quads on r = 1 + 0.22 sin(theta) sin(7 theta)
/// cos(5 phi), coordinates to five decimals.
inline std::string blob_obj() {
  constexpr int rows = 50, columns = 100;
  const auto rounded = [](double x) { return std::round(x * 1e5) / 1e5 + 0.0; };
  std::ostringstream text;
  text << "# bumpy sphere\no blob\n";
  for (int i = 0; i <= rows; ++i)
    for (int j = 0; j < columns; ++j) {
      const double theta = std::numbers::pi * i / rows, phi = 2 * std::numbers::pi * j / columns;
      const double r = 1 + 0.22 * std::sin(theta) * std::sin(7 * theta) * std::cos(5 * phi);
      text << "v " << rounded(r * std::sin(theta) * std::cos(phi)) << ' ' << rounded(r * std::cos(theta)) << ' '
           << rounded(r * std::sin(theta) * std::sin(phi)) << '\n';
    }
  for (int i = 0; i < rows; ++i)
    for (int j = 0; j < columns; ++j) {
      const int a = 1 + i * columns + j, b = 1 + i * columns + (j + 1) % columns, c = a + columns, d = b + columns;
      if (i == 0)
        text << "f " << a << ' ' << d << ' ' << c << '\n';
      else if (i == rows - 1)
        text << "f " << a << ' ' << b << ' ' << d << '\n';
      else
        text << "f " << a << ' ' << b << ' ' << d << "\nf " << a << ' ' << d << ' ' << c << '\n';
    }
  return text.str();
}

}  // namespace glimt
