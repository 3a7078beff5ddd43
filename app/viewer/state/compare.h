#pragma once

#include <memory>
#include <string>

#include "render/session.h"

/// The picture A that is being rendered beside another, B.
namespace glimt {

enum class CompareView {
  off,
  split,       ///< A left of a line, B right of it
  held,        ///< B alone
  difference,  ///< |A - B|, radiance
  relative,    ///< the root of e = (A - B)^2 / (B^2 + 0.01), mean of the channels, on a colour scale
};

/// A picture to compare with.
struct Held {
  std::shared_ptr<const Frame> frame;  ///< null where nothing is held
  std::string label;
  std::uint64_t curve = 0;  ///< of the chart, whose label says what it is; 0: none
};

struct Compare {
  Held held;
  CompareView view = CompareView::off;
  bool with_reference = false;  ///< B is the reference and not what is held
  float line = 0.5F;            ///< of the split: share of the picture's width
};

bool same_size(const Image& a, const Image& b);

/// Two pictures of one size.
Image difference(const Image& a, const Image& b);
Image relative_error(const Image& a, const Image& b);
/// Of one pixel, three floats each.
float relative_error(const float* a, const float* b);

struct Pixel {
  int x = 0, y = 0;
};

/// Where the relative error is largest.
Pixel worst_pixel(const Image& a, const Image& b);

}  // namespace glimt
