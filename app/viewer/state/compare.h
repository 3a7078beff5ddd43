#pragma once

#include <memory>
#include <string>

#include "render/session.h"

/// Compares picture A, which is being rendered, with another picture, B.
namespace glimt {

enum class CompareView {
  off,
  split,       ///< A left of a line, B right of it
  held,        ///< B alone
  difference,  ///< |A - B|, radiance
  relative,    ///< root of the mean over channels of (A - B)^2 / (B^2 + 0.01), on a colour scale
};

/// A picture to compare with.
struct Held {
  std::shared_ptr<const Frame> frame;  ///< null where nothing is held
  std::string label;
  std::uint64_t curve = 0;  ///< the chart's curve whose label names the picture; 0: none
};

struct Compare {
  Held held;
  CompareView view = CompareView::off;
  bool with_reference = false;  ///< B is the reference, not the held picture
  float line = 0.5F;            ///< place of the split, as a share of the picture's width
};

bool same_size(const Image& a, const Image& b);

/// Pictures of how A and B differ. Both have one size.
Image difference(const Image& a, const Image& b);
Image relative_error(const Image& a, const Image& b);
/// The relative error of one pixel; a and b are three floats each.
float relative_error(const float* a, const float* b);

struct Pixel {
  int x = 0, y = 0;
};

/// Where the relative error is largest.
Pixel worst_pixel(const Image& a, const Image& b);

}  // namespace glimt
