#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <vector>

#include "film/film.h"

/// A picture after an edit goes on from the one before it: derived in core/README.md, "An edit is a difference".
namespace glimt {

/// Means of the halves, radiance.
using HalfImages = std::array<Image, 2>;

/// What a film held after its first 2, 4, 8, ... samples, so that the same samples of two scenes can be compared.
class FirstSamples {
 public:
  /// How many samples the next entry is of; 0 where there will be none.
  int next(const Film& film) const;
  /// Takes an entry where the film has as many samples as next() wanted.
  void look_at(const Film& film);
  /// Entries by their number of samples.
  const std::map<int, HalfImages>& entries() const { return entries_; }
  std::size_t bytes() const;

 private:
  std::map<int, HalfImages> entries_;
};

/// What is added to the sums of a film, by half; units of the film, and negative ones too.
using Correction = std::array<std::vector<std::int64_t>, 2>;

/// Turns a film of the edited scene that begins with the samples of `now` into the picture that goes on from `before`.
/// `now` and `old` are the same first `samples` samples of the edited scene and of the one before. `scale`: of the film
/// to be corrected.
Correction continue_from(const Film& before, const HalfImages& old, const HalfImages& now, int samples, double scale);

/// The corrected film, for looking at: its sums may be negative.
Film corrected(const Film& film, const Correction& correction);

}  // namespace glimt
