#pragma once

#include <cstdint>
#include <tuple>
#include <type_traits>
#include <vector>

#include "material/list.h"

/// The lobes of all materials. Kernels dispatch over them, and the surface table has their columns.
namespace glimt {

template <class... Materials>
auto lobes_of_materials(MaterialList<Materials...>) {
  return std::tuple_cat(typename Materials::Lobes{}...);
}
using Lobes = decltype(lobes_of_materials(AllMaterials{}));

/// The lobe's place in the list.
template <class L>
inline constexpr std::size_t lobe_index = []<class... All>(std::tuple<All...>*) {
  std::size_t index = 0;
  (void)((std::is_same_v<L, All> || (++index, false)) || ...);
  return index;
}(static_cast<Lobes*>(nullptr));

/// The kinds of a class's lobes begin at kinds_per_class times the class.
inline constexpr std::int32_t kinds_per_class = 64;
constexpr std::int32_t first_kind(LobeClass lobe_class) {
  return kinds_per_class * static_cast<std::int32_t>(lobe_class);
}
/// The value of Column::kind for surfaces with the lobe.
template <class L>
inline constexpr std::int32_t lobe_kind = first_kind(L::lobe_class) + static_cast<std::int32_t>(lobe_index<L>);

/// Calls f.template operator()<L>() for every lobe.
template <class Function>
constexpr void for_each_lobe(Function f) {
  [&]<class... All>(std::tuple<All...>*) { (f.template operator()<All>(), ...); }(static_cast<Lobes*>(nullptr));
}

template <class L>
constexpr int column_count_of() {
  if constexpr (requires { L::column_count; }) return static_cast<int>(L::column_count);
  return 0;
}
/// The first of the lobe's own columns in the surface table, counted after the columns that all surfaces have.
template <class L>
constexpr int first_column() {
  int first = 0;
  bool before = true;
  for_each_lobe([&]<class Other>() {
    before = before && !std::is_same_v<L, Other>;
    if (before) first += column_count_of<Other>();
  });
  return first;
}

/// Number of own columns of all lobes.
inline constexpr int own_columns = [] {
  int sum = 0;
  for_each_lobe([&]<class L>() { sum += column_count_of<L>(); });
  return sum;
}();

/// A set of lobes, one bit each.
using LobeSet = std::uint32_t;
template <class L>
inline constexpr LobeSet lobe_bit = LobeSet{1} << lobe_index<L>;

/// All lobes of this use or an earlier one.
constexpr LobeSet lobes_up_to(LobeUse use) {
  LobeSet set = 0;
  for_each_lobe([&]<class L>() {
    if (L::use <= use) set |= lobe_bit<L>;
  });
  return set;
}
/// All lobes of the class.
constexpr LobeSet lobes_of(LobeClass lobe_class) {
  LobeSet set = 0;
  for_each_lobe([&]<class L>() {
    if (L::lobe_class == lobe_class) set |= lobe_bit<L>;
  });
  return set;
}

/// All lobes for which the flag is true.
template <class Flag>
constexpr LobeSet lobes_with(Flag flag) {
  LobeSet set = 0;
  for_each_lobe([&]<class L>() {
    if (flag.template operator()<L>()) set |= lobe_bit<L>;
  });
  return set;
}
/// The lobes that transmit light, and those over which connections pass.
inline constexpr LobeSet transmitting_lobes = lobes_with([]<class L>() {
  if constexpr (requires { L::transmits; }) return L::transmits;
  return false;
});
inline constexpr LobeSet connecting_lobes = lobes_with([]<class L>() {
  if constexpr (requires { L::connects; }) return L::connects;
  return false;
});

/// The lobe of the kind.
constexpr LobeSet lobe_of_kind(std::int32_t kind) { return LobeSet{1} << (kind % kinds_per_class); }

/// The lobe that a material chooses for its surfaces, with the values of its columns.
struct ChosenLobe {
  std::int32_t kind = 0;
  LobeSet bit = 0;
  int first_column = 0;
  std::vector<double> columns;

  template <class L, class... Values>
  void choose(Values... values) {
    static_assert(sizeof...(Values) == column_count_of<L>(), "a value for every column");
    kind = lobe_kind<L>;
    bit = lobe_bit<L>;
    first_column = glimt::first_column<L>();
    columns = {static_cast<double>(values)...};
  }
};

/// The lobe and columns that the material's parameters give.
ChosenLobe lower(const Material& material);

}  // namespace glimt
