#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <thread>

#include "film/checkpoint.h"

/// What tests of renders that last share.

inline void expect_same_film(const glimt::Film& a, const glimt::Film& b) {
  EXPECT_EQ(a.ranges(), b.ranges());
  EXPECT_EQ(a.scale(), b.scale());
  for (const int h : {0, 1}) EXPECT_TRUE(std::ranges::equal(a.sums(h), b.sums(h))) << "half " << h;
  EXPECT_TRUE(std::ranges::equal(a.by_chance(), b.by_chance()));
}

inline glimt::Film film_in(const std::filesystem::path& file) { return glimt::read_checkpoint(file).film; }

/// True once `happened()`, false where it takes more than a minute.
template <class F>
bool wait_until(F happened) {
  const auto end = std::chrono::steady_clock::now() + std::chrono::minutes(1);
  while (!happened()) {
    if (std::chrono::steady_clock::now() > end) return false;
    std::this_thread::sleep_for(std::chrono::microseconds(200));
  }
  return true;
}
