#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "viewer/state/compare.h"
#include "viewer/state/state.h"
#include "viewer/widgets/layout.h"

namespace glimt {

/// Shows the numbers of a pixel: the one under the mouse, else the marked one.
class Inspector {
 public:
  void mark(const std::optional<Pixel>& pixel) { marked_ = pixel; }
  void draw(const ViewerState& state, const Rect& area, const PicturePlace& picture) const;

 private:
  std::optional<Pixel> marked_;
};

/// Radiance, standard error, samples, and the values of B there: a label and a value for each line.
std::vector<std::array<std::string, 2>> pixel_lines(const ViewerState& state, const Pixel& pixel);

}  // namespace glimt
