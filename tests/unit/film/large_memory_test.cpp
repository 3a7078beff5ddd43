#include "film/large_memory.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>

using namespace glimt;

namespace {

constexpr std::size_t huge_page = std::size_t{1} << 21;

TEST(LargeMemory, IsZeroAlsoWhereItWasUsedBefore) {
  for (const std::size_t bytes :
       {std::size_t{1}, huge_page / 2 - 1, huge_page / 2, huge_page, huge_page + 1, 5 * huge_page}) {
    for (int time = 0; time < 3; ++time) {
      auto* memory = static_cast<char*>(allocate_zeros(bytes));
      ASSERT_TRUE(memory) << bytes;
      EXPECT_EQ(std::count(memory, memory + bytes, 0), static_cast<std::ptrdiff_t>(bytes));
      std::fill_n(memory, bytes, 'x');
      free_zeros(memory, bytes);
    }
  }
}

// Else the system can give no huge pages.
TEST(LargeMemory, BeginsWithAHugePage) {
  for (const std::size_t bytes : {huge_page / 2, huge_page, 3 * huge_page + 1}) {
    void* memory = allocate_zeros(bytes);
    EXPECT_EQ(reinterpret_cast<std::uintptr_t>(memory) % huge_page, 0u) << bytes;
    free_zeros(memory, bytes);
  }
}

TEST(LargeMemory, SaysWhereThereIsNotEnough) {
  EXPECT_THROW(ZeroedMemory<std::uint64_t>().allocate(SIZE_MAX / 8), std::bad_alloc);
  EXPECT_THROW(ZeroedMemory<std::uint64_t>().allocate(std::size_t{1} << 52), std::bad_alloc);
}

}  // namespace
