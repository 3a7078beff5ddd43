#pragma once

#include <algorithm>
#include <array>
#include <bit>

#include "math/twice.h"

/// Steps of a rank-1 lattice: point i of a dimension is frac(shift + i step) with a random shift (Cranley and
/// Patterson, "Randomization of number theoretic methods for multiple integration", 1976). Any number of samples may be
/// taken. Every run of them fills each dimension evenly, and also the pairs that matter most. A number costs one
/// product and one sum more than an independent one.
namespace glimt {

/// Steps in units of 2^-32, by dimension of a hit, then by place on the path: 0 for the camera, 1 to 15 for the hits.
/// Found by tests/tools/lattice_search.cpp.
alignas(64) inline constexpr std::array<std::array<std::uint32_t, small_table>, 6> lattice_steps{{
    {0xa0ff6747u, 0x3a7859d3u, 0x8815a9fbu, 0x30f655c7u, 0xbb77e9d5u, 0x84418173u, 0xd5af11c9u, 0x38b09aebu,
     0x11648673u, 0x66f2e3adu, 0x5113ab5bu, 0x6f751d79u, 0xb2a103b9u, 0x24f2299bu, 0x32d91c07u, 0x9fc8b4b7u},
    {0x6eff1c63u, 0x4a3a0c51u, 0xae002563u, 0x14c4f737u, 0xd972d36bu, 0xb0d8a873u, 0x8993c30bu, 0x0c7fa13bu,
     0xac78ebf7u, 0x16ef1fb3u, 0xdfc8656fu, 0xf6d1c3e3u, 0x13e855d1u, 0x3e1a98e5u, 0x8a46c621u, 0x0753c0cdu},
    {0x00000000u, 0xe6000b89u, 0xdc89da49u, 0xa80e65bdu, 0x5cc1c9c3u, 0x18207851u, 0x6c716659u, 0x74a810afu,
     0x72715c6fu, 0xf198b0a7u, 0x9d5cca61u, 0x1dc5ad87u, 0x5d7b4fefu, 0xb3d3356fu, 0x47276529u, 0x8711278du},
    {0x00000000u, 0x9f0a26d9u, 0xa5f0cf59u, 0x96d3776du, 0x20df848du, 0xc8ea8983u, 0xb82e3c5bu, 0x6307af6bu,
     0x1f71b3dbu, 0x3bd22861u, 0xb9b80001u, 0x6b1313a1u, 0x8d1d70cbu, 0x9c0e6b6fu, 0x4281f01fu, 0x25d350a5u},
    {0x00000000u, 0xd3a6b8b9u, 0x64c8c3bfu, 0x1c00dad5u, 0x35166441u, 0x686e6e1du, 0x59ce3dfdu, 0xb4d471a5u,
     0x3d516e1bu, 0x48c15267u, 0x36b73ee5u, 0x436c38f7u, 0x31c5692du, 0xf5176571u, 0x5b4e38d3u, 0x39b3ab69u},
    {0x00000000u, 0x70e1af49u, 0x40fb56b7u, 0x7a005c83u, 0xf09c8f5fu, 0xc0e0ae0fu, 0x21d5361fu, 0xd00f743bu,
     0xd7d0c10du, 0x7d0cedd5u, 0x56959877u, 0x2d8c95a5u, 0x822ed8c3u, 0x6b536113u, 0xe5594a85u, 0xd4f343cdu},
}};

/// Where on the path a random number is used: 0 at the camera, then the number of the hit.
template <class F>
struct LatticePlace {
  Int<F> hit;

  static LatticePlace of(const Int<F>& hit) { return {hit}; }

  static constexpr int last = small_table - 1;  ///< hits from here on are rare and share a lattice

  Uint<F> step(std::uint32_t dimension) const {
    // The steps are read as floats, but only their bits are used.
    const auto* row = reinterpret_cast<const float*>(lattice_steps[dimension].data());
    return as_uint(as_int(lookup_small(row, select(less(hit, Int<F>(last)), hit, Int<F>(last)))));
  }
  /// Added to the key of sample `index`. Deep hits share one lattice, so their numbers would be correlated. This gives
  /// each of their samples its own shift, which makes the numbers independent.
  Uint<F> scatter(const Uint<F>& index) const {
    return select(less(hit, Int<F>(last)), Uint<F>(0u), Uint<F>(index * Uint<F>(0x85ebca77u)));
  }
};

}  // namespace glimt
