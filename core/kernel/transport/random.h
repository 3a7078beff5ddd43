#pragma once

#include "math/lattice.h"
#include "math/sampler.h"
#include "scene/settings.h"

/// Random numbers by the setting `sampler`. `dimension` counts from the key's; `place` is what tells it from the others
/// of the same path in a lattice; a hit that asks for several `pairs` or numbers of a dimension has them from one
/// sequence.
namespace glimt {

/// True where the samples of a pixel share sequences.
inline bool has_sequences(Sampler sampler) {
  return sampler == Sampler::stratified || sampler == Sampler::sobol || sampler == Sampler::lattice;
}

template <class F>
PathKey<F> first_key(Sampler sampler, std::uint32_t seed, Uint<F> pixel, Uint<F> sample) {
  return has_sequences(sampler) ? sequence_key<F>(seed, pixel, sample) : path_key<F>(seed, pixel, sample);
}

template <class F>
F lattice_number(const PathKey<F>& key, const LatticePlace<F>& place, std::uint32_t dimension, const Uint<F>& index) {
  const PathKey<F> own{key.a + place.scatter(index), key.b, key.index};
  return unit_float<F>(Uint<F>(random_bits<F>(own, dimension) + index * place.step(dimension)));
}

/// Number `k` of `count` pairs, which take the dimension and the next.
template <class F>
Point2<F> random_pair(Sampler sampler, const PathKey<F>& key, const LatticePlace<F>& place, std::uint32_t dimension,
                      int count = 1, int k = 0) {
  using U = Uint<F>;
  const auto n = static_cast<std::uint32_t>(count), number = static_cast<std::uint32_t>(k);
  const U index = count == 1 ? key.index : U(key.index * U(n) + U(number));
  if (sampler == Sampler::lattice)
    return {lattice_number(key, place, dimension, index), lattice_number(key, place, dimension + 1, index)};
  if (sampler == Sampler::sobol) return sobol_pair<F>(index, random_bits<F>(key, dimension));
  if (sampler == Sampler::stratified) return stratified_pair<F>(index, random_bits<F>(key, dimension));
  const std::uint32_t own = dimension + number * shadow_dimensions;
  return {uniform<F>(key, own), uniform<F>(key, own + 1)};
}

/// The same for single numbers.
template <class F>
F random_number(Sampler sampler, const PathKey<F>& key, const LatticePlace<F>& place, std::uint32_t dimension,
                int count = 1, int k = 0) {
  using U = Uint<F>;
  if (sampler == Sampler::lattice) {
    const auto n = static_cast<std::uint32_t>(count), number = static_cast<std::uint32_t>(k);
    return lattice_number(key, place, dimension, count == 1 ? key.index : U(key.index * U(n) + U(number)));
  }
  return random_pair<F>(sampler, key, place, dimension, count, k).u;
}

}  // namespace glimt
