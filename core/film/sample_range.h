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

/// Ranges in order, of which no two overlap or touch.
using SampleRanges = std::vector<SampleRange>;

/// Number of samples in all ranges.
int count_of(const SampleRanges& ranges);
/// Number of those in half h: samples 2k + h.
int half_count_of(const SampleRanges& ranges, int h);

/// Adds a range. Throws std::invalid_argument where it overlaps one that is there.
void add_range(SampleRanges& ranges, SampleRange added);

/// The first range of samples that both have.
std::optional<SampleRange> overlap_of(const SampleRanges& a, const SampleRanges& b);

/// The first range of missing samples from `from` on. It goes on to the largest int if no range follows.
SampleRange first_gap(const SampleRanges& ranges, int from);

/// FIRST:COUNT of each range, as --samples takes one: "0:64,128:64".
std::string ranges_text(const SampleRanges& ranges);

/// "sample 7", "samples 0 to 63".
std::string in_words(SampleRange range);

}  // namespace glimt
