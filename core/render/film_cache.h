#pragma once

#include <cstddef>
#include <list>
#include <optional>

#include "film/film.h"
#include "film/statistics.h"
#include "render/render.h"
#include "scene/scene.h"

namespace glimt {

/// A film and what it takes to go on with it.
struct Accumulation {
  Film film;
  double seconds = 0;        ///< of rendering so far
  ErrorEstimate estimate{};  ///< of the film's samples
  int pass = 0;              ///< samples per pixel of a pass that was cancelled and is in the film in part; 0: none
  PassProgress progress;     ///< of that pass
};

/// Recent films by scene and settings (without the target), the longest unused of them forgotten where all together
/// take too much memory.
class FilmCache {
 public:
  explicit FilmCache(std::size_t max_bytes) : max_bytes_(max_bytes) {}

  /// Keeps it, unless it holds so few paths that they are traced anew in an instant.
  void put(const Scene& scene, Accumulation accumulation);
  /// Hands over what is kept of the scene, if anything.
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
