#pragma once

#include <string>

#include "film/film.h"

/// What a picture may lack of the light that only chance can find. Derived in core/README.md, "What has not been
/// found".
namespace glimt {

/// In 95 of 100 pictures like this one no more is missing than it says.
struct Unseen {
  double flux = 0;    ///< share of the picture's light that may be missing, 0 to 1
  double relmse = 0;  ///< relmse_scaled that what is missing may add, 0 to 1
  std::string light;  ///< what light it is, in words; empty where nothing is missing
};

/// `picture_mean`: of the film, over pixels and channels.
Unseen unseen_light(const Film& film, double picture_mean);

/// What light is left to chance, in words; empty where none is.
std::string light_by_chance(const std::vector<Emitter>& emitters);

/// By how much more than `found` events might have been expected, as a Poisson distribution with that mean gives
/// `found` or fewer events once in 20 times: 3.0 for none.
double missing_events(double found);

}  // namespace glimt
