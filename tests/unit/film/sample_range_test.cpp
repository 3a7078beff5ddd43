#include "film/sample_range.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <set>

using namespace glimt;

namespace {

std::set<int> numbers(const SampleRanges& ranges) {
  std::set<int> all;
  for (const SampleRange& range : ranges)
    for (int n = range.first; n < range.end(); ++n) all.insert(n);
  return all;
}

// Against a set of numbers: the ranges are its runs, whatever the order in which they come.
TEST(SampleRange, AreTheRunsOfTheSamplesThereAre) {
  std::mt19937 random(1);
  const auto number = [&](int n) { return std::uniform_int_distribution<int>(0, n)(random); };
  for (int round = 0; round < 500; ++round) {
    SampleRanges ranges;
    std::set<int> known;
    for (int i = 0; i < 8; ++i) {
      const SampleRange added{number(40), number(6)};
      const std::set<int> its = numbers({added});
      const bool twice = std::ranges::any_of(its, [&](int n) { return known.contains(n); });
      EXPECT_EQ(overlap_of(ranges, {added}).has_value(), twice);
      if (twice) {
        const SampleRanges before = ranges;
        EXPECT_THROW(add_range(ranges, added), std::invalid_argument);
        ranges = before;
      } else {
        add_range(ranges, added);
        known.insert(its.begin(), its.end());
      }
    }
    ASSERT_EQ(numbers(ranges), known) << ranges_text(ranges);
    for (std::size_t i = 1; i < ranges.size(); ++i) ASSERT_GT(ranges[i].first, ranges[i - 1].end());
    EXPECT_EQ(count_of(ranges), static_cast<int>(known.size()));
    for (const int h : {0, 1})
      EXPECT_EQ(half_count_of(ranges, h), std::ranges::count_if(known, [h](int n) { return n % 2 == h; }));
    const int from = number(45);
    const SampleRange gap = first_gap(ranges, from);
    for (int n = from; n < gap.first; ++n) EXPECT_TRUE(known.contains(n));
    EXPECT_FALSE(known.contains(gap.first));
    if (!known.empty() && gap.end() <= *known.rbegin()) {
      EXPECT_TRUE(known.contains(gap.end()));
      for (int n = gap.first; n < gap.end(); ++n) EXPECT_FALSE(known.contains(n));
    }
  }
}

TEST(SampleRange, OverlapIsTheFirstThatBothHave) {
  EXPECT_EQ(overlap_of({{0, 10}, {20, 10}}, {{12, 3}, {25, 30}}), (SampleRange{25, 5}));
  EXPECT_EQ(overlap_of({{0, 10}}, {{10, 5}}), std::nullopt);
}

TEST(SampleRange, SpeakInTextAndWords) {
  EXPECT_EQ(ranges_text({{0, 64}, {128, 1}}), "0:64,128:1");
  EXPECT_EQ(in_words({7, 1}), "sample 7");
  EXPECT_EQ(in_words({0, 64}), "samples 0 to 63");
}

}  // namespace
