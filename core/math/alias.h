#pragma once

#include "math/lanes.h"

/// Choices with given probabilities, by the alias method (Walker 1977; Vose 1991).
namespace glimt {

/// table[index]; `few`: the table is small enough for lookup_small.
template <class F, bool few>
F lookup_in(const float* table, const Int<F>& index) {
  if constexpr (few) return lookup_small(table, index);
  return lookup(table, index);
}

/// Chooses one of `count` rows. u picks an entry; what is left of u keeps it if below its threshold, and otherwise
/// takes its alias.
template <class F, bool few = false>
Int<F> choose_row(const float* alias_threshold, const float* alias_other, int count, F u) {
  const F place = u * F(static_cast<float>(count));
  const F last(static_cast<float>(count - 1));
  const Int<F> entry = to_int(min(place, last));
  const F rest = place - to_float(entry);
  const Mask<F> keep = rest < lookup_in<F, few>(alias_threshold, entry);
  return select(keep, entry, as_int(lookup_in<F, few>(alias_other, entry)));
}

}  // namespace glimt
