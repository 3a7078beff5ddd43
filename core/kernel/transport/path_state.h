#pragma once

#include "kernel/caustics/found_chain.h"
#include "math/sampler.h"

/// The state of a path between two surfaces: what every path has, and one struct for each technique.
namespace glimt {

/// Where the radiance of a path belongs in PathSums.
template <class F>
struct PathPlace {
  static constexpr std::int32_t no_path = -1;

  Int<F> at;  ///< a place, or no_path for a lane without work

  Mask<F> is_idle() const { return less(at, Int<F>(0)); }
  Mask<F> is_busy() const { return less(Int<F>(no_path), at); }
  /// Of `places` paths: beyond its own place the path gathers its tail.
  Mask<F> in_tail(int places) const { return less(Int<F>(places - 1), at); }
};

/// What counts of the radiance of a lamp that the path meets next by chance.
template <class F>
struct LampShares {
  F next;      ///< of a lamp that is hit next, before MIS
  F specular;  ///< the same once the path has left a mirror or glass; below 0 where only lamps count that are met after
               ///< a matt or glossy surface
  F pdf_w;     ///< with which the last surface chose the direction, where light sampling shares the lamp; else 0
};

/// A chain over a sphere that the path may have found.
template <class F>
struct ChainState {
  FoundChain<F> found;
  Mask<F> connects;  ///< matt surfaces are connected to lamps over spheres: the first surface was specular
};

/// The first matt surface of a path, for sharing.
template <class F>
struct FirstMatt {
  static constexpr std::int32_t none = -1, past = -2;

  Int<F> class_and_side;   ///< 2 class + front, if it was the last surface; `none` before it, `past` beyond the next
  Vec3<F> throughput, wo;  ///< there, where it may be rough
};

template <class F>
struct PathState {
  Ray<F> ray;
  Vec3<F> throughput;  ///< product of bsdf cos / pdf so far, radiance to radiance
  Vec3<F> radiance;    ///< gathered so far, W/(m^2 sr)
  F ior2;              ///< square of the refractive index here over that at the camera; 1 without glass
  PathKey<F> key;      ///< its dimension 0 is the first of the next hit
  Int<F> depth;        ///< surfaces hit before
  Int<F> way;          ///< a ChanceWay, where that is counted
  PathPlace<F> place;
  LampShares<F> lamps;
  ChainState<F> chain;
  FirstMatt<F> first;
};

}  // namespace glimt
