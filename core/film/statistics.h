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
  double relmse999 = 0;       ///< mean e without the 0.1 % of pixels (rounded up) where it is largest
  double relmse_scaled = 0;   ///< relmse with scaled_dark(mean_reference) in place of 0.01
};

/// The term that replaces 0.01 in a measure independent of scale: multiplying every radiance by a power of two does not
/// change one bit of the measure. A picture of mean 0.54 has 0.01.
inline double scaled_dark(double mean) { return 0.034 * mean * mean; }

/// Compares x with a reference. Throws std::invalid_argument where the sizes differ, or where a value is not finite,
/// naming the first such pixel.
Comparison compare(const Image& x, const Image& reference);

/// Mean over pixels and channels.
double mean(const Image& image);

/// relmse of the film's mean, estimated without a reference: the mean of (h0 - h1)^2 / 4 / (m^2 + 0.01). h0 and h1 are
/// the pictures of the halves, m is the mean over the aligned 8x8 block that holds the pixel. For odd counts n0 + n1 of
/// samples, n0 n1 / (n0 + n1)^2 replaces 1/4. Infinite where a half has no sample.
double relmse_estimate(const Film& film);

/// The error of a film's mean, estimated without a reference. Infinite where a half has no sample. For a black picture
/// relmse_scaled is infinite too.
struct ErrorEstimate {
  double relmse = std::numeric_limits<double>::infinity();         ///< relmse_estimate
  double relmse_scaled = std::numeric_limits<double>::infinity();  ///< the same with scaled_dark(mean of the film)
  double low = 0;  ///< low..high holds the true relmse_scaled in 95 of 100 pictures
  double high = std::numeric_limits<double>::infinity();  ///< infinite where a few pixels have all of the error
  Unseen unseen{};  ///< light that no path may have found yet; empty where it would not show outside low..high

  /// Whether relmse_scaled is only a lower bound of the error.
  bool is_bound() const { return unseen.flux > 0; }
  /// The relmse_scaled to rely on, which includes what unseen light may add.
  double at_most() const { return relmse_scaled + unseen.relmse; }
};
ErrorEstimate estimate_error(const Film& film);

/// The factor of (h0 - h1)^2 in the estimate of relmse_scaled, for each pixel and channel: 1 / (likely square of the
/// radiance + scaled_dark() of the picture's mean); see core/README.md, "Without a scale". The picture is given by the
/// means of its halves; the first has `share` of the samples. 0 for a black picture.
std::vector<double> relative_weights(const Image& half0, const Image& half1, double share);

/// The error and how far to trust it, in words: "error 0.0012 (0.0011 to 0.0013 in 95 of 100)", or "error at least
/// 0.0012: up to 40 % of the light may be missing (caustics in mirrors and glass)".
std::string trust_text(const ErrorEstimate& estimate);

}  // namespace glimt
