#pragma once

#include <string>
#include <vector>

#include "viewer/state/curves.h"

/// The window's curves as files.
namespace glimt {

/// Every point of every curve, in the columns of `glimt chart --csv`.
std::string curves_csv(const std::vector<Curve>& curves);

/// The curves that are shown.
std::string curves_svg(const std::vector<Curve>& curves, Across axis, const std::string& title);

}  // namespace glimt
