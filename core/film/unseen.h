#pragma once

#include <string>

#include "film/film.h"

/// How much light a picture may still lack, of the light that only BSDF sampling finds. Derived in core/README.md,
/// "What has not been found".
namespace glimt {

/// Upper bounds of what is missing, which hold in 95 of 100 pictures like this one.
struct Unseen {
  double flux = 0;    ///< share of the picture's light that may be missing, 0 to 1
  double relmse = 0;  ///< what the missing light may add to relmse_scaled, 0 to 1
  std::string light;  ///< names of that light; empty where nothing is missing
};

/// `picture_mean` is the film's mean over pixels and channels.
Unseen unseen_light(const Film& film, double picture_mean);

/// Names of the light that only BSDF sampling finds; empty where there is none.
std::string light_by_chance(const std::vector<Emitter>& emitters);

/// How many more than `found` events may have been expected: a Poisson distribution with mean found + the result gives
/// `found` or fewer events once in 20 times. 3.0 for none found.
double missing_events(double found);

}  // namespace glimt
