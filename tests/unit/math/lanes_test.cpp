#include "math/lanes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <ios>
#include <limits>
#include <random>
#include <type_traits>
#include <vector>

using namespace glimt;

// What one lane of a batch holds must be what the scalar function gives, bit for bit: it is what makes a picture the
// same at every lane width.
namespace {

using F = NativeLanes;
constexpr std::size_t width = lane_count<F>;
using Floats = std::array<float, width>;
using Ints = std::array<std::int32_t, width>;
using Uints = std::array<std::uint32_t, width>;

constexpr float inf = std::numeric_limits<float>::infinity();
constexpr float nan_value = std::numeric_limits<float>::quiet_NaN();

/// Special values, and floats of random bits, among which are NaNs and denormals.
std::vector<float> floats() {
  std::vector<float> values{0.0f,    -0.0f, 1.0f, -1.0f,  0.5f,    1.5f,     -2.5f,   0x1p-149f, -0x1p-149f, 0x1p-126f,
                            0x1p31f, -inf,  inf,  1e-45f, 3.4e38f, -3.4e38f, 0x1p24f, 16777216,  nan_value};
  std::mt19937 random(1);
  while (values.size() < 300) values.push_back(std::bit_cast<float>(static_cast<std::uint32_t>(random())));
  std::uniform_real_distribution<float> around(-4, 4);
  while (values.size() < 600) values.push_back(around(random));
  return values;
}

std::vector<std::int32_t> ints() {
  std::vector<std::int32_t> values{0, 1, -1, 2147483647, -2147483647 - 1, 16777217, 15, 31};
  std::mt19937 random(2);
  while (values.size() < 300) values.push_back(static_cast<std::int32_t>(random()));
  return values;
}

bool same(float a, float b) {
  return (std::isnan(a) && std::isnan(b)) || std::bit_cast<std::uint32_t>(a) == std::bit_cast<std::uint32_t>(b);
}
bool same(bool a, bool b) { return a == b; }
bool same(std::int32_t a, std::int32_t b) { return a == b; }
bool same(std::uint32_t a, std::uint32_t b) { return a == b; }

template <class V, class T>
std::array<T, width> lanes_of(V v, T) {
  std::array<T, width> result;
  store(v, result.data());
  return result;
}

template <class T>
using BatchOf = std::conditional_t<std::is_same_v<T, float>, F,
                                   std::conditional_t<std::is_same_v<T, std::int32_t>, Int<F>, Uint<F>>>;

/// The same function of three arguments on batches and on single values drawn from `values`; every lane has others.
template <class T, class Function>
void expect_lanes_agree(const char* name, const std::vector<T>& values, Function function) {
  std::mt19937 random(3);
  for (int trial = 0; trial < 2000; ++trial) {
    std::array<std::array<T, width>, 3> x;
    for (auto& argument : x)
      for (T& lane : argument) lane = values[random() % values.size()];
    using B = BatchOf<T>;
    const auto batch = function(load<B>(x[0].data()), load<B>(x[1].data()), load<B>(x[2].data()));
    using Single = decltype(function(T{}, T{}, T{}));
    std::array<Single, width> found;
    if constexpr (std::is_same_v<Single, bool>) {
      for (std::size_t i = 0; i < width; ++i) found[i] = (bits(batch) >> i & 1) != 0;
    } else {
      store(batch, found.data());
    }
    for (std::size_t i = 0; i < width; ++i) {
      const Single expected = function(x[0][i], x[1][i], x[2][i]);
      ASSERT_TRUE(same(found[i], expected))
          << std::hexfloat << name << " is " << found[i] << " in lane " << i << ", but " << expected << ", for a "
          << x[0][i] << ", b " << x[1][i] << ", c " << x[2][i];
    }
  }
}

#define EXPECT_LANES_AGREE(expression, values) \
  expect_lanes_agree(                          \
      #expression, values,                     \
      []([[maybe_unused]] auto a, [[maybe_unused]] auto b, [[maybe_unused]] auto c) { return expression; })

TEST(Lanes, ArithmeticAgrees) {
  const auto f = floats();
  EXPECT_LANES_AGREE(a + b, f);
  EXPECT_LANES_AGREE(a - b, f);
  EXPECT_LANES_AGREE(a * b, f);
  EXPECT_LANES_AGREE(a / b, f);
  EXPECT_LANES_AGREE(glimt::fma(a, b, c), f);
  EXPECT_LANES_AGREE(glimt::abs(a), f);
}

/// Finite positive floats of all magnitudes whose roots and reciprocals are normal numbers too.
std::vector<float> positive_floats() {
  std::mt19937 random(5);
  std::vector<float> values{1, 2, 4, 0.5f, 3, 0x1p-120f, 0x1p120f};
  while (values.size() < 20000)
    values.push_back(
        std::ldexp(1 + static_cast<float>(random() >> 9) * 0x1p-23f, static_cast<int>(random() % 240) - 120));
  return values;
}

TEST(Lanes, QuotientsAndRootsAgree) {
  EXPECT_LANES_AGREE(reciprocal(a), floats());
  EXPECT_LANES_AGREE(inverse_sqrt(a), positive_floats());
  EXPECT_LANES_AGREE(glimt::sqrt(a), positive_floats());
  EXPECT_LANES_AGREE(glimt::sqrt(a - a), positive_floats());
}

// One unit in the last place is 2^-23 of the leading digit's value, so at most 2^-23 of the result.
TEST(Lanes, QuotientsAndRootsAreWithinOneUnitInTheLastPlace) {
  const auto expect_close = [](float found, double exact, float of) {
    EXPECT_NEAR(found / exact, 1, 0x1p-23) << std::hexfloat << of;
  };
  for (const float a : positive_floats()) {
    expect_close(reciprocal(a), 1.0 / a, a);
    expect_close(reciprocal(-a), -1.0 / a, -a);
    expect_close(inverse_sqrt(a), 1 / std::sqrt(static_cast<double>(a)), a);
    expect_close(glimt::sqrt(a), std::sqrt(static_cast<double>(a)), a);
  }
  EXPECT_EQ(reciprocal(0.0f), std::numeric_limits<float>::infinity());
  EXPECT_EQ(reciprocal(-0.0f), -std::numeric_limits<float>::infinity());
  EXPECT_EQ(reciprocal(std::numeric_limits<float>::infinity()), 0.0f);
  EXPECT_EQ(glimt::sqrt(0.0f), 0.0f);
}

// min and max are not symmetric in NaN and in the sign of zero: the second argument wins, at every width.
TEST(Lanes, MinimumAndMaximumAgreeForNanAndSignedZeroToo) {
  const auto f = floats();
  EXPECT_LANES_AGREE(glimt::min(a, b), f);
  EXPECT_LANES_AGREE(glimt::max(a, b), f);
  EXPECT_EQ(max(nan_value, 2.0f), 2.0f);
  EXPECT_EQ(min(nan_value, 2.0f), 2.0f);
}

TEST(Lanes, ComparisonsAndMasksAgree) {
  const auto f = floats();
  const auto n = ints();
  EXPECT_LANES_AGREE(a < b, f);
  EXPECT_LANES_AGREE(a <= b, f);
  EXPECT_LANES_AGREE(a > b, f);
  EXPECT_LANES_AGREE(a >= b, f);
  EXPECT_LANES_AGREE(Mask<decltype(a)>(((a < b) & (b < c)) | !(a <= c)), f);
  EXPECT_LANES_AGREE(equal(a, b), n);
  EXPECT_LANES_AGREE(less(a, b), n);
  EXPECT_LANES_AGREE(equal(a, a), n);
}

TEST(Lanes, SelectionsAgree) {
  const auto f = floats();
  const auto n = ints();
  std::vector<std::uint32_t> u;
  for (const std::int32_t i : n) u.push_back(static_cast<std::uint32_t>(i));
  EXPECT_LANES_AGREE(select(a < b, b, c), f);
  EXPECT_LANES_AGREE(select(less(a, b), b, c), n);
  EXPECT_LANES_AGREE(select(less(as_int(a), as_int(b)), b, c), u);
}

TEST(Lanes, ConversionsAgree) {
  const auto n = ints();
  std::vector<float> f = floats(), in_range = f;
  std::erase_if(in_range, [](float x) { return !(std::abs(x) < 0x1p31f); });
  EXPECT_LANES_AGREE(to_float(a), n);
  EXPECT_LANES_AGREE(to_int(a), in_range);
  std::erase_if(f, [](float x) { return std::isnan(x); });  // moving a NaN may change its bits
  EXPECT_LANES_AGREE(as_int(a), f);
  EXPECT_EQ(to_int(-1.75f), -1) << "towards zero";
  EXPECT_EQ(to_int(1.75f), 1) << "towards zero";
}

TEST(Lanes, UnsignedArithmeticWrapsAlike) {
  std::vector<std::uint32_t> u;
  for (const std::int32_t i : ints()) u.push_back(static_cast<std::uint32_t>(i));
  EXPECT_LANES_AGREE(a + b, u);
  EXPECT_LANES_AGREE(a * b, u);
  EXPECT_LANES_AGREE(a ^ b, u);
  EXPECT_LANES_AGREE(a >> 15, u);
}

std::vector<std::uint32_t> masks() {
  std::vector<std::uint32_t> result;
  for (std::uint32_t m = 0; m < (1u << width); ++m) result.push_back(m);
  return result;
}

Mask<F> mask_of(std::uint32_t m) {
  Floats lane;
  for (std::size_t i = 0; i < width; ++i) lane[i] = (m >> i & 1) != 0 ? 1.0f : 0.0f;
  return load<F>(lane.data()) > F(0.5f);
}

TEST(Lanes, BitsAndAnyOfEveryMask) {
  for (const std::uint32_t m : masks()) {
    ASSERT_EQ(bits(mask_of(m)), m);
    ASSERT_EQ(any(mask_of(m)), m != 0);
    ASSERT_EQ(bits(mask_cast<float>(mask_cast<std::int32_t>(mask_of(m)))), m);
  }
  EXPECT_EQ(bits(true), 1u);
  EXPECT_EQ(bits(false), 0u);
}

TEST(Lanes, ExpandGivesElementsToTheLanesOfTheMaskInOrder) {
  Floats from, old;
  Ints from_int, old_int;
  Uints from_uint, old_uint;
  for (std::size_t i = 0; i < width; ++i) {
    const auto k = static_cast<std::int32_t>(i);
    from[i] = static_cast<float>(100 + k), old[i] = static_cast<float>(k);
    from_int[i] = -100 - k, old_int[i] = k;
    from_uint[i] = 0x80000000u + static_cast<std::uint32_t>(k), old_uint[i] = static_cast<std::uint32_t>(k);
  }
  for (const std::uint32_t m : masks()) {
    const Mask<F> mask = mask_of(m);
    const Floats f = lanes_of(expand<F, F>(load<F>(old.data()), mask, from.data()), 0.0f);
    const Ints n = lanes_of(expand<Int<F>, F>(load<Int<F>>(old_int.data()), mask, from_int.data()), std::int32_t{});
    const Uints u =
        lanes_of(expand<Uint<F>, F>(load<Uint<F>>(old_uint.data()), mask, from_uint.data()), std::uint32_t{});
    std::size_t next = 0;
    for (std::size_t i = 0; i < width; ++i) {
      const bool taken = (m >> i & 1) != 0;
      ASSERT_EQ(f[i], taken ? from[next] : old[i]) << "mask " << m << ", lane " << i;
      ASSERT_EQ(n[i], taken ? from_int[next] : old_int[i]) << "mask " << m << ", lane " << i;
      ASSERT_EQ(u[i], taken ? from_uint[next] : old_uint[i]) << "mask " << m << ", lane " << i;
      next += taken ? 1 : 0;
    }
  }
  EXPECT_EQ((expand<float, float>(1.0f, true, from.data())), 100.0f);
  EXPECT_EQ((expand<float, float>(1.0f, false, from.data())), 1.0f);
}

TEST(Lanes, LookUpsTakeTheEntryOfEachLane) {
  alignas(64) std::array<float, 256> table;
  for (std::size_t i = 0; i < table.size(); ++i)
    table[i] = std::bit_cast<float>(0x3f800000u + 12345u * static_cast<std::uint32_t>(i));
  table[3] = -0.0f, table[9] = inf, table[14] = 0x1p-149f;
  std::mt19937 random(4);
  for (int trial = 0; trial < 5000; ++trial) {
    Ints wide, small;
    for (std::size_t i = 0; i < width; ++i) {
      wide[i] = static_cast<std::int32_t>(random() % table.size());
      small[i] =
          trial == 0 ? static_cast<std::int32_t>(i % small_table) : static_cast<std::int32_t>(random() % small_table);
    }
    const Floats w = lanes_of(lookup(table.data(), load<Int<F>>(wide.data())), 0.0f);
    const Floats s = lanes_of(lookup_small(table.data(), load<Int<F>>(small.data())), 0.0f);
    for (std::size_t i = 0; i < width; ++i) {
      ASSERT_TRUE(same(w[i], table[static_cast<std::size_t>(wide[i])])) << wide[i];
      ASSERT_TRUE(same(s[i], table[static_cast<std::size_t>(small[i])])) << small[i];
    }
  }
}

}  // namespace
