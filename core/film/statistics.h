#pragma once

#include <limits>
#include <string>
#include <vector>

#include "film/film.h"
#include "film/unseen.h"

namespace glimt {

/// Error of image x against reference r, over all pixels and channels. Per pixel e = mean over channels of
/// (x - r)^2 / (r^2 + 0.01).
struct Comparison {
  double mean = 0;            ///< of x
  double mean_reference = 0;  ///< of r
  double bias = 0;            ///< mean - mean_reference
  double rmse = 0;            ///< sqrt(mean (x - r)^2)
  double relmse = 0;          ///< mean e
  double relmse999 = 0;       ///< mean e of the pixels without the largest 0.1 % (rounded up)
  double relmse_scaled = 0;   ///< relmse with scaled_dark(mean_reference) in place of 0.01
};

/// What stands for 0.01 in a measure without a scale: a power of two times every radiance changes no bit of it. A
/// picture of mean 0.54 has 0.01.
inline double scaled_dark(double mean) { return 0.034 * mean * mean; }

/// Throws std::invalid_argument where the sizes differ or a value is not finite, naming the first such pixel.
Comparison compare(const Image& x, const Image& reference);

/// Mean over pixels and channels.
double mean(const Image& image);

/// relmse of the film's mean, estimated without a reference: mean of (h0 - h1)^2 / 4 / (m^2 + 0.01), h0 and h1 the
/// halves' pictures and m the mean over the aligned 8x8 block around the pixel (the quarter is n0 n1 / (n0 + n1)^2,
/// which differs from it for odd counts). Infinite where a half has no sample.
double relmse_estimate(const Film& film);

/// The error of a film's mean, estimated without a reference; infinite where a half has no sample. A black picture has
/// no relmse_scaled either: it is infinite.
struct ErrorEstimate {
  double relmse = std::numeric_limits<double>::infinity();         ///< relmse_estimate
  double relmse_scaled = std::numeric_limits<double>::infinity();  ///< the same with scaled_dark(mean of the film)
  double low = 0;                                         ///< with `high`, what holds the true relmse_scaled in 95 %
  double high = std::numeric_limits<double>::infinity();  ///< infinite where a few pixels have all of the error
  Unseen unseen{};  ///< light that chance may not have found yet; empty where it would not show outside `low` to `high`

  /// relmse_scaled says only how large the error is at least.
  bool is_bound() const { return unseen.flux > 0; }
  /// The relmse_scaled to rely on: with what the unseen light may add.
  double at_most() const { return relmse_scaled + unseen.relmse; }
};
ErrorEstimate estimate_error(const Film& film);

/// What the estimate of relmse_scaled multiplies (h0 - h1)^2 with, for each pixel and channel: one over the likely
/// square of the radiance (core/README.md, "Without a scale") with scaled_dark() of the whole. Of a picture by the
/// means of its halves, of which the first has `share` of the samples. 0 for a black picture.
std::vector<double> relative_weights(const Image& half0, const Image& half1, double share);

/// How far to trust the film, in words: "error 0.0012 (0.0011 to 0.0013 in 95 of 100)", or "error at least 0.0012: up
/// to 40 % of the light may be missing (caustics in mirrors and glass)".
std::string trust_text(const ErrorEstimate& estimate);

}  // namespace glimt
