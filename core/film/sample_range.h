#pragma once

#include <optional>
#include <string>
#include <vector>

namespace glimt {

/// Samples first, first + 1, ..., end() - 1 of every pixel.
struct SampleRange {
  int first = 0;
  int count = 0;

  int end() const { return first + count; }
  bool operator==(const SampleRange&) const = default;
};

/// In order; no two overlap or touch.
using SampleRanges = std::vector<SampleRange>;

/// Samples in all of the ranges.
int count_of(const SampleRanges& ranges);
/// Those of half h: samples 2k + h.
int half_count_of(const SampleRanges& ranges, int h);

/// Throws std::invalid_argument where they overlap.
void add_range(SampleRanges& ranges, SampleRange added);

/// The first samples that both have.
std::optional<SampleRange> overlap_of(const SampleRanges& a, const SampleRanges& b);

/// The first samples from `from` on that are missing; they go on to the largest int where no range follows.
SampleRange first_gap(const SampleRanges& ranges, int from);

/// FIRST:COUNT of each, as --samples takes it: "0:64,128:64".
std::string ranges_text(const SampleRanges& ranges);

/// "sample 7", "samples 0 to 63".
std::string in_words(SampleRange range);

}  // namespace glimt
