#pragma once

#include <cstddef>
#include <list>
#include <memory>
#include <optional>

#include "film/continuation.h"
#include "film/film.h"
#include "film/statistics.h"
#include "render/render.h"
#include "scene/scene.h"

namespace glimt {

/// A film and all that rendering needs to go on with it.
struct Accumulation {
  Film film;
  double seconds = 0;        ///< rendering time so far
  ErrorEstimate estimate{};  ///< error of the film's samples
  int pass = 0;              ///< samples per pixel of a cancelled pass, of which the film holds a part; 0: none
  PassProgress progress;     ///< of that pass
  FirstSamples first{};      ///< of the film
  std::shared_ptr<const Film> whole{};  ///< the film a while ago, without a part of a pass; null below enough samples
};

/// Recent films, by scene and settings without the target. Where they take too much memory, the film that was not used
/// for the longest time is dropped.
class FilmCache {
 public:
  explicit FilmCache(std::size_t max_bytes) : max_bytes_(max_bytes) {}

  /// Keeps a film, unless it has so few paths that tracing them again takes no time.
  void put(const Scene& scene, Accumulation accumulation);
  /// Removes and returns the film of the scene, if one is kept.
  std::optional<Accumulation> take(const Scene& scene);
  std::size_t bytes() const;

 private:
  struct Entry {
    Scene scene;  ///< without its target
    Accumulation accumulation;
  };
  std::size_t max_bytes_;
  std::list<Entry> entries_;  ///< the newest first
};

}  // namespace glimt
