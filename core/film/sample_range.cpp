#include "film/sample_range.h"

#include <algorithm>
#include <limits>
#include <stdexcept>

namespace glimt {

int count_of(const SampleRanges& ranges) {
  int sum = 0;
  for (const SampleRange& range : ranges) sum += range.count;
  return sum;
}

int half_count_of(const SampleRanges& ranges, int h) {
  const auto below = [h](int end) { return (end + 1 - h) / 2; };
  int sum = 0;
  for (const SampleRange& range : ranges) sum += below(range.end()) - below(range.first);
  return sum;
}

void add_range(SampleRanges& ranges, SampleRange added) {
  if (added.count == 0) return;
  auto next = std::ranges::find_if(ranges, [&](const SampleRange& range) { return range.end() >= added.first; });
  if (next != ranges.end() && next->end() == added.first) {
    added = {next->first, next->count + added.count};
    next = ranges.erase(next);
  }
  if (next != ranges.end() && next->first == added.end()) {
    added.count += next->count;
    next = ranges.erase(next);
  }
  if (next != ranges.end() && next->first < added.end()) throw std::invalid_argument("samples are there twice");
  ranges.insert(next, added);
}

std::optional<SampleRange> overlap_of(const SampleRanges& a, const SampleRanges& b) {
  for (const SampleRange& one : a)
    for (const SampleRange& other : b) {
      const int first = std::max(one.first, other.first), end = std::min(one.end(), other.end());
      if (first < end) return SampleRange{first, end - first};
    }
  return std::nullopt;
}

SampleRange first_gap(const SampleRanges& ranges, int from) {
  for (const SampleRange& range : ranges) {
    if (from < range.first) return {from, range.first - from};
    from = std::max(from, range.end());
  }
  return {from, std::numeric_limits<int>::max() - from};
}

std::string ranges_text(const SampleRanges& ranges) {
  std::string text;
  for (const SampleRange& range : ranges)
    text += (text.empty() ? "" : ",") + std::to_string(range.first) + ":" + std::to_string(range.count);
  return text;
}

std::string in_words(SampleRange range) {
  if (range.count == 1) return "sample " + std::to_string(range.first);
  return "samples " + std::to_string(range.first) + " to " + std::to_string(range.end() - 1);
}

}  // namespace glimt
